#include "sweep/thumbnail.h"

#include <gtest/gtest.h>

#include <cmath>

#include "any_hdf5.h"
#include "core/error.h"
#include "hdf5/hdf5_file.h"
#include "io/bed_writer.h"
#include "render/colour_map.h"
#include "sweep/kept_surface.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

class ASurface : public testing::Test {
 protected:
  void write(const HeightField& bed) {
    Hdf5Writer file(path, any_hdf5);
    write_bed(file, "/surface", bed);
    file.attribute("/surface", "cell_size", bed.cell_size());
    file.finish();
  }

  const TestFolder folder;
  const std::filesystem::path path = folder / "point.h5";
};

TEST_F(ASurface, IsKnownAndMadeCoarseWithoutBeingRead) {
  // 300 x 500 cells in blocks of 7: those at the far borders hold fewer.
  HeightField bed(300, 500, 0.5, std::make_shared<LevelRule>(0.25));
  for (int row = 0; row < 300; row += 7)
    for (int col = 130; col < 500; ++col) bed.set(row, col, -1e-3 * col);
  write(bed);
  const KeptSurface kept = inspect_surface(path);
  EXPECT_EQ(kept.bed.rows(), 300);
  EXPECT_EQ(kept.bed.cols(), 500);
  EXPECT_EQ(kept.bed.cell_size(), 0.5);
  EXPECT_EQ(kept.highest, 0.499);
  const HeightGrid coarse = coarse_surface(path, 72), above = bed.grid() - 0.25;
  ASSERT_EQ(coarse.rows(), 43);
  ASSERT_EQ(coarse.cols(), 72);
  for (int row = 0; row < 43; ++row)
    for (int col = 0; col < 72; ++col) {
      const auto block =
          above.block(7 * row, 7 * col, std::min(7, 300 - 7 * row), std::min(7, 500 - 7 * col));
      EXPECT_NEAR(std::abs(coarse(row, col) - 0.25), block.abs().maxCoeff(), 1e-15);
    }
}

TEST_F(ASurface, ShowsAFurrowNarrowerThanAPixelAndSmallBedsInWholePixels) {
  HeightField bed(1000, 1000, 0.002);
  for (int col = 0; col < 1000; ++col) {
    bed.set(500, col, -0.1);
    bed.set(501, col, 0.05);
  }
  write(bed);
  const Image map = surface_thumbnail(path, 0.1);
  ASSERT_EQ(map.width, 167);  // blocks of 6 cells
  ASSERT_EQ(map.height, 167);
  const auto furrow = scale_colour(-0.1, -0.1, 0.1, ColourScale::diverging);
  for (int x = 0; x < map.width; ++x) EXPECT_EQ(map.pixel(x, 166 - 83)[2], std::lround(255.0 * furrow[2]));

  write(HeightField(30, 50, 0.002));
  EXPECT_EQ(surface_thumbnail(path, 0.1).width, 150);
  EXPECT_EQ(surface_thumbnail(path, 0.1).height, 90);
}

TEST_F(ASurface, IsAThumbnailForTheLargestBedToo) {
  HeightField bed(65536, 32768, 0.5);
  for (int row = 40000; row < 40800; ++row)
    for (int col = 3000; col < 3500; ++col) bed.set(row, col, -0.2);
  write(bed);
  const Image map = surface_thumbnail(path, 0.2);
  ASSERT_EQ(map.width, 96);
  ASSERT_EQ(map.height, 192);
  // A pixel is 342 cells wide; this one, from below the 118th, lies in what was carved, the other is level.
  const auto expect_colour = [&](const std::uint8_t* pixel, double height) {
    const auto colour = scale_colour(height, -0.2, 0.2, ColourScale::diverging);
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_EQ(pixel[channel], std::lround(255.0 * colour[channel]));
  };
  expect_colour(map.pixel(9, 191 - 118), -0.2);
  expect_colour(map.pixel(50, 50), 0.0);
}

TEST_F(ASurface, ThatIsNoneIsRefused) {
  EXPECT_THROW(inspect_surface(folder / "nothing.h5"), Error);
  {
    Hdf5Writer file(path, any_hdf5);
    file.write("/surface", std::vector<double>{1.0, 2.0});
    file.attribute("/surface", "cell_size", 0.5);
    file.finish();
  }
  EXPECT_THROW(inspect_surface(path), Error);
  for (const double cell_size : {0.0, -1.0, std::nan("")}) {
    Hdf5Writer file(path, any_hdf5);
    write_bed(file, "/surface", HeightField(5, 5, 1.0));
    file.attribute("/surface", "cell_size", cell_size);
    file.finish();
    EXPECT_THROW(inspect_surface(path), Error) << cell_size;
  }
}

}  // namespace
}  // namespace sandstroke
