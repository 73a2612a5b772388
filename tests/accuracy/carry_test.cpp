// A stroke that scoops sand and pours it converges, in cells and in ticks.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "sim/simulation.h"

namespace sandstroke {
namespace {

/// A shovel of 60 mm goes 15 mm deep under the sand, lifts, and is tilted; all in 1.6 s.
Stroke scoop(double rate) {
  Stroke stroke;
  const int last = static_cast<int>(std::lround(1.6 * rate));
  for (int k = 0; k <= last; ++k) {
    const double t = k / rate, in = std::min(t / 0.6, 1.0), up = std::clamp((t - 0.6) / 0.5, 0.0, 1.0),
                 over = std::clamp((t - 1.2) / 0.4, 0.0, 1.0);
    const double z = -0.015 * std::sin(0.5 * std::numbers::pi * in) + 0.075 * up * up * (3.0 - 2.0 * up);
    stroke.time.push_back(t);
    stroke.position.push_back({-0.06 + 0.08 * in, 0.0, z});
    stroke.orientation.push_back(Eigen::Quaterniond(Eigen::AngleAxisd(25.0 * over * std::numbers::pi / 180.0,
                                                                      Eigen::Vector3d::UnitY()))
                                     .coeffs());
  }
  return stroke;
}

struct Carried {
  double lifted, left;  // m^3
};
Carried carried(int cells, double rate) {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.24;
  scene.bed.cols = scene.bed.rows = 4 * cells;
  scene.device.servo_rate = rate;
  scene.tool.shape = ToolShape::shovel;
  scene.tool.size = {0.06, 0.06, 0.02};
  scene.tool.thickness = 0.006;
  scene.tool.solid = scene.tool.carries = true;
  scene.displacement.deposit = Deposit::outward;
  scene.relaxation.law = RelaxationLaw::isotropic;
  scene.relaxation.method = RelaxationMethod::rkl;
  scene.stroke.emplace();
  Simulation run(scene, starting_bed(scene.bed), scoop(rate));
  const RunResult result = run.run();
  EXPECT_LT(result.volume_drift, 1e-12);
  return {result.load->most, result.load->carried};
}

// Measured, with 20, 30, 40, 60, 80 and 120 cells along it: 39.6, 40.7, 41.9, 45.0, 45.7 and 46.1 cm^3.
TEST(Carry, AScoopConvergesWithTheCells) {
  const Carried coarse = carried(20, 1000.0), fine = carried(80, 1000.0), finest = carried(120, 1000.0);
  const double error = std::abs(coarse.lifted - finest.lifted), less = std::abs(fine.lifted - finest.lifted);
  EXPECT_LT(less, 0.015 * finest.lifted);
  EXPECT_GE(std::log2(error / less) / 2.0, 0.9);
  EXPECT_NEAR(fine.left / finest.left, 1.0, 0.03);
}

TEST(Carry, AScoopIsTheSameWithTicksOfAnyLength) {
  const Carried finest = carried(40, 2000.0);
  for (const double rate : {125.0, 500.0}) {
    const Carried coarse = carried(40, rate);
    EXPECT_NEAR(coarse.lifted / finest.lifted, 1.0, 0.008) << rate;
    EXPECT_NEAR(coarse.left / finest.left, 1.0, 0.003) << rate;
  }
}

}  // namespace
}  // namespace sandstroke
