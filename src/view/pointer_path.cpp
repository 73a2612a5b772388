#include "view/pointer_path.h"

#include <algorithm>
#include <cmath>

namespace sandstroke {
namespace {

using Eigen::Vector3d;

constexpr std::size_t most_waiting = 4096;          // knots: a second of a page's fastest message rate
constexpr std::int64_t shortest_piece = 1'000'000;  // ns: late knots are caught up, but not at once

/// The slope at a knot [1/ns] between pieces of slopes d and lengths h: Steffen's equation 11.
double limited_slope(double d_before, double h_before, double d_after, double h_after) {
  if (!(d_before * d_after > 0.0)) return 0.0;
  const double parabola = (d_before * h_after + d_after * h_before) / (h_before + h_after);
  const double least = std::min({std::abs(d_before), std::abs(d_after), 0.5 * std::abs(parabola)});
  return std::copysign(2.0 * least, d_before);
}

}  // namespace

PointerPath::PointerPath(const Vector3d& home, std::int64_t interval)
    : ring_(most_waiting), interval_(interval), begin_slope_(Vector3d::Zero()), end_slope_(Vector3d::Zero()) {
  begin_.tip = end_.tip = home;
}

bool PointerPath::look_ahead() noexcept {
  PointerKnot knot;
  if (!next_ && ring_.pop(knot)) next_ = knot;
  return next_.has_value();
}

/// Starts the piece from end_ at this time to the next knot.
void PointerPath::set_out(std::int64_t time) noexcept {
  begin_ = end_;
  begin_.time = time;
  begin_slope_ = end_slope_;
  end_ = *next_;
  end_.time = std::max(end_.time, begin_.time + shortest_piece);
  end_slope_.setZero();
  next_.reset();
  goes_on_ = look_ahead();
  if (!goes_on_) return;
  const auto before = static_cast<double>(end_.time - begin_.time);
  const auto after = static_cast<double>(std::max(next_->time - end_.time, shortest_piece));
  const Vector3d slope_before = (end_.tip - begin_.tip) / before,
                 slope_after = (next_->tip - end_.tip) / after;
  for (int axis = 0; axis < 3; ++axis)
    end_slope_[axis] = limited_slope(slope_before[axis], before, slope_after[axis], after);
}

PointerKnot PointerPath::at(std::int64_t time) noexcept {
  while (time >= end_.time && look_ahead()) {
    const std::int64_t rest_ends = std::max(next_->time - interval_, last_asked_);
    if (goes_on_)
      set_out(end_.time);
    else if (time >= rest_ends)
      set_out(std::max(end_.time, rest_ends));
    else
      break;
  }
  last_asked_ = time;
  if (time >= end_.time) return {time, end_.tip, end_.switches};
  const auto length = static_cast<double>(end_.time - begin_.time);
  const double s = static_cast<double>(time - begin_.time) / length, r = 1.0 - s;
  const Vector3d tip = begin_.tip + s * s * (3.0 - 2.0 * s) * (end_.tip - begin_.tip) +
                       s * r * length * (r * begin_slope_ - s * end_slope_);
  return {time, tip, begin_.switches};
}

}  // namespace sandstroke
