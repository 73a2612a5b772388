// Moist sand that came down lies in crumbs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/height_field_renderer.h"

namespace sandstroke {
namespace {

constexpr int cells_a_side = 200;
constexpr double cell_here = 0.001, talus = 0.6;

/// From left to right: level, at the talus slope, level, a cliff, level.
HeightField bed_with_slope_and_cliff() {
  HeightField bed(cells_a_side, cells_a_side, cell_here);
  for (int row = 0; row < cells_a_side; ++row)
    for (int col = 0; col < cells_a_side; ++col)
      bed.set(row, col, talus * cell_here * std::clamp(col - 60, 0, 60) + (col > 160 ? 0.03 : 0.0));
  return bed;
}

RenderSubject from_above(double crumbs) {
  RenderSubject subject;
  subject.view.name = ViewName::top;
  subject.view.width = 640;
  subject.view.height = 360;
  subject.crumbs = crumbs;
  return subject;
}

/// The mean over the middle rows of how much two pictures differ, at a column of cells.
double change_at(const Image& a, const Image& b, int col) {
  const double pixels_per_cell = 0.9 * a.height / ((cells_a_side - 1) * 1.024);
  const int u = static_cast<int>(0.5 * a.width + (col - 0.5 * cells_a_side) * pixels_per_cell);
  double sum = 0.0;
  for (int v = a.height / 3; v < a.height * 2 / 3; ++v) sum += std::abs(a.pixel(u, v)[0] - b.pixel(u, v)[0]);
  return sum / (a.height / 3);
}

TEST(Crumbs, LieWhereMoistSandCameToRestAndNowhereElse) {
  const HeightField bed = bed_with_slope_and_cliff();
  HeightFieldRenderer renderer(cells_a_side, cells_a_side, cell_here);
  const Image dry = renderer.render(bed, from_above(0.0)), moist = renderer.render(bed, from_above(talus)),
              steeper = renderer.render(bed, from_above(1.5 * talus));
  for (const int col : {70, 90, 110}) {
    EXPECT_GT(change_at(dry, moist, col), 5.0) << col;
    EXPECT_EQ(change_at(dry, steeper, col), 0.0) << col;  // no sand lies at that slope
  }
  for (const int col : {10, 50, 130, 150, 180}) EXPECT_EQ(change_at(dry, moist, col), 0.0) << col;
  // What was drawn before makes no difference.
  EXPECT_EQ(renderer.render(bed, from_above(0.0)).rgb, dry.rgb);
}

}  // namespace
}  // namespace sandstroke
