#include "sand/strength_by_place.h"

#include <gtest/gtest.h>

#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

GroundSettings two_layers_beside_a_region() {
  GroundSettings ground;
  SandRegion& region = ground.regions.emplace_back();
  region.centre = {0.05, 0.0};
  region.size = {0.1, 1.0};
  region.friction_angle = 36.0;
  region.density = 1700.0;
  ground.layers = {{.top = -0.04, .friction_angle = 25.0},
                   {.top = -0.02, .friction_angle = 38.0, .density = 1800.0}};
  return ground;
}

ToolElements cone() {
  ToolSettings settings;
  settings.shape = ToolShape::cone;
  settings.radius = 0.03;
  settings.height = 0.06;
  ToolElements elements(tool_surface(settings), 0.004);
  elements.turn(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX()).toRotationMatrix());
  return elements;
}

TEST(StrengthByPlace, OfSandThatSaysTheSameIsOneToTheBit) {
  const SandStrength own;
  GroundSettings ground = two_layers_beside_a_region();
  ground.regions[0].friction_angle = ground.layers[0].friction_angle = ground.layers[1].friction_angle =
      own.friction_angle;
  ground.regions[0].density = ground.layers[1].density = own.density;
  StrengthByPlace places(ground, own, 0.01);
  const ToolElements elements = cone();
  places.look(elements, {0.0, 0.0, -0.05});
  for (std::size_t i = 0; i < elements.size(); ++i) {
    ASSERT_EQ(places.density()[i], 1.0);
    ASSERT_EQ(places.factor()[i], 1.0);
  }
  for (const ColumnLayer& layer : places.layers()) {
    EXPECT_EQ(layer.density, 1.0);
    EXPECT_EQ(layer.factor, 1.0);
  }
  const VolumeBelow with = volume_below(elements, 0.05, {0.1, -0.2}, &places, -0.05),
                    without = volume_below(elements, 0.05, {0.1, -0.2});
  EXPECT_EQ(with.volume, without.volume);
  EXPECT_EQ(with.area, without.area);
}

TEST(StrengthByPlace, InVectorsIsThePlainRule) {
  const SandStrength own;
  StrengthByPlace places(two_layers_beside_a_region(), own, 0.015);
  ASSERT_EQ(places.layers().size(), 2u);
  EXPECT_EQ(places.layers()[0].top, -0.02);  // the highest first
  const ToolElements elements = cone();
  const Eigen::Vector3d tip(0.004, 0.0, -0.05);
  places.look(elements, tip);
  const double level = 0.002;
  double volume = 0.0, area = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(elements.count()); ++i) {
    const double z = tip.z() + elements.z()[i], depth = level - z;
    if (depth <= 0.0) continue;
    const SandPressure pressure =
        sand_pressure({places.density()[i], places.factor()[i], places.layers(), places.blend()}, z, depth);
    volume -= pressure.depth * elements.normal_z()[i] * elements.area()[i];
    area -= (pressure.growth + pressure.change) * elements.normal_z()[i] * elements.area()[i];
  }
  const VolumeBelow found =
      volume_below(elements, level - tip.z(), Eigen::Vector2d::Zero(), &places, tip.z());
  EXPECT_NEAR(found.volume, volume, 1e-13 * volume);
  EXPECT_NEAR(found.area, area, 1e-12 * std::abs(area));
}

}  // namespace
}  // namespace sandstroke
