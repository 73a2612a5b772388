// The servo loop beside a view: it takes no memory, whatever pages do.
#include <gtest/gtest.h>

#include <optional>
#include <thread>

#include "allocations.h"
#include "record/live_sand.h"
#include "record/recorder.h"
#include "sand/initial_surface.h"
#include "test_folder.h"
#include "view/pointer_device.h"
#include "view/view_client.h"
#include "view/view_server.h"

namespace sandstroke {
namespace {

/// Counts what the servo loop allocates from its first reading to its last.
class WatchedPointer : public PointerDevice {
 public:
  using PointerDevice::PointerDevice;
  bool read(double time, DeviceReading& reading) noexcept override {
    last_ = allocations_of_this_thread();
    if (!first_) first_ = last_;
    return PointerDevice::read(time, reading);
  }
  std::int64_t allocated() const { return last_ - first_.value_or(0); }

 private:
  std::optional<std::int64_t> first_;
  std::int64_t last_ = 0;
};

TEST(ServoLoopBesideAView, TakesNoMemoryAndShowsWhatIsCarved) {
  const TestFolder folder;
  Scene scene;
  scene.bed.cols = scene.bed.rows = 200;
  scene.bed.width = scene.bed.depth = 0.4;
  const HeightField start = starting_bed(scene.bed);
  MonotonicClock clock;
  WatchedPointer device(scene, start, clock);
  LiveBed live(start);
  LiveState state;
  ViewServer server(
      {live, state, {"", start, height_range(start), scene.tool, 0.0, device.scale()}, "", &device});
  LiveSand sand(scene, start, {device.specification().frame});
  const HeightField* shown = nullptr;
  sand.show_to([&](const HeightField& bed) {
    shown = &bed;
    live.publish(bed);
  });
  sand.start();
  RecorderSettings settings;
  settings.servo.duration = 60.0;
  settings.lock_memory = false;
  settings.priority = 0;
  ViewClient page(server.address());
  ASSERT_TRUE(page.hear());
  int k = 0;
  settings.watch = 1.0 / 60.0;
  const RecordingReport report =
      record(device, &sand, settings, {}, folder / "journal", [&](const ServoProgress&) {
        page.point(1000.0 / 60.0 * k, 0.001f * static_cast<float>(k), 0.0f, k > 2 ? 0.5f : 0.0f);
        return ++k > 30 ? std::optional(StopReason::key) : std::nullopt;
      });
  sand.finish();
  ASSERT_TRUE(shown);
  EXPECT_EQ(device.allocated(), 0);  // nor counted under sanitizers
  EXPECT_EQ(report.footer.reason, StopReason::key);
  std::jthread ending([&] { server.end(""); });
  page.hear_to_end();
  double deepest = 0.0;
  for (int row = 0; row < 200; ++row)
    for (int col = 0; col < 200; ++col) {
      ASSERT_EQ(page.height(row, col), static_cast<float>((*shown)(row, col)));
      deepest = std::min(deepest, (*shown)(row, col));
    }
  EXPECT_LT(deepest, -0.001);
}

}  // namespace
}  // namespace sandstroke
