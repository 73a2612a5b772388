#include "haptics/stroke_sampler.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sandstroke {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Slope of the height at a sample between two secants over the spacings h0 and h1; 0 at a turning point.
double inner_slope(double h0, double secant0, double h1, double secant1) {
  if (!(secant0 * secant1 > 0.0)) return 0.0;
  const double weight0 = 2.0 * h1 + h0, weight1 = h1 + 2.0 * h0;
  return (weight0 + weight1) / (weight0 / secant0 + weight1 / secant1);
}

/// Slope at the end of a piece, of the parabola through its last three samples; h0 and secant0 belong to the
/// end's own spacing.
template <class Slope>
Slope parabola_at_end(double h0, const Slope& secant0, double h1, const Slope& secant1) {
  return ((2.0 * h0 + h1) * secant0 - h0 * secant1) / (h0 + h1);
}

/// Slope of the height at the end of a piece: the parabola through three samples, limited so that the cubic
/// stays monotone.
double outer_slope(double h0, double secant0, double h1, double secant1) {
  const double slope = parabola_at_end(h0, secant0, h1, secant1);
  if (!(slope * secant0 > 0.0)) return 0.0;
  if (secant0 * secant1 < 0.0 && std::abs(slope) > 3.0 * std::abs(secant0)) return 3.0 * secant0;
  return slope;
}

/// The velocity, with its speed limited to `most`.
Vector2d limited(const Vector2d& velocity, double most) {
  const double speed = velocity.norm();
  return speed > most ? Vector2d(velocity * (most / speed)) : velocity;
}

/// Like inner_slope(), for the motion in the plane.
Vector2d inner_velocity(double h0, const Vector2d& secant0, double h1, const Vector2d& secant1) {
  const double speed0 = secant0.norm(), speed1 = secant1.norm();
  if (speed0 == 0.0 || speed1 == 0.0) return Vector2d::Zero();
  const double cosine = std::clamp((secant0 / speed0).dot(secant1 / speed1), -1.0, 1.0);
  return limited((h1 * secant0 + h0 * secant1) / (h0 + h1), (1.0 + cosine) * std::min(speed0, speed1));
}

/// Like outer_slope(), for the motion in the plane.
Vector2d outer_velocity(double h0, const Vector2d& secant0, double h1, const Vector2d& secant1) {
  const Vector2d velocity = parabola_at_end(h0, secant0, h1, secant1);
  if (!(velocity.dot(secant0) > 0.0)) return Vector2d::Zero();
  return limited(velocity, 3.0 * secant0.norm());
}

/// Keeps the height between those of a and b, despite rounding.
Vector3d between(Vector3d position, const Vector3d& a, const Vector3d& b) {
  position.z() = std::clamp(position.z(), std::min(a.z(), b.z()), std::max(a.z(), b.z()));
  return position;
}

}  // namespace

StrokeSampler::StrokeSampler(Stroke stroke) : stroke_(std::move(stroke)) {
  for (std::size_t i = 0; i + 1 < stroke_.size(); ++i) {
    if (stroke_.joined(i)) continue;
    if (!gaps_.empty() && gaps_.back().end == stroke_.time[i] && !stroke_.pen_down(i)) {
      gaps_.back().end = stroke_.time[i + 1];
    } else {
      gaps_.push_back({stroke_.time[i], stroke_.time[i + 1]});
    }
  }
  find_slopes();
}

bool StrokeSampler::lifts_between(double begin, double end) const {
  const auto gap = std::upper_bound(gaps_.begin(), gaps_.end(), begin,
                                    [](double time, const StrokeGap& one) { return time < one.end; });
  return gap != gaps_.end() && gap->begin < end;
}

void StrokeSampler::seek(double t) {
  const std::vector<double>& time = stroke_.time;
  const std::size_t before = cursor_;
  if (t < time[cursor_]) cursor_ = 0;
  while (cursor_ + 1 < time.size() && time[cursor_ + 1] <= t) ++cursor_;
  if (cursor_ != before) find_slopes();
}

void StrokeSampler::find_slopes() {
  begin_slope_ = slope(cursor_);
  if (stroke_.joined(cursor_)) end_slope_ = slope(cursor_ + 1);
}

