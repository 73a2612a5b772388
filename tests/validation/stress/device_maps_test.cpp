#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "sanitized.h"
#include "validation/stress/device_parts.h"

namespace sandstroke {
namespace {

TEST(DeviceMaps, TheoryForetellsEveryCell) {
  std::vector<LoopMapPlan> plans = device_map_plans(true);
  if (sanitized) plans.resize(2);
  for (const LoopMapPlan& plan : plans) {
    const StabilityMap map = draw_map(plan);
    for (std::size_t row = 0; row < map.y.values.size(); ++row)
      for (std::size_t col = 0; col < map.x.values.size(); ++col)
        EXPECT_FALSE(map.surprise[row][col])
            << map.name << ": " << map.x.name << " " << map.x.values[col] << ", " << map.y.name << " "
            << map.y.values[row] << ": " << name_of(map.verdict[row][col]);
  }
}

TEST(DrawMap, IsTheSameForAnyNumberOfThreads) {
  const LoopMapPlan plan = device_map_plans(true)[1];
  const StabilityMap many = draw_map(plan);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const StabilityMap few = draw_map(plan);
  EXPECT_EQ(many.verdict, few.verdict);
  for (std::size_t curve = 0; curve < many.curves.size(); ++curve)
    EXPECT_EQ(many.curves[curve].points, few.curves[curve].points);
}

TEST(DrawMap, CurvesAreWhereAValueChangesItsSign) {
  LoopMapPlan plan = device_map_plans(true)[0];  // b = K T/2 with b = 9 N s/m
  const StabilityMap map = draw_map(plan);
  const MapCurve& passive = map.curves.at(1);
  EXPECT_EQ(passive.points.size(), map.x.values.size());
  for (const auto& [rate, stiffness] : passive.points) EXPECT_NEAR(stiffness / (18.0 * rate), 1.0, 1e-3);
}

TEST(MapAxis, IsEvenOrEvenInRatio) {
  EXPECT_EQ(map_axis("delay", "ticks", AxisScale::linear, 0.0, 20.0, 6).values,
            (std::vector<double>{0.0, 4.0, 8.0, 12.0, 16.0, 20.0}));
  const std::vector<double> decades = map_axis("mass", "kg", AxisScale::logarithmic, 0.01, 10.0, 4).values;
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(decades[i] / std::pow(10.0, double(i) - 2.0), 1.0, 1e-12);
}

}  // namespace
}  // namespace sandstroke
