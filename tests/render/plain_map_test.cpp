#include "render/plain_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/colour_map.h"

namespace sandstroke {
namespace {

TEST(PlainMap, APixelPerCellIsThatCellFromTheTopRowDown) {
  HeightGrid values(2, 3);
  values << 0.0, 0.1, 0.2,  //
      0.3, 0.4, 0.5;
  const Image map = plain_map(values, 0.0, 1.0, ColourScale::sequential, 3, 2);
  for (int row = 0; row < 2; ++row)
    for (int col = 0; col < 3; ++col)
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_EQ(map.pixel(col, 1 - row)[channel],
                  std::lround(255 * sequential_colour(values(row, col))[channel]));
}

TEST(PlainMap, ShrinksByTheMean) {
  HeightGrid values(600, 600);  // a chessboard far finer than the pixels
  for (int row = 0; row < 600; ++row)
    for (int col = 0; col < 600; ++col) values(row, col) = (row + col) % 2;
  const Image map = plain_map(values, 0.0, 1.0, ColourScale::sequential, 90, 90);
  const auto middle = sequential_colour(0.5);
  for (int y = 0; y < 90; ++y) EXPECT_NEAR(map.pixel(45, y)[1], 255 * middle[1], 8.0);
}

TEST(PlainMap, WhatIsNotFiniteIsGrey) {
  HeightGrid values = HeightGrid::Zero(1, 1);
  values(0, 0) = std::nan("");
  const Image map = plain_map(values, -1.0, 1.0, ColourScale::diverging, 3, 2);
  for (const std::uint8_t channel : map.rgb) EXPECT_EQ(channel, 128);
}

}  // namespace
}  // namespace sandstroke
