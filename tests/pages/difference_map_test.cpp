#include "pages/difference_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/colour_map.h"

namespace sandstroke {
namespace {

TEST(Spots, AnyOneCellIsSeenWhateverIsAroundIt) {
  // 23 x 37 cells in spots of 4 x 4: those at the end are cut off.
  for (const double value : {1.0, -1.0, std::nan(""), HUGE_VAL}) {
    for (int row = 0; row < 23; ++row) {
      for (int col = row % 3; col < 37; col += 3) {
        HeightGrid values = HeightGrid::Constant(23, 37, 1e-3);
        values(row, col) = value;
        const Spots spots = spots_of(values, 10);
        ASSERT_EQ(spots.side, 4);
        const HeightGrid seen = at_spots(values, spots);
        ASSERT_EQ(seen.rows(), 6);
        ASSERT_EQ(seen.cols(), 10);
        const double found = seen(row / 4, col / 4);
        EXPECT_TRUE(std::isnan(value) ? std::isnan(found) : found == value) << row << ", " << col;
        EXPECT_EQ((seen == 1e-3).count(), seen.size() - 1);
      }
    }
  }
}

TEST(Spots, AGridThatIsSmallEnoughIsItsSpots) {
  const HeightGrid values = HeightGrid::Random(7, 5);
  EXPECT_TRUE((at_spots(values, spots_of(values, 7)) == values).all());
}

TEST(Spots, OtherGridsAreReadAtTheSameCells) {
  HeightGrid difference = HeightGrid::Zero(8, 8), height(8, 8);
  for (int i = 0; i < 64; ++i) height.data()[i] = i;
  difference(5, 6) = -1.0;
  EXPECT_EQ(at_spots(height, spots_of(difference, 2))(1, 1), 5 * 8 + 6);
}

TEST(FiniteMagnitude, LeavesOutWhatIsNotFinite) {
  HeightGrid values(1, 4);
  values << 1.0, -3.0, std::nan(""), -HUGE_VAL;
  EXPECT_EQ(finite_magnitude(values), 3.0);
  EXPECT_EQ(finite_magnitude(HeightGrid::Constant(2, 2, std::nan(""))), 0.0);
}

TEST(PictureDifferenceMap, ShowsTheChannelThatDiffersMostWithItsSign) {
  Image golden(2, 1), run(2, 1);
  golden.rgb = {10, 10, 10, 10, 10, 10};
  run.rgb = {11, 5, 10, 10, 10, 30};
  const Image map = picture_difference_map(golden, run, 20);
  const auto expect = [&](int x, double fraction) {
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_EQ(map.pixel(x, 0)[channel], std::lround(255 * diverging_colour(fraction)[channel]));
  };
  expect(0, -5.0 / 20);
  expect(1, 1.0);
}

}  // namespace
}  // namespace sandstroke
