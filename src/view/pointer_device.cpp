#include "view/pointer_device.h"
#include "tool/tool_surface.h"

#include <algorithm>
#include <cmath>

namespace sandstroke {
namespace {

constexpr std::int64_t window = 5'000'000'000;       // ns, of the page's clock
constexpr std::int64_t closest_samples = 1'000'000;  // ns: no servo loop sees a shorter distance

PointerScale scale_of(const Scene& scene) {
  const double reach = tool_reach(scene.tool);
  return {reach, reach, reach};
}

}  // namespace

void PageClock::see(std::int64_t page_time, std::int64_t arrival) {
  if (arrival - window_begin_ > window) {
    smallest_before_ = smallest_;
    smallest_ = none;
    window_begin_ = arrival;
  }
  smallest_ = std::min(smallest_, arrival - page_time);
}

PointerDevice::PointerDevice(const Scene& scene, const HeightField& start, LoopClock& clock)
    : start_(start),
      scale_(scale_of(scene)),
      hover_(start.highest() + scale_.clearance),
      device_(scene.device),
      clock_(clock) {
  specification_.model = "pointer (60 to 120 Hz, replayed 40 ms later)";
  specification_.manufacturer = "sandstroke";
  specification_.frame = "bed";
  specification_.max_force = any_force;  // to be shown, and recorded as what a device would give
  specification_.hand_feels = false;
  placement_ =
      point_placement(scene.stroke ? scene.stroke->placement : StrokePlacement{}, specification_.frame);
}

/// The height between the cells' centres, linearly.
double PointerDevice::surface(double x, double y) const {
  const double row = std::clamp(start_.row_at(y), 0.0, start_.rows() - 1.0);
  const double col = std::clamp(start_.col_at(x), 0.0, start_.cols() - 1.0);
  const int r0 = static_cast<int>(row), c0 = static_cast<int>(col);
  const int r1 = std::min(r0 + 1, start_.rows() - 1), c1 = std::min(c0 + 1, start_.cols() - 1);
  const double u = row - r0, v = col - c0;
  return (1.0 - u) * ((1.0 - v) * start_(r0, c0) + v * start_(r0, c1)) +
         u * ((1.0 - v) * start_(r1, c0) + v * start_(r1, c1));
}

void PointerDevice::add(const Place& place, double pressure, std::int64_t time) {
  const double z = pressure > 0.0 ? surface(place.x, place.y) - pressure * scale_.depth : hover_;
  path_->add({time, {place.x, place.y, z}, place.switches});
}

/// The tool goes down and up in place, where the pointer is pressed or let go: a finger that is set down
/// elsewhere must not draw on its way there.
void PointerDevice::go_to(Place place) {
  if (!path_) {  // it appears there, out of the sand
    path_.emplace(Eigen::Vector3d(place.x, place.y, hover_), sample_interval);
    last_ = {place.time - sample_interval, place.x, place.y, 0.0, 0};
    seen_.store(true, std::memory_order_release);
  }
  // Browsers repeat a pointer's place when the element under it changes. That is no motion.
  if (place.x == last_.x && place.y == last_.y && place.pressure == last_.pressure &&
      place.switches == last_.switches)
    return;
  const bool was_down = last_.pressure > 0.0, is_down = place.pressure > 0.0;
  if (was_down == is_down) {
    // The page's clock may be set back behind a message that came late. A switch is not lost for that.
    const bool too_close = place.time < last_.time + closest_samples;
    if (too_close && place.switches == last_.switches) return;
    if (too_close) place.time = last_.time + closest_samples;
  } else {
    place.time = std::max(place.time, last_.time + 2 * closest_samples);
    const std::int64_t before = std::max(last_.time, place.time - sample_interval);
    add(is_down ? place : last_, 0.0, before + (place.time - before) / 2);
  }
  add(place, place.pressure, place.time);
  last_ = place;
}

void PointerDevice::take(std::span<const PointerSample> samples, std::int64_t arrival) {
  // A tool with its middle beyond the outermost cells would have no sand on one side.
  const double half_x = start_.x_of(start_.cols() - 1), half_y = start_.y_of(start_.rows() - 1);
  const auto page_time = [](const PointerSample& sample) {
    constexpr double longest = 1e12;  // ms, of a page's clock: 30 years
    return to_nanoseconds(1e-3 * std::clamp(sample.time, -longest, longest));
  };
  for (const PointerSample& sample : samples) page_clock_.see(page_time(sample), arrival);
  for (const PointerSample& sample : samples)
    go_to({page_clock_.to_monotonic(page_time(sample)) + latency,
           std::clamp(static_cast<double>(sample.x), -half_x, half_x),
           std::clamp(static_cast<double>(sample.y), -half_y, half_y),
           std::clamp(static_cast<double>(sample.pressure), 0.0, 1.0), sample.switches});
}

void PointerDevice::leave() {
  if (!path_) return;
  go_to({clock_.now() + latency, last_.x, last_.y, 0.0, 0});
  page_clock_.reset();
}

bool PointerDevice::read(double, DeviceReading& reading) noexcept {
  if (!seen_.load(std::memory_order_acquire)) return false;
  const PointerKnot now = path_->at(clock_.now());
  reading.position = placement_.position_back((now.tip - device_.offset) / device_.scale);
  reading.velocity.setZero();
  reading.switches = now.switches;
  return true;
}

}  // namespace sandstroke
