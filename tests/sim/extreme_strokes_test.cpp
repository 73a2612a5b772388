// Strokes that no hand would make: the run ends, all numbers are finite, and no sand is lost.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/error.h"
#include "sim/simulation.h"

namespace sandstroke {
namespace {

struct ExtremeStroke {
  const char* name;
  std::function<Eigen::Vector3d(double)> at;  ///< m, of the time [s]
};

constexpr double half = 0.15;  // m, of the bed
const ExtremeStroke strokes[] = {
    {"teleports",
     [](double t) { return Eigen::Vector3d(std::fmod(t, 0.02) < 0.01 ? -0.1 : 0.1, 0.0, -0.003); }},
    {"100_m_per_s", [](double t) { return Eigen::Vector3d(0.1 * std::sin(1000.0 * t), 0.0, -0.004); }},
    {"vibrates_at_half_the_servo_rate",
     [](double t) { return Eigen::Vector3d(0.0, 0.0, std::llround(1000.0 * t) % 2 ? -0.006 : 0.002); }},
    {"deeper_than_the_radius", [](double t) { return Eigen::Vector3d(0.1 * t, 0.0, -0.05); }},
    {"along_the_wall", [](double t) { return Eigen::Vector3d(-half + 0.2 * t, half, -0.005); }},
    {"into_the_corner", [](double t) { return Eigen::Vector3d(half * t, half * t, -0.005); }},
    {"rests", [](double) { return Eigen::Vector3d(0.0, 0.0, -0.006); }},
};

TEST(ExtremeStrokes, EndFiniteAndLoseNoSand) {
  for (const ExtremeStroke& extreme : strokes)
    for (const DeviceModel device : {DeviceModel::kinematic, DeviceModel::dynamic})
      for (const bool accurate : {false, true}) {
        SCOPED_TRACE(testing::Message()
                     << extreme.name << (device == DeviceModel::dynamic ? ", dynamic" : ", kinematic")
                     << (accurate ? ", accurate" : ", paper"));
        Scene scene;
        scene.bed.width = scene.bed.depth = 2.0 * half;
        scene.bed.cols = scene.bed.rows = 150;
        scene.device.model = device;
        if (accurate) {
          scene.tool.profile = ToolProfile::sphere;
          scene.displacement.deposit = Deposit::ahead;
          scene.relaxation.law = RelaxationLaw::isotropic;
          scene.relaxation.method = RelaxationMethod::rkl;
        }
        scene.stroke.emplace();
        scene.stroke->file = "in memory";
        Stroke stroke;
        for (int i = 0; i <= 1000; ++i) {
          stroke.time.push_back(1e-3 * i);
          stroke.position.push_back(extreme.at(1e-3 * i));
        }
        const HeightField bed = make_surface(scene.bed.surface, 150, 150, scene.bed.cell_size());
        Simulation simulation(scene, bed, stroke);
        SimulationObserver nobody;
        try {
          const RunResult result = simulation.run(nobody);
          EXPECT_EQ(result.ticks, 1001);
          EXPECT_TRUE(std::isfinite(result.max_force) && std::isfinite(result.absorbed_energy));
          EXPECT_TRUE(result.converged);
          EXPECT_LE(result.volume_drift, 1e-12);
          EXPECT_TRUE(simulation.bed().grid().isFinite().all());
        } catch (const Error& error) {  // a loop that cannot be stable may be refused, in a sentence
          EXPECT_EQ(error.kind(), ErrorKind::unstable);
          EXPECT_EQ(device, DeviceModel::dynamic);
        }
      }
}

}  // namespace
}  // namespace sandstroke