Hand StrokeSampler::at(double t) {
  const double within = std::clamp(t, start_time(), end_time());
  seek(within);
  Hand hand = joined_or_lifted(within);
  if (!stroke_.orientation.empty()) hand.orientation = orientation_at(within);
  if (t != within) {
    hand.velocity.setZero();
    hand.down = false;
  }
  return hand;
}

Hand StrokeSampler::joined_or_lifted(double t) const {
  if (stroke_.joined(cursor_)) return on_curve(t);
  const bool last = cursor_ + 1 == stroke_.size();
  if (last || (t == stroke_.time[cursor_] && stroke_.pen_down(cursor_)))
    return {stroke_.position[cursor_], begin_slope_, stroke_.pen_down(cursor_)};
  return lifted(t);
}

Eigen::Quaterniond StrokeSampler::orientation_at(double t) const {
  const Eigen::Vector4d& a = stroke_.orientation[cursor_];
  if (t == stroke_.time[cursor_]) return Eigen::Quaterniond(a);
  const Eigen::Vector4d& b = stroke_.orientation[cursor_ + 1];
  const double fraction = (t - stroke_.time[cursor_]) / (stroke_.time[cursor_ + 1] - stroke_.time[cursor_]);
  return Eigen::Quaterniond((1.0 - fraction) * a + (a.dot(b) < 0.0 ? -fraction : fraction) * b).normalized();
}

Hand StrokeSampler::on_curve(double t) const {
  const Vector3d &a = stroke_.position[cursor_], &b = stroke_.position[cursor_ + 1];
  const double h = stroke_.time[cursor_ + 1] - stroke_.time[cursor_], s = t - stroke_.time[cursor_];
  const Vector3d secant = (b - a) / h;
  const Vector3d square = (2.0 * (secant - begin_slope_) + (secant - end_slope_)) / h;
  const Vector3d cube = ((begin_slope_ - secant) + (end_slope_ - secant)) / (h * h);
  return {between(a + s * (begin_slope_ + s * (square + s * cube)), a, b),
          begin_slope_ + s * (2.0 * square + 3.0 * s * cube), true};
}

Hand StrokeSampler::lifted(double t) const {
  const Vector3d &a = stroke_.position[cursor_], &b = stroke_.position[cursor_ + 1];
  const Vector3d velocity = (b - a) / (stroke_.time[cursor_ + 1] - stroke_.time[cursor_]);
  return {between(a + (t - stroke_.time[cursor_]) * velocity, a, b), velocity, false};
}

Vector3d StrokeSampler::slope(std::size_t sample) const {
  const auto spacing = [this](std::size_t i) { return stroke_.time[i + 1] - stroke_.time[i]; };
  const auto secant = [&](std::size_t i) -> Vector3d {
    return (stroke_.position[i + 1] - stroke_.position[i]) / spacing(i);
  };
  const bool from_left = sample > 0 && stroke_.joined(sample - 1);
  const bool to_right = stroke_.joined(sample);
  if (!from_left && !to_right) return Vector3d::Zero();

  // The interval at the sample and the one beside it (on its other side, or at an end the next one inwards).
  std::size_t near = to_right ? sample : sample - 1, beside = near;
  if (from_left && to_right) {
    beside = sample - 1;
  } else if (to_right && stroke_.joined(sample + 1)) {
    beside = sample + 1;
  } else if (from_left && sample > 1 && stroke_.joined(sample - 2)) {
    beside = sample - 2;
  }
  if (beside == near) return secant(near);  // a piece of two samples is straight

  const bool inner = from_left && to_right;
  const Vector3d near_secant = secant(near), beside_secant = secant(beside);
  Vector3d slope;
  slope.head<2>() = (inner ? inner_velocity : outer_velocity)(spacing(near), near_secant.head<2>(),
                                                              spacing(beside), beside_secant.head<2>());
  slope.z() =
      (inner ? inner_slope : outer_slope)(spacing(near), near_secant.z(), spacing(beside), beside_secant.z());
  return slope;
}

}  // namespace sandstroke
