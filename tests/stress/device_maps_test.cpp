#include "stress/device_maps.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(DeviceMaps, TheoryForetellsEveryCell) {
  for (const LoopMapPlan& plan : device_map_plans(true)) {
    const StabilityMap map = draw_map(plan);
    for (std::size_t row = 0; row < map.y.values.size(); ++row)
      for (std::size_t col = 0; col < map.x.values.size(); ++col)
        EXPECT_FALSE(map.surprise[row][col])
            << map.name << ": " << map.x.name << " " << map.x.values[col] << ", " << map.y.name << " "
            << map.y.values[row] << ": " << name_of(map.verdict[row][col]);
  }
}

}  // namespace
}  // namespace sandstroke
