#include "render/annotate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "render/colour_map.h"

namespace sandstroke {
namespace {

Image white(int width, int height) {
  Image image(width, height);
  std::fill(image.rgb.begin(), image.rgb.end(), std::uint8_t{255});
  return image;
}

/// Bounds of all pixels that are clearly darker than white: left, right, top, bottom.
std::array<int, 4> inked(const Image& image) {
  std::array<int, 4> bounds = {image.width, -1, image.height, -1};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.pixel(x, y)[1] > 200) continue;
      bounds = {std::min(bounds[0], x), std::max(bounds[1], x), std::min(bounds[2], y),
                std::max(bounds[3], y)};
    }
  }
  return bounds;
}

TEST(Annotate, CapitalsSpanTheCapHeightAboveTheBaseLine) {
  Image image = white(200, 100);
  draw_text(image, 20.0, 70.0, 40.0, "H", {0, 0, 0});
  const auto [left, right, top, bottom] = inked(image);
  EXPECT_NEAR(top, 30, 4);
  EXPECT_NEAR(bottom, 70, 4);
  EXPECT_GE(left, 20);
  EXPECT_LE(right, 20 + text_width(40.0, "H") + 3);
}

TEST(Annotate, WidthGrowsWithTextAndSize) {
  EXPECT_NEAR(text_width(20.0, "HH"), 2.0 * text_width(20.0, "H"), 1e-9);
  EXPECT_NEAR(text_width(30.0, "sand"), 1.5 * text_width(20.0, "sand"), 1e-9);
}

TEST(Annotate, StrokesAreSolidAndTakeTheColour) {
  Image image = white(60, 60);
  draw_text(image, 20.0, 50.0, 40.0, "I", {200, 10, 30});
  bool solid = false;
  for (int x = 0; x < 60; ++x) solid |= image.pixel(x, 30)[0] == 200 && image.pixel(x, 30)[1] == 10;
  EXPECT_TRUE(solid);
}

TEST(Annotate, TextOutsideThePictureIsCutOff) {
  Image image = white(30, 20);
  draw_text(image, -50.0, 5.0, 30.0, "sandstroke", {0, 0, 0});
  draw_text(image, 25.0, 300.0, 12.0, "below", {0, 0, 0});
  draw_text(image, 1e4, 10.0, 12.0, "right", {0, 0, 0});
  EXPECT_EQ(image.rgb.size(), 3u * 30 * 20);
}

TEST(Annotate, LettersThatTheFontLacksAreAnError) {
  Image image = white(30, 20);
  EXPECT_THROW(draw_text(image, 0.0, 10.0, 10.0, "\xc3\xa4", {0, 0, 0}), Error);
}

TEST(Annotate, LegendStaysInsideItsStrip) {
  const Legend legend{"difference", -2e-4, 2e-4, ColourScale::diverging, 5e-5};
  for (const auto& [width, height] : {std::pair{640, 360}, {1920, 1080}}) {
    Image image = white(width, height);
    draw_legend(image, legend);
    const auto [left, right, top, bottom] = inked(image);
    EXPECT_GE(left, width - legend_width(legend, height) - 1);
    EXPECT_GT(top, 0);
    EXPECT_LT(bottom, height - 1);
    EXPECT_LT(legend_width(legend, height), width / 4);
  }
}

TEST(Annotate, WhatALegendLeavesOfThePictureDoesNotDependOnItsNumbers) {
  const int width = legend_width({"height", -1e-3, 1e-3}, 720);
  for (const auto& [low, high] : {std::pair{0.0, 1e-7}, {0.0, 1e6}, {-1.00001, -1.0}})
    EXPECT_EQ(legend_width({"height", low, high}, 720), width) << high;
}

TEST(Annotate, LegendShowsNoContourLinesThatWouldTouchHoweverManyThereAre) {
  const auto drawn = [](double contour_interval) {
    Image image = white(400, 300);
    draw_legend(image, {"height", -1.0, 1.0, ColourScale::sequential, contour_interval});
    return image.rgb;
  };
  EXPECT_NE(drawn(0.1), drawn(0.0));
  for (const double interval : {1e-3, 1e-9, 1e-300}) EXPECT_EQ(drawn(interval), drawn(0.0)) << interval;
}

TEST(Annotate, LegendBarRunsThroughTheColourMap) {
  const Legend legend{"height", 0.0, 1.0, ColourScale::sequential, 0.0};
  Image image = white(800, 600);
  draw_legend(image, legend);
  const int x = 800 - legend_width(legend, 600) + static_cast<int>(1.5 * annotation_cap_height(600));
  const auto is = [&](int y, const std::array<double, 3>& colour) {
    const std::uint8_t* pixel = image.pixel(x, y);
    return std::abs(pixel[0] - 255.0 * colour[0]) < 4 && std::abs(pixel[1] - 255.0 * colour[1]) < 4 &&
           std::abs(pixel[2] - 255.0 * colour[2]) < 4;
  };
  int yellow = -1, violet = -1;
  for (int y = 0; y < 600; ++y) {
    if (yellow < 0 && is(y, sequential_colour(1.0))) yellow = y;
    if (is(y, sequential_colour(0.0))) violet = y;
  }
  ASSERT_GE(yellow, 0);
  EXPECT_GT(violet, yellow + 400);
  EXPECT_TRUE(is((yellow + violet) / 2, sequential_colour(0.5)));
}

}  // namespace
}  // namespace sandstroke
