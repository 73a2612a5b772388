#include "record/stroke_device.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace sandstroke {
namespace {

/// The longest gap [s]. Gaps with one sample between them count as one: perhaps no tick meets that sample.
double longest_gap(const Stroke& stroke) {
  double longest = 0.0, begin = 0.0;
  for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
    if (i == 0 || stroke.sampled_between(i - 1)) begin = stroke.time[i];
    if (!stroke.sampled_between(i)) longest = std::max(longest, stroke.time[i + 1] - begin);
  }
  return longest;
}

}  // namespace

StrokeDevice::StrokeDevice(Stroke stroke, std::string name) : sampler_(std::move(stroke)) {
  std::uint32_t ever_pressed = 0;
  for (const std::uint32_t pressed : sampler_.stroke().switches) ever_pressed |= pressed;
  longest_silence_ = longest_gap(sampler_.stroke());
  specification_.model = std::move(name);
  specification_.manufacturer = "sandstroke";
  specification_.frame = sampler_.stroke().frame;
  specification_.max_force = any_force;
  specification_.switches = std::bit_width(ever_pressed);
  specification_.measures_orientation = !sampler_.stroke().orientation.empty();
  specification_.measures_velocity = true;  // the derivative of its positions, exactly
}

bool StrokeDevice::read(double time, DeviceReading& reading) noexcept {
  const Stroke& stroke = sampler_.stroke();
  const double t = sampler_.start_time() + time;
  const auto after = std::upper_bound(stroke.time.begin(), stroke.time.end(), t) - stroke.time.begin();
  const auto last = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after, 1) - 1);
  if (last + 1 < stroke.size() && t > stroke.time[last] && !stroke.sampled_between(last)) return false;
  const Hand hand = sampler_.at(t);
  reading = {hand.position, hand.velocity, stroke.switches.empty() ? 0 : stroke.switches[last],
             hand.orientation};
  return true;
}

bool StrokeDevice::command(const Eigen::Vector3d& force) noexcept {
  for (int axis = 0; axis < 3; ++axis) force_[axis].store(force[axis], std::memory_order_relaxed);
  return true;
}

Eigen::Vector3d StrokeDevice::force() const {
  Eigen::Vector3d force;
  for (int axis = 0; axis < 3; ++axis) force[axis] = force_[axis].load(std::memory_order_relaxed);
  return force;
}

}  // namespace sandstroke
