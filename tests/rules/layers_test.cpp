#include "rules/layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace sandstroke {
namespace {

TEST(SandPressure, OfOneSandIsItsDepth) {
  const SandColumn own, heavy{.density = 1.25, .factor = 2.0, .layers = {}};
  for (const double depth : {0.0, 0.003, 0.17}) {
    const SandPressure same = sand_pressure(own, -depth, depth), more = sand_pressure(heavy, -depth, depth);
    EXPECT_EQ(same.depth, depth);
    EXPECT_EQ(same.growth, 1.0);
    EXPECT_EQ(same.change, 0.0);
    EXPECT_DOUBLE_EQ(more.depth, 2.5 * depth);
  }
}

TEST(SandPressure, OfASecondSandHasTheFirstOnesWeightAndItsOwnFriction) {
  // The weight of 20 mm of the upper sand, and the friction of the lower.
  const SandColumn column{.layers = {{-0.02, 1.2, 3.0}}, .blend = 0.01};
  const auto at = [&](double depth) { return sand_pressure(column, -depth, depth).depth; };
  EXPECT_NEAR(at(0.014), 0.014, 1e-17);
  EXPECT_NEAR(at(0.030), 3.0 * (0.02 + 1.2 * 0.01), 1e-16);
  EXPECT_NEAR(at(0.020), 2.0 * 0.02, 1e-16);  // half of both at the border
}

TEST(SandPressure, UnderASurfaceBelowTheBorderIsThatOfTheLowerSandAlone) {
  const SandColumn column{.layers = {{-0.02, 1.2, 3.0}}, .blend = 0.01};
  EXPECT_NEAR(sand_pressure(column, -0.06, 0.01).depth, 3.0 * 1.2 * 0.01, 1e-16);
}

/// A column of up to five sands.
SandColumn some_column(std::mt19937& random) {
  const auto real = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  SandColumn column{
      .density = real(0.5, 2.0), .factor = real(0.1, 10.0), .layers = {}, .blend = real(0.001, 0.1)};
  for (int layers = static_cast<int>(real(0.0, 5.0)); layers > 0; --layers)
    column.layers.push_back({real(-0.2, 0.0), real(0.5, 2.0), real(0.1, 10.0)});
  std::sort(column.layers.begin(), column.layers.end(),
            [](const ColumnLayer& a, const ColumnLayer& b) { return a.top > b.top; });
  return column;
}

TEST(SandPressure, IsTheWeightAboveTimesTheFactorThere) {
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    const SandColumn column = some_column(random);
    const auto kind_at = [&](double z) {
      ColumnLayer here{0.0, column.density, column.factor};
      for (const ColumnLayer& layer : column.layers)
        if (z < layer.top) here = layer;
      return here;
    };
    const double surface = 0.01, depth = std::uniform_real_distribution<>(0.0, 0.25)(random),
                 z = surface - depth;
    // Sums over 20000 slices: of the density above, and of the factor around the point.
    constexpr int slices = 20000;
    double weight = 0.0, factor = 0.0;
    for (int k = 0; k < slices; ++k) {
      weight += kind_at(surface - depth * (k + 0.5) / slices).density * depth / slices;
      factor += kind_at(z + column.blend * ((k + 0.5) / slices - 0.5)).factor / slices;
    }
    EXPECT_NEAR(sand_pressure(column, z, depth).depth, factor * weight, 2e-3 * factor * weight + 1e-9);
  }
}

TEST(SandPressure, SaysHowItGrows) {
  std::mt19937 random(6);
  for (int i = 0; i < 1000; ++i) {
    const SandColumn column = some_column(random);
    const double depth = std::uniform_real_distribution<>(0.001, 0.25)(random);
    constexpr double step = 1e-9;
    const auto at = [&](double d) { return sand_pressure(column, 0.01 - d, d); };
    const bool bends = std::any_of(column.layers.begin(), column.layers.end(), [&](const ColumnLayer& layer) {
      const double off = std::abs(layer.top - (0.01 - depth));
      return off < 2.0 * step || std::abs(off - 0.5 * column.blend) < 2.0 * step;
    });
    if (bends) continue;
    const double slope = (at(depth + step).depth - at(depth - step).depth) / (2.0 * step);
    EXPECT_NEAR(at(depth).growth + at(depth).change, slope, 1e-5 * (1.0 + std::abs(slope)));
  }
}

}  // namespace
}  // namespace sandstroke
