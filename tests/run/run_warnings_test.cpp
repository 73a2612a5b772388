#include "run/run_warnings.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

/// The sentence of a code; empty: it is not given.
std::string warned(WarningCode code, const RunResult& result, const Scene& scene) {
  for (const Warning& warning : warnings_of_run(result, scene))
    if (warning.code == code) return warning.text;
  return "";
}

TEST(RunWarnings, SayWhereAKinematicStrokeGoesIntoTheFloor) {
  Scene scene;  // cells of 2 mm
  RunResult result;
  EXPECT_EQ(warned(WarningCode::stroke_in_floor, result, scene), "");
  result.device.in_floor_from = 0.25;
  result.device.most_floor_depth = 0.00019;  // less than a tenth of a cell
  EXPECT_EQ(warned(WarningCode::stroke_in_floor, result, scene), "");
  result.device.most_floor_depth = 0.0034;
  const std::string text = warned(WarningCode::stroke_in_floor, result, scene);
  EXPECT_NE(text.find("3.4 mm into a stone or the floor, from 0.250 s on"), std::string::npos) << text;
  scene.device.model = DeviceModel::dynamic;
  EXPECT_EQ(warned(WarningCode::stroke_in_floor, result, scene), "") << "it is stopped";
}

}  // namespace
}  // namespace sandstroke
