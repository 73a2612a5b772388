#include "record/stroke_device.h"

#include <gtest/gtest.h>

#include "allocations.h"
#include "record/fake_device.h"
#include "record/servo_loop.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

/// n samples every `spacing` [s], from `begin` [s] on, along a parabola.
Stroke parabola(std::size_t n, double spacing, double begin) {
  Stroke stroke;
  for (std::size_t i = 0; i < n; ++i) {
    const double s = spacing * static_cast<double>(i);
    stroke.time.push_back(begin + s);
    stroke.position.emplace_back(s, s * s, -0.01 * s);
  }
  return stroke;
}

TEST(StrokeDevice, IsWhereTheStrokeIsSoLongAfterItsFirstSample) {
  const Stroke stroke = parabola(50, 0.02, 7.5);
  StrokeSampler sampler(stroke);
  StrokeDevice device(stroke, "parabola");
  device.open();
  EXPECT_DOUBLE_EQ(*device.duration(), stroke.duration());
  for (int tick = 0; tick <= 980; ++tick) {
    const double time = 1e-3 * tick;
    DeviceReading reading;
    ASSERT_TRUE(device.read(time, reading));
    const Hand hand = sampler.at(7.5 + time);
    EXPECT_EQ(reading.position, hand.position);
    EXPECT_EQ(reading.velocity, hand.velocity);
    EXPECT_EQ(reading.switches, 0u);
  }
}

TEST(StrokeDevice, RestsAtTheEndForAsLongAsItIsAsked) {
  StrokeDevice device(parabola(11, 0.1, 0.0), "parabola");
  for (const double time : {1.001, 2.0, 1e6}) {
    DeviceReading reading{Vector3d::Ones(), Vector3d::Ones(), 0};
    ASSERT_TRUE(device.read(time, reading));
    EXPECT_LE((reading.position - Vector3d(1.0, 1.0, -0.01)).norm(), 1e-15);
    EXPECT_EQ(reading.velocity, Vector3d::Zero());
  }
}

TEST(StrokeDevice, SwitchesAreThoseOfTheLastSample) {
  Stroke stroke = parabola(4, 0.1, 2.0);
  stroke.gap_threshold = 0.2;
  stroke.switches = {0, 5, 1, 2};
  StrokeDevice device(stroke, "switches");
  EXPECT_EQ(device.specification().switches, 3);  // bits 0, 1 and 2
  const auto switches_at = [&](double time) {
    DeviceReading reading;
    EXPECT_TRUE(device.read(time, reading));
    return reading.switches;
  };
  EXPECT_EQ(switches_at(0.0), 0u);
  EXPECT_EQ(switches_at(0.099), 0u);
  EXPECT_EQ(switches_at(0.101), 5u);
  EXPECT_EQ(switches_at(0.299), 1u);
  EXPECT_EQ(switches_at(0.301), 2u);
  EXPECT_EQ(switches_at(9.0), 2u);
  EXPECT_EQ(switches_at(0.15), 5u);  // in any order
}

TEST(StrokeDevice, GivesNothingWhereTheStrokeHasNoSamples) {
  Stroke stroke;  // 0 to 0.1 s, a gap, 0.5 to 0.6 s; the pen lifts, and is down again, at 0.65 s
  stroke.time = {0.0, 0.1, 0.5, 0.6, 0.65};
  stroke.position.assign(5, Vector3d::Zero());
  stroke.contact = {pen_down, pen_down, pen_down, pen_lifts, pen_down};
  StrokeDevice device(stroke, "gaps");
  DeviceReading reading;
  for (const double read : {0.0, 0.05, 0.1, 0.5, 0.55, 0.6, 0.65, 0.7})
    EXPECT_TRUE(device.read(read, reading));
  for (const double unread : {0.101, 0.3, 0.499, 0.601, 0.649})
    EXPECT_FALSE(device.read(unread, reading)) << unread;
}

TEST(StrokeDevice, IsNotTakenForLostInAGapAndPlaysOnAfterIt) {
  Stroke stroke;  // two gaps in ticks 51 to 400, with a sample between them that no tick meets
  stroke.time = {0.0, 0.0505, 0.2005, 0.4005, 0.4504};
  stroke.position.assign(5, Vector3d::Zero());
  StrokeDevice device(stroke, "gaps");
  FakeClock clock;
  SpscRing<RecordedSample> ring(1024);
  ServoLoop loop(device, nullptr, clock, ring, {});
  const std::int64_t before = allocations_of_this_thread();
  const RecordingFooter footer = loop.run();
  EXPECT_EQ(allocations_of_this_thread(), before);
  EXPECT_EQ(footer.reason, StopReason::stroke_end);
  EXPECT_EQ(footer.ticks.elapsed, 451);
  EXPECT_EQ(footer.ticks.unread, 350);
  EXPECT_EQ(footer.ticks.recorded, 101);
}

TEST(StrokeDevice, PlaysSamplesWithThePenUpAsPositions) {
  Stroke stroke = parabola(5, 0.05, 0.0);
  stroke.contact = {pen_down, pen_up, pen_up, pen_down, pen_down};
  StrokeDevice device(stroke, "pen");
  DeviceReading reading;
  ASSERT_TRUE(device.read(0.075, reading));
  EXPECT_NEAR(reading.position.x(), 0.075, 1e-15);  // on the straight way between two samples
}

TEST(StrokeDevice, TakesAnyForceAndLetsGoOfIt) {
  Stroke stroke = parabola(3, 0.1, 0.0);
  stroke.frame = "device";
  StrokeDevice device(stroke, "force");
  EXPECT_EQ(device.specification().frame, "device");
  EXPECT_EQ(device.specification().model, "force");
  EXPECT_EQ(device.specification().max_force, any_force);
  EXPECT_TRUE(device.command({1e300, -2.0, 3.0}));
  EXPECT_EQ(device.force(), Vector3d(1e300, -2.0, 3.0));
  DeviceReading before, after;
  device.release();
  EXPECT_EQ(device.force(), Vector3d::Zero());
  device.read(0.1, before);
  device.command({0.0, 0.0, 100.0});
  device.read(0.1, after);
  EXPECT_EQ(before.position, after.position);
  device.close();
  EXPECT_EQ(device.force(), Vector3d::Zero());
}

TEST(StrokeDevice, HasSwitchesUpToTheHighestThatIsPressed) {
  for (const auto& [pressed, switches] : {std::pair{0u, 0}, {1u, 1}, {4u, 3}, {0x80000000u, 32}}) {
    Stroke stroke = parabola(3, 0.1, 0.0);
    stroke.switches = {0, pressed, 0};
    EXPECT_EQ(StrokeDevice(stroke, "switches").specification().switches, switches) << pressed;
  }
}

}  // namespace
}  // namespace sandstroke
