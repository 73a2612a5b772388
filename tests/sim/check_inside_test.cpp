#include "sim/check_inside.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace sandstroke {
namespace {

/// The refusal of a stroke that draws a line of this size beside a bed of 0.3 m x 0.2 m.
std::string refusal(double size) {
  Scene scene;
  scene.bed.width = 0.3;
  scene.bed.depth = 0.2;
  scene.bed.cols = 150;
  scene.bed.rows = 100;
  Stroke stroke;
  stroke.time = {0.0, 1.0, 2.0};
  stroke.position = {{1.0, 2.0, -0.01}, {1.0 + size, 2.0 + 0.5 * size, -0.01}, {9, 9, 9}};
  stroke.contact = {pen_down, pen_down, pen_up};
  try {
    check_inside(stroke, scene, starting_bed(scene.bed));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(CheckInside, SaysTheWayOntoTheBed) {
  EXPECT_NE(refusal(0.1).find("it draws from x = 1 to 1.1 m and y = 2 to 2.05 m, and the bed ends at x = "
                              "0.15 m and y = 0.1 m; set stroke.place = \"centre\", or "),
            std::string::npos)
      << refusal(0.1);
  EXPECT_NE(refusal(0.4).find("\"centre\" and stroke.fit = 0.8"), std::string::npos) << refusal(0.4);
}

}  // namespace
}  // namespace sandstroke
