#include "render/map_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/annotate.h"
#include "render/colour_map.h"

namespace sandstroke {
namespace {

int count(const Image& image, const std::array<double, 3>& colour, int x_begin, int x_end) {
  int pixels = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = x_begin; x < x_end; ++x) {
      const std::uint8_t* p = image.pixel(x, y);
      pixels += p[0] == std::lround(255 * colour[0]) && p[1] == std::lround(255 * colour[1]) &&
                p[2] == std::lround(255 * colour[2]);
    }
  return pixels;
}

int map_end(int width, int height) { return width - legend_width({"height", 0.0, 1.0, false, 0.0}, height); }

TEST(PlainMap, APixelPerCellIsThatCellFromTheTopRowDown) {
  HeightGrid values(2, 3);
  values << 0.0, 0.1, 0.2,  //
      0.3, 0.4, 0.5;
  const Image map = plain_map(values, 0.0, 1.0, false, 3, 2);
  for (int row = 0; row < 2; ++row)
    for (int col = 0; col < 3; ++col)
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_EQ(map.pixel(col, 1 - row)[channel],
                  std::lround(255 * sequential_colour(values(row, col))[channel]));
}

TEST(MapPicture, RowZeroIsAtTheBottom) {
  HeightGrid values = HeightGrid::Zero(2, 2);
  values.row(1) = 1.0;
  const Image image = map_picture(values, 0.0, 1.0, false, 400, 300);
  const auto low = sequential_colour(0.0), high = sequential_colour(1.0);
  // The map is square: rows above its middle are high, rows below it low.
  const int x = map_end(400, 300) / 2;
  EXPECT_EQ(image.pixel(x, 100)[1], std::lround(255 * high[1]));
  EXPECT_EQ(image.pixel(x, 200)[1], std::lround(255 * low[1]));
}

TEST(MapPicture, KeepsTheAspectRatio) {
  const Image image = map_picture(HeightGrid::Constant(10, 40, 0.5), 0.0, 1.0, false, 640, 360);
  const int pixels = count(image, sequential_colour(0.5), 0, map_end(640, 360));
  const double width = std::sqrt(pixels * 4.0);
  EXPECT_NEAR(width * width / 4.0, pixels, 2.0 * width);
  EXPECT_GT(width, 400.0);
}

TEST(MapPicture, ShrinksByTheMean) {
  HeightGrid values(600, 600);  // a chessboard far finer than the pixels
  for (int row = 0; row < 600; ++row)
    for (int col = 0; col < 600; ++col) values(row, col) = (row + col) % 2;
  const Image image = map_picture(values, 0.0, 1.0, false, 220, 100);
  const auto middle = sequential_colour(0.5);
  int near_middle = 0;
  for (int y = 20; y < 80; ++y)
    near_middle += std::abs(image.pixel(map_end(220, 100) / 2, y)[1] - 255 * middle[1]) < 8;
  EXPECT_EQ(near_middle, 60);
}

TEST(MapPicture, WhatIsNotFiniteIsGray) {
  HeightGrid values = HeightGrid::Zero(1, 1);
  values(0, 0) = std::nan("");
  const Image image = map_picture(values, -1.0, 1.0, true, 300, 200, "difference");
  EXPECT_GT(count(image, {0.5, 0.5, 0.5}, 0, 150), 100);
}

TEST(MapPicture, FitsIntoSmallPictures) {
  const Image image = map_picture(HeightGrid::Zero(50, 2000), -1e-6, 1e-6, true, 64, 48, "difference");
  EXPECT_EQ(image.rgb.size(), 3u * 64 * 48);
}

}  // namespace
}  // namespace sandstroke
