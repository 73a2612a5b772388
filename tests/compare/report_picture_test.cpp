#include "compare/report_picture.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/png_file.h"
#include "synthetic_run.h"

namespace sandstroke {
namespace {

/// Pixels in columns [from, to) that are clearly red, or clearly blue.
int coloured(const Image& image, int from, int to, bool red) {
  int count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = from; x < to; ++x) {
      const std::uint8_t* pixel = image.pixel(x, y);
      if ((red ? pixel[0] - pixel[2] : pixel[2] - pixel[0]) > 60) ++count;
    }
  }
  return count;
}

TEST(SurfaceReport, ShowsASingleCellAndItsSign) {
  HeightGrid golden = HeightGrid::Zero(1000, 1000), run = golden;
  // The legend has both colours too: count against a report without a difference.
  const Image equal = surface_report("equal", golden, run, 0.002, 1e-6);
  const int third = equal.width / 3;
  run(700, 300) = 1e-3;
  const Image above = surface_report("above", golden, run, 0.002, 1e-6);
  ASSERT_EQ(above.width, equal.width);
  EXPECT_GE(coloured(above, 2 * third, above.width, true), coloured(equal, 2 * third, equal.width, true) + 9);
  const Image below = surface_report("below", run, golden, 0.002, 1e-6);
  EXPECT_GE(coloured(below, 2 * third, below.width, false),
            coloured(equal, 2 * third, equal.width, false) + 9);
}

TEST(SurfaceReport, DrawsDifferentShapesAndNan) {
  HeightGrid golden = HeightGrid::Zero(20, 30);
  const Image two = surface_report("shapes", golden, HeightGrid::Zero(30, 20), 0.01, 1e-6);
  const Image three = surface_report("three", golden, golden, 0.01, 1e-6);
  EXPECT_LT(two.width, three.width);
  golden(3, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(surface_report("M\xc3\xbcnchen", golden, golden, 0.01, 1e-6).width, three.width);
}

TEST(PictureReport, ShowsWhatDiffersInRed) {
  const Image golden(72, 40);
  Image run = golden;
  for (int y = 10; y < 18; ++y)
    for (int x = 20; x < 28; ++x) run.pixel(x, y)[1] = 40;
  const Image report = picture_report("block", golden, run, 2);
  EXPECT_GE(report.width, 3 * 72);
  EXPECT_EQ(coloured(report, 0, report.width, true), 8 * 8);
  EXPECT_LT(picture_report("sizes", golden, Image(72, 41), 2).width, report.width);
}

TEST(WriteReport, MakesTheFolderAndLeavesOutWhatCannotBeDrawn) {
  const TestFolder folder;
  const std::filesystem::path path = folder / "a/b/report.png";
  write_report(path, []() -> Image { throw_input_error("no final surface"); });
  EXPECT_FALSE(std::filesystem::exists(path));
  write_report(path, [] { return Image(30, 20); });
  EXPECT_EQ(read_png(path).width, 30);
}

}  // namespace
}  // namespace sandstroke
