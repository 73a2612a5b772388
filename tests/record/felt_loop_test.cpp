#include "record/felt_loop_text.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "measure/contact_stiffness.h"

namespace sandstroke {
namespace {

DeviceSpecification touch() {
  DeviceSpecification device;
  device.max_force = 3.3;
  device.max_stiffness = 400.0;
  device.max_damping = 4.0;
  return device;
}

TEST(FeltLoop, IsTheSandAtTheLargestForce) {
  Scene scene;
  scene.device.scale = 2.0;
  scene.stroke.emplace().placement.scale = 3.0;
  const auto of = [&](double max_force) { return felt_loop(scene, touch(), max_force, 1000.0); };
  for (const auto& [asked, force] : {std::pair{100.0, 3.3}, {2.0, 2.0}}) {
    const FeltLoop loop = of(asked).value();
    EXPECT_EQ(loop.force, force);
    // K = dF/dx where F = k_s (exp(k_c d) - 1) is that force, d = 6 x
    EXPECT_NEAR(loop.felt.stiffness, 6.0 * 0.5 * (1000.0 + force), 1e-9);
    EXPECT_NEAR(loop.felt.drag, 6.0 * 10.0 * force, 1e-12);
  }
  scene.device.max_force = 1.0;
  EXPECT_EQ(of(100.0)->force, 1.0) << "the scene's own limit";
  EXPECT_FALSE(of(0.0));
  DeviceSpecification stand_in;
  stand_in.max_force = any_force;
  EXPECT_FALSE(felt_loop(scene, stand_in, 3.0, 1000.0));
  scene.force.k_s = 0.0;
  EXPECT_FALSE(of(3.0));
}

TEST(FeltLoop, IsComparedWithTheDeviceAndTheory) {
  Scene scene;
  const FeltLoop default_sand = felt_loop(scene, touch(), any_force, 1000.0).value();
  EXPECT_TRUE(default_sand.is_stable());
  EXPECT_FALSE(default_sand.is_within_named());  // 33 N s/m, and it names 4
  scene.force.k_s = 700.0;
  scene.force.k_f = 1.0;
  EXPECT_TRUE(felt_loop(scene, touch(), any_force, 1000.0)->is_within_named());
  scene.force.k_s = 900.0;
  EXPECT_FALSE(felt_loop(scene, touch(), any_force, 1000.0)->is_within_named());
  DeviceSpecification silent = touch();
  silent.max_stiffness = silent.max_damping = 0.0;
  EXPECT_TRUE(felt_loop(scene, silent, any_force, 1000.0)->is_within_named());
}

TEST(FeltLoop, TheoryAllowsAtDefaultsWhatTheReadmeSays) {
  const FeltSand stable = felt_loop(Scene{}, touch(), any_force, 1000.0)->stable;
  EXPECT_NEAR(stable.drag, 138.0, 0.5);
  EXPECT_NEAR(stable.stiffness, 6060.0, 5.0);
}

TEST(FeltLoop, IsTakenAsAtLeastATickLate) {
  const auto delay = [](std::optional<double> lateness, double rate) {
    return felt_loop(Scene{}, touch(), 3.0, rate, lateness)->device.delay;
  };
  EXPECT_EQ(delay({}, 1000.0), 1);
  EXPECT_EQ(delay(0.0, 1000.0), 1);
  EXPECT_EQ(delay(0.9e-3, 1000.0), 1);
  EXPECT_EQ(delay(1.1e-3, 1000.0), 2);
  EXPECT_EQ(delay(1.1e-3, 4000.0), 5);
  EXPECT_GT(felt_loop(Scene{}, touch(), 3.0, 1000.0, 0.0)->stable.drag,
            felt_loop(Scene{}, touch(), 3.0, 1000.0, 4e-3)->stable.drag);
}

TEST(FeltLoop, ItsRemedySettlesAndNothingMuchHarderDoes) {
  for (const DragDirection drag : {DragDirection::horizontal, DragDirection::full})
    for (const auto& [k_s, k_f] : {std::pair{1000.0, 200.0}, {1e6, 10.0}, {1e6, 200.0}}) {
      Scene scene;
      scene.force.k_s = k_s;
      scene.force.k_f = k_f;
      scene.force.drag = drag;
      const FeltLoop loop = felt_loop(scene, touch(), any_force, 1000.0).value();
      EXPECT_FALSE(loop.is_stable());
      const ForceSettings settling = settling_scene(loop, scene).value().force;
      EXPECT_EQ(settling.k_s<k_s, k_s> 1e5);
      EXPECT_EQ(settling.k_f<k_f, k_f> 100.0);
      scene.force = settling;
      EXPECT_TRUE(felt_loop(scene, touch(), any_force, 1000.0)->is_stable()) << k_s << " " << k_f;
      scene.force.k_s *= k_s > 1e5 ? 1.12 : 1.0;
      scene.force.k_f *= k_f > 100.0 ? 1.12 : 1.0;
      EXPECT_FALSE(felt_loop(scene, touch(), any_force, 1000.0)->is_stable()) << k_s << " " << k_f;
    }
}

TEST(FeltLoop, NamesTheNumbersAndTheSettingsWhereItIsRefused) {
  const auto sentence = [](const Scene& scene) -> std::string {
    const FeltLoop loop = felt_loop(scene, touch(), any_force, 1000.0).value();
    try {
      check_felt_loop(loop, scene, "scene.toml");
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      EXPECT_NE(verdict_text(loop, scene).find("REFUSED"), std::string::npos);
      return error.what();
    }
    return "";
  };
  Scene scene;
  EXPECT_EQ(sentence(scene), "") << "only warned of";
  EXPECT_NE(verdict_text(*felt_loop(scene, touch(), any_force, 1000.0), scene)
                .find("beyond the limits that the device states"),
            std::string::npos);
  scene.force.k_f = 200.0;
  const std::string drag = sentence(scene);
  for (const char* part :
       {"scene.toml", "660 N s/m", "138 N s/m", "3.3 N", "set force.k_f = 41 ", "--max-force"})
    EXPECT_NE(drag.find(part), std::string::npos) << drag;
  scene.force.k_s = 1e5;
  EXPECT_NE(sentence(scene).find("set force.k_f = 41 and force.k_s = 1.2e+04 "), std::string::npos)
      << sentence(scene);
  scene.force = {};
  scene.force.k_c = 1e4;  // K = 1e4 (k_s + F) whatever k_s: only k_c can help
  EXPECT_NE(sentence(scene).find("set force.k_c = 6"), std::string::npos) << sentence(scene);
}

Scene contact_scene(ToolShape shape) {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.3;
  scene.bed.cols = scene.bed.rows = 150;
  scene.force.law = ForceLaw::rft;
  scene.tool.shape = shape;
  return scene;
}

TEST(FeltLoop, IsAsStiffAsALawOfTheContactAndDragsAtAnySpeedAlike) {
  Scene scene = contact_scene(ToolShape::sphere);
  scene.device.scale = 2.0;
  const FeltLoop loop = felt_loop(scene, touch(), 2.0, 1000.0).value();
  EXPECT_EQ(loop.felt.stiffness, 2.0 * contact_stiffness(scene, 2.0));
  EXPECT_EQ(loop.felt.drag, 0.0);
  scene.force.k_s = 0.0;  // the paper's, which does not count here
  EXPECT_TRUE(felt_loop(scene, touch(), 2.0, 1000.0));
}

TEST(FeltLoop, TheRemedyOfALawOfTheContactIsTheShortestYieldWayThatSettles) {
  for (const ToolShape shape : {ToolShape::sphere, ToolShape::plate}) {
    Scene scene = contact_scene(shape);
    scene.strength.yield_way = 2e-4;
    const FeltLoop loop = felt_loop(scene, touch(), any_force, 1000.0).value();
    EXPECT_FALSE(loop.is_stable());
    Scene settling = settling_scene(loop, scene).value();
    EXPECT_TRUE(felt_loop(settling, touch(), any_force, 1000.0)->is_stable());
    EXPECT_EQ(settling_scene(*felt_loop(settling, touch(), any_force, 1000.0), settling)->strength.yield_way,
              settling.strength.yield_way)
        << "what settles stays";
    settling.strength.yield_way *= 0.85;
    EXPECT_FALSE(felt_loop(settling, touch(), any_force, 1000.0)->is_stable());
    EXPECT_NE(verdict_text(loop, scene).find("set force.yield = 0.0"), std::string::npos)
        << verdict_text(loop, scene);
  }
}

TEST(FeltLoop, AToolThatNoYieldWayMakesSoftEnoughIsNamed) {
  // Heavy sand under a plate that is 20 cm square: 0.876 xi A as it sinks, whatever the way.
  Scene scene = contact_scene(ToolShape::box);
  scene.bed.cols = scene.bed.rows = 60;
  scene.strength.density = 1e5;
  scene.tool.size = {0.2, 0.2, 0.02};
  const FeltLoop loop = felt_loop(scene, touch(), any_force, 1000.0).value();
  EXPECT_FALSE(settling_scene(loop, scene));
  EXPECT_NE(verdict_text(loop, scene).find("use a smaller tool"), std::string::npos);
}

}  // namespace
}  // namespace sandstroke
