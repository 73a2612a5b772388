#include "validation/stress/device_loop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "validation/stress/loop_theory.h"

namespace sandstroke {
namespace {

constexpr std::int64_t ticks = 20'000;

LoopSettings sand(double k_s, const DeviceSettings& device) {
  LoopSettings loop;
  loop.device = device;
  PressedSand pressed;
  pressed.force.k_s = k_s;
  pressed.depth = depth_of_repulse_force(3.0, pressed.force);
  loop.against = pressed;
  loop.disturbance = 0.01 * pressed.depth;
  return loop;
}

TEST(DeviceLoop, StaysWhereItRests) {
  for (const int delay : {0, 5})
    for (const DragVelocity velocity : {DragVelocity::sampled, DragVelocity::implicit}) {
      LoopSettings loop = sand(1000.0, ideal_device());
      loop.device.delay = delay;
      loop.device.drag = velocity;
      loop.disturbance = 0.0;
      std::get<PressedSand>(loop.against).speed = 0.1;
      if (delay > 0) std::get<PressedSand>(loop.against).force.k_f = 0.5;  // late drag soon throws the device
      DeviceLoop at_rest(loop);
      for (int k = 0; k < 2000; ++k) at_rest.tick();
      EXPECT_LT(at_rest.off_rest().norm(), 1e-10) << delay;
    }
}

TEST(DeviceLoop, FeelsTheSandsOwnStiffnessAndDrag) {
  DeviceSettings device = ideal_device();
  device.scale = 3.0;
  LoopSettings loop = sand(1000.0, device);
  const auto& pressed = std::get<PressedSand>(loop.against);
  const double h = 1e-6;
  const auto force = [&](double z) { return repulse_force(-device.scale * z, pressed.force); };
  const double z = -pressed.depth / device.scale;
  EXPECT_NEAR(felt_about_rest(loop).z.stiffness / ((force(z - h) - force(z + h)) / (2.0 * h)), 1.0, 1e-8);
  EXPECT_NEAR(felt_about_rest(loop).x.damping, 3.0 * 10.0 * 3.0, 1e-9);
  EXPECT_NEAR(felt_about_rest(with_gain(loop, 2.0)).x.damping, 2.0 * 3.0 * 10.0 * 3.0, 1e-9);
}

TEST(RunLoop, AWallSettlesOrDiverges) {
  LoopSettings loop;
  loop.device = ideal_device();
  loop.against = Wall{1.0, 0.0};
  const double boundary = exact_boundary_gain(loop);
  EXPECT_EQ(run_loop(with_gain(loop, 0.9 * boundary), ticks).verdict, Verdict::stable);
  EXPECT_EQ(run_loop(with_gain(loop, 1.1 * boundary), ticks).verdict, Verdict::diverged);
}

TEST(RunLoop, SandSettlesOrThrowsTheDeviceUpAndTheHandBringsItBack) {
  DeviceSettings limited = ideal_device();
  limited.max_force = 12.0;
  EXPECT_EQ(run_loop(sand(20e3, limited), ticks).verdict, Verdict::stable);
  const LoopRun thrown = run_loop(sand(100e3, limited), ticks);
  EXPECT_EQ(thrown.verdict, Verdict::limit_cycle);
  EXPECT_GT(thrown.swing, 3.0 / 50e3);  // more than it is deep: it leaves the sand
}

TEST(RunLoop, SandThatYieldsSettlesOrSwingsByAboutItsYieldWay) {
  LoopSettings loop;
  loop.device = ideal_device();
  loop.against = YieldingSand{1.0, 0.001};
  loop.disturbance = 1e-5;
  EXPECT_EQ(felt_about_rest(loop).z.stiffness, 1000.0);
  const double boundary = exact_boundary_gain(loop);
  EXPECT_EQ(run_loop(with_gain(loop, 0.9 * boundary), ticks).verdict, Verdict::stable);
  const LoopRun beyond = run_loop(with_gain(loop, 1.3 * boundary), ticks);
  EXPECT_EQ(beyond.verdict, Verdict::limit_cycle);
  EXPECT_GT(beyond.swing, 0.001);
  EXPECT_LT(beyond.swing, 0.02);
  // The force turns round within two yield ways, and rests where the tool does.
  loop.disturbance = 0.0;
  DeviceLoop at_rest(loop);
  for (int k = 0; k < 100; ++k) at_rest.tick();
  EXPECT_LT(at_rest.off_rest().norm(), 1e-12);
  EXPECT_NEAR(at_rest.force().z(), 0.5, 1e-9);
}

TEST(RunLoop, ADitherWithinOneEncoderStepIsRest) {
  DeviceSettings coarse = ideal_device();
  coarse.resolution = 30e-6;
  LoopSettings loop = sand(2000.0, coarse);
  loop.disturbance = 1e-3;
  const LoopRun run = run_loop(loop, ticks);
  EXPECT_EQ(run.verdict, Verdict::stable);
  EXPECT_LE(run.swing, coarse.resolution);
}

}  // namespace
}  // namespace sandstroke
