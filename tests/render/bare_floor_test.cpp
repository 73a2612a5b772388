// Stones and the bottom of the bed, drawn where no sand covers them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "bed_on_stones.h"
#include "render/colour_map.h"
#include "render/height_field_renderer.h"

namespace sandstroke {
namespace {

constexpr int side = 200;
constexpr double cell = 0.002;

RenderSubject view_of_floor(RenderStyle style = RenderStyle::sand, ViewName name = ViewName::top) {
  RenderSubject subject;
  subject.view.width = 320;
  subject.view.height = 180;
  subject.view.style = style;
  subject.view.name = name;
  return subject;
}

Image drawn_anew(const HeightField& surface, const RenderSubject& subject) {
  return HeightFieldRenderer(surface.rows(), surface.cols(), surface.cell_size()).render(surface, subject);
}

/// The mean colour around a position [m] in the middle of a picture from above.
std::array<double, 3> colour_at(const Image& image, double x, double y) {
  const double pixels_per_metre = 0.9 * image.height / ((side - 1) * cell * 1.024);
  const int col = static_cast<int>(0.5 * image.width + x * pixels_per_metre),
            row = static_cast<int>(0.5 * image.height - y * pixels_per_metre);
  constexpr int reach = 3;
  std::array<double, 3> mean{};
  for (int v = row - reach; v <= row + reach; ++v)
    for (int u = col - reach; u <= col + reach; ++u)
      for (int channel = 0; channel < 3; ++channel) mean[channel] += image.pixel(u, v)[channel];
  for (double& channel : mean) channel /= (2 * reach + 1) * (2 * reach + 1);
  return mean;
}

bool is_gray(const std::array<double, 3>& colour) {
  const auto [least, most] = std::minmax_element(colour.begin(), colour.end());
  return *most - *least < 22.0 && *least > 60.0;
}
/// Light and yellow.
bool is_sand(const std::array<double, 3>& colour) {
  return colour[0] > 185.0 && colour[0] - colour[2] > 45.0;
}
/// As warm as sand, but darker.
bool is_wood(const std::array<double, 3>& colour) {
  return colour[0] < 175.0 && colour[0] > 1.3 * colour[2] && colour[0] > colour[1] && colour[1] > colour[2];
}

/// A stone in a bed with a bottom, from which the sand is gone where x < -0.1 m.
HeightField stone_and_bottom() {
  constexpr double bottom = -0.01;
  HeightField bed = sand_with_a_stone(side, side, cell, 0.05, -0.02, bottom);
  for (int row = 0; row < side; ++row)
    for (int col = 0; bed.x_of(col) < -0.1; ++col) bed.set(row, col, bottom);
  return bed;
}

TEST(BareFloor, StonesAreGrayTheBottomIsOfWoodAndSandIsSand) {
  const Image image = drawn_anew(stone_and_bottom(), view_of_floor());
  const auto text = [](const std::array<double, 3>& c) {
    return std::to_string(c[0]) + " " + std::to_string(c[1]) + " " + std::to_string(c[2]);
  };
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.02, 0.02}, {-0.02, -0.02}})
    EXPECT_TRUE(is_gray(colour_at(image, x, y))) << x << ": " << text(colour_at(image, x, y));
  for (const auto& [x, y] : {std::pair{0.1, 0.0}, {0.0, 0.1}, {0.13, -0.13}})
    EXPECT_TRUE(is_sand(colour_at(image, x, y))) << x << ": " << text(colour_at(image, x, y));
  for (const auto& [x, y] : {std::pair{-0.15, 0.0}, {-0.15, 0.1}, {-0.17, -0.13}})
    EXPECT_TRUE(is_wood(colour_at(image, x, y))) << x << ": " << text(colour_at(image, x, y));
}

TEST(BareFloor, ACoverOfSandIsSeenOnceItIsAHundredthOfACellThick) {
  const HeightField bare = sand_with_a_stone(side, side, cell, 0.05, -0.02);
  std::array<double, 3> before{};
  for (const double part : {0.0, 0.4, 0.5, 0.6, 1.0, 2.0}) {
    HeightField covered = bare;
    for (int row = 85; row < 115; ++row)
      for (int col = 85; col < 115; ++col) covered.set(row, col, bare.floor(row, col) + part * 0.01 * cell);
    const std::array<double, 3> colour = colour_at(drawn_anew(covered, view_of_floor()), 0.0, 0.0);
    if (part > 0.0 && part <= 1.0) {
      EXPECT_GT(colour[0] - colour[2], before[0] - before[2] + 1.0) << part;
    }
    EXPECT_EQ(is_gray(colour), part == 0.0) << part;
    EXPECT_TRUE(is_sand(colour) || part < 1.0) << part;
    before = colour;
  }
}

