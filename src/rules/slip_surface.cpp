#include "rules/slip_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/angle.h"
#include "core/elementary.h"

namespace sandstroke {
namespace {

constexpr double pi = std::numbers::pi;

/// The angles of a spiral's first radius, at the crest, and of its last, at the toe, below the horizontal.
struct Spiral {
  double crest, toe;
};

/// The height, in c / gamma, of a cut that fails along a spiral; infinite where there is no such cut
/// (Chen 1975, equations 9.33 to 9.36, level ground).
double height_along(const Spiral& spiral, double cot_face, double mu) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const auto [crest, toe] = spiral;
  if (!(0.0 < crest && crest < toe && toe < pi)) return none;
  const double grows = elementary::exp((toe - crest) * mu);
  const double sin_crest = elementary::sin(crest), cos_crest = elementary::cos(crest),
               sin_toe = elementary::sin(toe), cos_toe = elementary::cos(toe);
  // In radii at the crest: the cut's height, and how far behind its edge the spiral comes out.
  const double height = grows * sin_toe - sin_crest, behind = cos_crest - grows * cos_toe - height * cot_face;
  if (!(height > 0.0 && behind >= 0.0)) return none;
  const double sector =
      ((3.0 * mu * cos_toe + sin_toe) * grows * grows * grows - (3.0 * mu * cos_crest + sin_crest)) /
      (3.0 * (1.0 + 9.0 * mu * mu));
  const double above = behind / 6.0 * (2.0 * cos_crest - behind) * sin_crest;
  const double before = grows / 6.0 * (elementary::sin(toe - crest) - behind * sin_toe) *
                        (cos_crest - behind + cos_toe * grows);
  const double weight = sector - above - before;
  if (!(weight > 0.0)) return none;
  return (grows * grows - 1.0) / (2.0 * mu * weight) * height;
}

/// The least height over all spirals. It has one valley, so a grid that moves and shrinks finds it. `best`:
/// where the search begins, `width` [rad] wide; then where it ended.
double least_height(double cot_face, double mu, Spiral& best, double width) {
  double least = height_along(best, cot_face, mu);
  while (width > 1e-6) {
    const Spiral from = best;
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j) {
        const Spiral one{from.crest + 0.5 * i * width, from.toe + 0.5 * j * width};
        const double height = height_along(one, cot_face, mu);
        if (!(height < least)) continue;
        least = height;
        best = one;
      }
    const double moved = std::max(std::abs(best.crest - from.crest), std::abs(best.toe - from.toe));
    if (moved < 0.75 * width) width *= 0.5;
  }
  return least;
}

/// The best of a coarse grid over all spirals.
Spiral coarsely_best(double cot_face, double mu) {
  constexpr int steps = 48;
  Spiral best{0.0, 0.0};
  double least = std::numeric_limits<double>::infinity();
  for (int i = 1; i < steps; ++i)
    for (int j = i + 1; j < steps; ++j) {
      const Spiral one{i * pi / steps, j * pi / steps};
      const double height = height_along(one, cot_face, mu);
      if (!(height < least)) continue;
      least = height;
      best = one;
    }
  return best;
}

double cot(double angle) { return angle == 90.0 ? 0.0 : 1.0 / elementary::tan(to_radians(angle)); }

double plane_height(double face_angle, double friction_angle) {
  return 4.0 * elementary::sin(to_radians(face_angle)) * elementary::cos(to_radians(friction_angle)) /
         (1.0 - elementary::cos(to_radians(face_angle - friction_angle)));
}

}  // namespace

double critical_height(SlipSurface surface, double face_angle, double friction_angle) {
  if (surface == SlipSurface::plane) return plane_height(face_angle, friction_angle);
  const double mu = elementary::tan(to_radians(friction_angle));
  Spiral best = coarsely_best(cot(face_angle), mu);
  return least_height(cot(face_angle), mu, best, pi / 48);
}

CohesionFactor::CohesionFactor(SlipSurface surface, double friction_angle)
    : friction_(elementary::tan(to_radians(friction_angle))) {
  const double mu = friction_, steepest = elementary::tan(to_radians(45.0 + 0.5 * friction_angle));
  per_step_ = (values - 1) * (steepest + mu) / (steepest - mu);
  if (surface == SlipSurface::plane) {
    table_.fill(1.0);
    safe_height_ = 0.5 * critical_height(surface, 90.0, friction_angle);
    return;
  }
  // A straight cut of height H fails along the chord of slope T from the toe where
  //   1 / H = (1 - T cot(face)) (T - mu) / (2 kappa (1 + T^2)).
  // The greatest of these lines over cot(face) is the cut's 1 / H where they are the tangents of that, which
  // is convex. So 2 kappa (1 + T^2) / (T - mu) = max over all faces of H (1 - T cot(face)).
  struct Cut {
    double cot_face, height;
  };
  constexpr int faces = 45;
  std::vector<Cut> cuts;
  Spiral best = coarsely_best(0.0, mu);
  const double flattest = friction_angle + 1.0;
  for (int i = 0; i < faces; ++i) {
    const double cot_face = cot(90.0 - i * (90.0 - flattest) / (faces - 1));
    if (!std::isfinite(height_along(best, cot_face, mu))) best = coarsely_best(cot_face, mu);
    cuts.push_back({cot_face, least_height(cot_face, mu, best, pi / 48)});
  }
  for (int i = 0; i < values; ++i) {
    const double lead = std::max(i, 1) / per_step_,  // the first chord, of slope mu, would carry nothing
        T = mu * (1.0 + lead) / (1.0 - lead);
    double most = 0.0;
    for (const Cut& cut : cuts) most = std::max(most, cut.height * (1.0 - T * cut.cot_face));
    table_[i] = most * (T - mu) / (2.0 * (1.0 + T * T));
  }
  least_ = (1.0 - 1e-12) * *std::min_element(table_.begin(), table_.end());
  // The least mean thickness of a wedge that fails; chords that are steeper need more.
  constexpr int between = 16;
  safe_height_ = std::numeric_limits<double>::infinity();
  for (int i = between; i <= between * (values - 1); ++i) {
    const double lead = i / (between * per_step_), T = mu * (1.0 + lead) / (1.0 - lead);
    safe_height_ = std::min(safe_height_, (*this)(T, 1.0) * (1.0 + T * T) / (T - mu));
  }
  safe_height_ *= 0.999;  // for what lies between these
}

// With L the lead of the chord's end over mu, such a wedge has A <= r (above - L / 2), and fails only if
//   (above - L / 2) L > k (r^2 + (mu r + L)^2) / r,  L <= top - mu r,  k = kappa c / gamma.
// The difference is greatest at one L, and falls with r from r = above cos(phi) on.
double CohesionFactor::longest_run(double above, double top, double cohesion) const {
  const double k = least_ * cohesion, square = 1.0 + friction_ * friction_;
  const auto may_fail = [&](double r) {
    const double lead = std::min((above - 2.0 * k * friction_) / (1.0 + 2.0 * k / r), top - friction_ * r);
    return lead > 0.0 &&
           (above - 0.5 * lead) * lead > k * (r * square + 2.0 * friction_ * lead + lead * lead / r);
  };
  double low = above / std::sqrt(square), high = std::max(low, top / friction_);
  for (int i = 0; i < 8 && may_fail(low); ++i) {
    const double middle = 0.5 * (low + high);
    if (!may_fail(middle))
      high = middle;
    else
      low = middle;
  }
  return may_fail(low) ? high : low;
}

}  // namespace sandstroke
