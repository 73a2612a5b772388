#include "record/loop_check.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

RecorderSettings without_real_time() {
  RecorderSettings settings;
  settings.priority = 0;
  return settings;
}

TEST(IsFit, AsksForEveryTickAndForATenthOfOne) {
  RecordingFooter loop;
  loop.reason = StopReason::duration;
  loop.ticks.elapsed = loop.ticks.recorded = 1000;
  loop.lateness = {1e-5, 0.99e-4, 0.9e-3};
  EXPECT_TRUE(is_fit(loop, 1000.0));
  EXPECT_FALSE(is_fit(loop, 2000.0));
  loop.lateness.p99 = 1.01e-4;
  EXPECT_FALSE(is_fit(loop, 1000.0));
  loop.lateness.p99 = 1e-5;
  loop.ticks.skipped = 1;
  EXPECT_FALSE(is_fit(loop, 1000.0));
  loop.ticks.skipped = 0;
  loop.reason = StopReason::key;
  EXPECT_FALSE(is_fit(loop, 1000.0)) << "it has not seen the time that it was to see";
}

TEST(CheckLoop, AccountsForEachTick) {
  const LoopCheck check = check_loop(0.3, without_real_time());
  EXPECT_EQ(check.loop.reason, StopReason::duration);
  EXPECT_EQ(check.loop.ticks.elapsed, 300);
  EXPECT_EQ(check.loop.ticks.recorded + check.loop.ticks.skipped, 300);
}

TEST(CheckLoop, WaitsForNobody) {
  RecorderSettings settings = without_real_time();
  settings.servo.start = {.countdown = 1e6, .start_switch = 0, .at_contact = true};
  settings.servo.stop_switch = 3;
  EXPECT_EQ(check_loop(0.02, settings).loop.ticks.elapsed, 20);
}

TEST(CheckLoop, StopsWhenItIsAsked) {
  const LoopCheck check =
      check_loop(1e6, without_real_time(), [](const ServoProgress&) { return StopReason::key; });
  EXPECT_EQ(check.loop.reason, StopReason::key);
  EXPECT_FALSE(check.fit);
}

}  // namespace
}  // namespace sandstroke