TEST(BareFloor, WithoutABareFloorNothingChanges) {
  const HeightField plain = [] {
    HeightField bed(side, side, cell);
    for (int i = 30; i < 170; ++i)
      for (int j = 95; j < 105; ++j) bed.set(i, j, -0.004);
    return bed;
  }();
  for (const RenderStyle style : {RenderStyle::sand, RenderStyle::height}) {
    const RenderSubject subject = view_of_floor(style, ViewName::overview);
    const Image image = drawn_anew(plain, subject);
    HeightField on_slopes = plain;
    on_slopes.lie_on(std::make_shared<Ground>(plain, 0.6));  // a ground without a floor
    EXPECT_EQ(drawn_anew(on_slopes, subject).rgb, image.rgb);
    HeightField deep = plain;
    deep.lie_on(std::make_shared<Ground>(plain, -1.0, 0.6));
    const Image other = drawn_anew(deep, subject);
    for (std::size_t i = 0; i < image.rgb.size(); ++i) ASSERT_NEAR(other.rgb[i], image.rgb[i], 1);
  }
}

TEST(BareFloor, APictureDoesNotDependOnWhatWasDrawnBefore) {
  const HeightField stone = sand_with_a_stone(side, side, cell, 0.05, -0.02), bottom = stone_and_bottom();
  HeightField covered = stone, part = stone, without(side, side, cell), other_ground = stone;
  for (int row = 70; row < 130; ++row)
    for (int col = 70; col < 130; ++col) covered.set(row, col, 0.04);
  part.set(100, 100, part(100, 100) + 0.003);
  other_ground.lie_on(sand_with_a_stone(side, side, cell, 0.03).shared_ground());
  for (const auto& [style, name] :
       {std::pair{RenderStyle::sand, ViewName::overview}, {RenderStyle::height, ViewName::top}}) {
    const RenderSubject subject = view_of_floor(style, name);
    HeightFieldRenderer renderer(side, side, cell);
    for (const HeightField* surface : std::initializer_list<const HeightField*>{
             &stone, &part, &covered, &without, &stone, &other_ground, &bottom})
      EXPECT_EQ(renderer.render(*surface, subject).rgb, drawn_anew(*surface, subject).rgb);
    HeightField broken = stone;
    broken.set(3, 3, std::numeric_limits<double>::quiet_NaN());
    EXPECT_THROW(renderer.render(broken, subject), std::exception);
    EXPECT_EQ(renderer.render(part, subject).rgb, drawn_anew(part, subject).rgb);
  }
}

TEST(BareFloor, MapsHatchItBetweenColoursThatKeepTheirMeaning) {
  HeightField bed(side, side, cell);
  const double height = 0.3;
  bed.lie_on(std::make_shared<Ground>(bed, height, 0.6));  // all of it is bare, at one height
  const HeightGrid difference = HeightGrid::Constant(side, side, 0.5e-3);
  for (const RenderStyle style : {RenderStyle::height, RenderStyle::difference}) {
    const bool of_heights = style == RenderStyle::height;
    RenderSubject subject = view_of_floor(style);
    subject.difference = &difference;
    subject.range = of_heights ? ValueRange{0.0, 1.0} : ValueRange{-1e-3, 1e-3};
    const Image image = drawn_anew(bed, subject);
    const auto colour = of_heights ? sequential_colour(height) : diverging_colour(0.5);
    int as_in_legend = 0, pixels = 0;
    for (int y = 60; y < 120; ++y)
      for (int x = 110; x < 190; ++x, ++pixels) {
        double apart = 0.0;
        for (int channel = 0; channel < 3; ++channel)
          apart = std::max(apart, std::abs(image.pixel(x, y)[channel] - 255.0 * colour[channel]));
        as_in_legend += apart <= 1.0;
      }
    EXPECT_GT(as_in_legend, pixels / 2);
    EXPECT_LT(as_in_legend, pixels * 9 / 10) << "some of it is hatched";
  }
}

}  // namespace
}  // namespace sandstroke
