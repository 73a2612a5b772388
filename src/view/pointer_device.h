#pragma once

#include <algorithm>
#include <atomic>
#include <limits>
#include <optional>
#include <span>

#include "haptics/haptic_device.h"
#include "haptics/stroke_placement.h"
#include "record/loop_clock.h"
#include "sand/height_field.h"
#include "sim/scene.h"
#include "view/messages.h"
#include "view/pointer_path.h"

namespace sandstroke {

/// Converts a page's clock to the monotonic clock. The fastest message of the last five to ten seconds gives
/// the difference. A new page has a clock of its own.
class PageClock {
 public:
  /// Notes that a page's time [ns] arrived at `arrival` [ns, monotonic].
  void see(std::int64_t page_time, std::int64_t arrival);
  /// Call it after see().
  std::int64_t to_monotonic(std::int64_t page_time) const {
    return page_time + std::min(smallest_, smallest_before_);
  }
  void reset() { *this = {}; }

 private:
  static constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  std::int64_t smallest_ = none,
               smallest_before_ = none;  // arrival - page's time, of this window and the last
  std::int64_t window_begin_ = 0;
};

/// A mouse, pen or finger in a page as the hand. The tip is at the pointer's place on the bed. Without
/// pressure it is `clearance` above the highest sand of the start. With a pressure p it is p x depth below
/// the surface of the start there: so furrows keep their depth, and a pointer that is held does not sink.
/// Pages send it 60 to 120 times a second. It is replayed `latency` later, smoothly (PointerPath). Where
/// there is no page, or its pointer is away, the tool is lifted at its last place. Before the first place
/// nothing is read.
///
/// The servo loop calls read(); one other thread calls take() and leave().
class PointerDevice : public HapticDevice, public PointerSink {
 public:
  /// 2.4 samples at 60 Hz: a slope needs the sample after the next.
  static constexpr std::int64_t latency = 40'000'000;          // ns
  static constexpr std::int64_t sample_interval = 16'666'667;  // ns

  /// start: the bed before anything touches it. clock: that of the servo loop.
  PointerDevice(const Scene& scene, const HeightField& start, LoopClock& clock);

  const PointerScale& scale() const { return scale_; }
  /// Takes samples of the page whose pointer is the hand. They came at `arrival` [ns].
  void take(std::span<const PointerSample> samples, std::int64_t arrival);
  void take(std::span<const PointerSample> samples) override { take(samples, clock_.now()); }
  /// Lifts the tool: that page is gone.
  void leave() override;

  void open() override {}
  void calibrate() override {}
  const DeviceSpecification& specification() const override { return specification_; }
  /// A pointer may come at any time.
  double longest_silence() const override { return 1e9; }
  bool read(double time, DeviceReading& reading) noexcept override;
  bool command(const Eigen::Vector3d&) noexcept override { return true; }
  void release() noexcept override {}
  void close() noexcept override {}

 private:
  struct Place {
    std::int64_t time = 0;  // ns, as replayed
    double x = 0.0, y = 0.0;
    double pressure = 0.0;
    std::uint32_t switches = 0;
  };
  void go_to(Place place);
  void add(const Place& place, double pressure, std::int64_t time);
  double surface(double x, double y) const;

  HeightField start_;
  PointerScale scale_;
  double hover_;  // m
  DeviceSettings device_;
  PointPlacement placement_;
  DeviceSpecification specification_;
  LoopClock& clock_;
  PageClock page_clock_;
  Place last_;  // the last that was added
  std::optional<PointerPath> path_;
  std::atomic<bool> seen_ = false;  // a page has said where its pointer is
};

}  // namespace sandstroke
