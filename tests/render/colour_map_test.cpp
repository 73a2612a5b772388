#include "render/colour_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sandstroke {
namespace {

double brightness(const std::array<double, 3>& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

TEST(ColourMap, SequentialGetsBrighterThroughout) {
  for (int i = 0; i < 100; ++i)
    EXPECT_LT(brightness(sequential_colour(i / 100.0)), brightness(sequential_colour((i + 1) / 100.0))) << i;
}

TEST(ColourMap, SequentialEndsAreViridis) {
  EXPECT_EQ(sequential_colour(0.0), (std::array<double, 3>{0x44 / 255.0, 0x01 / 255.0, 0x54 / 255.0}));
  EXPECT_EQ(sequential_colour(1.0), (std::array<double, 3>{0xfd / 255.0, 0xe7 / 255.0, 0x25 / 255.0}));
}

TEST(ColourMap, DivergingIsBlueWhiteRed) {
  const auto negative = diverging_colour(-0.6), zero = diverging_colour(0.0),
             positive = diverging_colour(0.6);
  EXPECT_GT(negative[2], negative[0]);
  EXPECT_GT(positive[0], positive[2]);
  EXPECT_EQ(zero[0], zero[1]);
  EXPECT_EQ(zero[1], zero[2]);
  EXPECT_GT(zero[0], 0.95);
}

TEST(ColourMap, ClampsAndShowsWhatIsNoNumberInGray) {
  EXPECT_EQ(sequential_colour(-3.0), sequential_colour(0.0));
  EXPECT_EQ(sequential_colour(7.0), sequential_colour(1.0));
  EXPECT_EQ(diverging_colour(-2.0), diverging_colour(-1.0));
  EXPECT_EQ(sequential_colour(std::nan("")), (std::array<double, 3>{0.5, 0.5, 0.5}));
}

TEST(ColourMap, ScaleGoesFromLowToHigh) {
  EXPECT_EQ(scale_colour(2.0, 2.0, 6.0, ColourScale::sequential), sequential_colour(0.0));
  EXPECT_EQ(scale_colour(5.0, 2.0, 6.0, ColourScale::sequential), sequential_colour(0.75));
  EXPECT_EQ(scale_colour(0.0, -3.0, 3.0, ColourScale::diverging), diverging_colour(0.0));
}

}  // namespace
}  // namespace sandstroke
