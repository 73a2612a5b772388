#include "picture/shrunk.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sandstroke {
namespace {

TEST(Shrunk, IsTheMeanOfWhatAPixelCovers) {
  Image picture(6, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 6; ++x) picture.pixel(x, y)[1] = static_cast<std::uint8_t>(10 * x + y);
  const Image small = shrunk(picture, 3);
  ASSERT_EQ(small.width, 3);
  ASSERT_EQ(small.height, 2);
  // Columns 2, 3 and rows 0, 1: 20, 30, 21, 31; the mean, 25.5, is rounded up.
  EXPECT_EQ(small.pixel(1, 0)[1], 26);
  EXPECT_EQ(small.pixel(1, 0)[0], 0);
  EXPECT_EQ(shrunk(picture, 6).rgb, picture.rgb);
  EXPECT_EQ(shrunk(picture, 192).width, 6);
}

TEST(Shrunk, EverySizeKeepsOneColourAndItsShape) {
  for (const int width : {192, 193, 640, 1001}) {
    Image picture(width, 311);
    std::fill(picture.rgb.begin(), picture.rgb.end(), std::uint8_t{77});
    const Image small = shrunk(picture, 192);
    EXPECT_EQ(small.width, 192);
    EXPECT_NEAR(small.height, 311.0 * 192 / width, 1.0);
    for (const std::uint8_t byte : small.rgb) ASSERT_EQ(byte, 77);
  }
}

}  // namespace
}  // namespace sandstroke
