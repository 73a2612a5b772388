#include "record/watchdog.h"

#include <gtest/gtest.h>

#include "record/seen_device.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t limit = 100'000'000;  // ns

TEST(HasStalled, IsBeyondTheLimitOnly) {
  EXPECT_FALSE(has_stalled(5 * limit, 5 * limit, limit));
  EXPECT_FALSE(has_stalled(5 * limit, 4 * limit, limit));
  EXPECT_TRUE(has_stalled(5 * limit, 4 * limit - 1, limit));
  EXPECT_FALSE(has_stalled(5 * limit, 5 * limit + 1, limit)) << "it gave a sign since the clock was read";
}

TEST(HasStalled, IsNoLoopThatDoesNotRun) { EXPECT_FALSE(has_stalled(5 * limit, 0, limit)); }

class StalledLoopTest : public testing::Test {
 protected:
  StalledLoopTest() {
    device.description.max_force = 12.0;
    settings.force = {8.0, 0.0, 1e9, 0.0};
    settings.duration = 0.1;
  }
  void make_loop() {
    opened = seen(device);
    opened->open();
    loop.emplace(*opened, &world, clock, ring, settings);
  }
  /// The state as the watchdog's thread would find it.
  bool look() { return release_if_stalled(loop.value(), *opened, clock.now(), limit); }
  void hang(std::int64_t time) { clock.add(time); }
  static bool in_tick(double time, int tick) { return std::llround(time * 1000) == tick; }

  FakeClock clock;
  FakeDevice device;
  FakeWorld world{[](double time) { return FeltForce{{0.0, 0.0, time > 0.0 ? 5.0 : 0.0}, 0}; }};
  SpscRing<RecordedSample> ring{1024};
  ServoSettings settings;
  std::shared_ptr<HapticDevice> opened;
  std::optional<ServoLoop> loop;
};

TEST_F(StalledLoopTest, IsReleasedAndGivesNoForceAfterwards) {
  device.reads = [&](double time, DeviceReading&) {
    if (in_tick(time, 30)) {
      EXPECT_EQ(device.held.z(), 5.0);
      hang(limit);
      EXPECT_FALSE(look());
      hang(1);
      EXPECT_TRUE(look());
      EXPECT_EQ(device.held, Vector3d::Zero());
      device.takes_force = [](const Vector3d& force) {
        EXPECT_EQ(force, Vector3d::Zero());
        return true;
      };
    }
    return true;
  };
  make_loop();
  const RecordingFooter footer = loop->run();
  EXPECT_EQ(footer.reason, StopReason::stall);
  EXPECT_EQ(footer.ticks.elapsed, 31);
  EXPECT_EQ(device.released, 1);
}

TEST_F(StalledLoopTest, TakesBackAForceThatItWasAboutToCommand) {
  const std::int64_t begin = clock.now();
  std::int64_t when = 0;
  device.takes_force = [&](const Vector3d& force) {
    if (force.z() > 0.0 && when == 0 && clock.now() > begin + limit / 4) {
      hang(limit + 1);  // the machine stands still between the loop's look at stop() and the motors
      EXPECT_TRUE(look());
      when = clock.now();
    } else if (when != 0) {
      EXPECT_EQ(force, Vector3d::Zero());
      EXPECT_EQ(clock.now(), when) << "at once, not in the next tick";
    }
    return true;
  };
  make_loop();
  EXPECT_EQ(loop->run().reason, StopReason::stall);
  EXPECT_EQ(device.held, Vector3d::Zero());
}

TEST_F(StalledLoopTest, IsNoneThatHasNotBegunOrIsOver) {
  make_loop();
  hang(10 * limit);
  EXPECT_FALSE(look());
  EXPECT_EQ(loop->run().reason, StopReason::duration);
  hang(10 * limit);
  EXPECT_FALSE(look());
  EXPECT_EQ(device.released, 0);
}

TEST(Watchdog, EndsAtOnceWhereNothingStalls) {
  FakeClock clock;
  FakeDevice device;
  SpscRing<RecordedSample> ring(1);
  ServoLoop loop(device, nullptr, clock, ring, {});
  { const Watchdog watchdog(loop, device, clock, 1e6, 0); }
  EXPECT_EQ(device.released, 0);
}

}  // namespace
}  // namespace sandstroke
