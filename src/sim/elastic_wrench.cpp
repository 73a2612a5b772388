#include "sim/elastic_wrench.h"

#include <algorithm>
#include <cmath>

namespace sandstroke {
namespace {

using Six = ElasticWrench::Six;

/// In one order, so that the bits are the same wherever a vector lies: Eigen's sums go by its alignment.
double dot(const Six& a, const Six& b) {
  double sum = 0.0;
  for (int i = 0; i < 6; ++i) sum += a[i] * b[i];
  return sum;
}

double length(const Six& a) { return std::sqrt(dot(a, a)); }

struct Ball {
  Six centre;
  double radius2;  // squared

  bool contains(const Six& point) const {
    const Six off = point - centre;
    return dot(off, off) <= radius2;
  }
  Six nearest_to(const Six& point) const {
    const Six off = point - centre;
    return contains(point) ? point : Six(centre + std::sqrt(radius2 / dot(off, off)) * off);
  }
};

/// The point of both balls that is nearest to `point`. They have a point in common.
Six nearest_in_both(const Ball& a, const Ball& b, const Six& point) {
  const Six in_a = a.nearest_to(point), in_b = b.nearest_to(point);
  if (b.contains(in_a)) return in_a;
  if (a.contains(in_b)) return in_b;
  const Six apart = b.centre - a.centre;
  const double apart2 = dot(apart, apart);
  if (!(apart2 > 0.0)) return in_a;  // the same ball
  const double part = 0.5 * (1.0 + (a.radius2 - b.radius2) / apart2);
  Ball rim{a.centre + part * apart, std::max(a.radius2 - part * part * apart2, 0.0)};
  const Six off = point - rim.centre;
  return rim.nearest_to(point - dot(off, apart) / apart2 * apart);
}

/// An elastic force that is larger than `asked` yields to the size of that, and turns towards it by up to
/// `most_turn`: by as much as a way along the surface of that size would turn it away.
Six yielded(const Six& elastic, const Six& asked, double most_turn) {
  const double size = length(elastic), most = length(asked);
  if (size <= most) return elastic;
  const Six shorter = most / size * elastic, turn = asked - shorter;
  const double way = length(turn);
  if (way <= most_turn) return asked;
  const Six turned = shorter + most_turn / way * turn;
  const double chord = length(turned);
  return chord > 0.0 ? Six(most / chord * turned) : turned;
}

}  // namespace

const Six& ElasticWrench::follow(const Six& asked, double stiffness, const Six& way, double most) {
  if (stiffness < stiffness_) force_ *= std::sqrt(stiffness / stiffness_);
  stiffness_ = stiffness;
  const Six elastic = force_ - stiffness * way, middle = 0.5 * elastic;
  const double change = stiffness * length(way);
  force_ = nearest_in_both({middle, dot(middle, middle)}, {force_, change * change},
                           yielded(elastic, asked, change));
  const double size = std::sqrt(force_[0] * force_[0] + force_[1] * force_[1] + force_[2] * force_[2]);
  if (most > 0.0 && size > most) force_ *= most / size;  // nearer to 0 in the same ball
  return force_;
}

double ElasticWrench::stored() const {
  return stiffness_ > 0.0 ? dot(force_, force_) / (2.0 * stiffness_) : 0.0;
}

}  // namespace sandstroke
