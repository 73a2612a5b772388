#include "render/height_field_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/error.h"
#include "render/colour_map.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Repeatable noise in [-1, 1].
double noise(int row, int col) {
  std::uint32_t h =
      static_cast<std::uint32_t>(row) * 2654435761u ^ static_cast<std::uint32_t>(col) * 2246822519u;
  h ^= h >> 15;
  h *= 2654435769u;
  h ^= h >> 13;
  return static_cast<double>(h) / 2147483647.5 - 1.0;
}

HeightGrid noisy(int rows, int cols, double amplitude) {
  HeightGrid heights(rows, cols);
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < cols; ++col)
      heights(row, col) = amplitude * (noise(row, col) + 3.0 * std::sin(0.11 * row) * std::sin(0.07 * col));
  return heights;
}

RenderSubject small_picture(RenderStyle style = RenderStyle::sand, ViewName name = ViewName::overview) {
  RenderSubject subject;
  subject.view.width = 320;
  subject.view.height = 180;
  subject.view.style = style;
  subject.view.name = name;
  return subject;
}

Image fresh_picture(const HeightField& surface, const RenderSubject& subject) {
  return HeightFieldRenderer(surface.rows(), surface.cols(), surface.cell_size()).render(surface, subject);
}

/// Mean of each channel over the middle half of a picture.
std::array<double, 3> mean_colour(const Image& image) {
  std::array<double, 3> sum{};
  int count = 0;
  for (int y = image.height / 4; y < 3 * image.height / 4; ++y) {
    for (int x = image.width / 4; x < 3 * image.width / 4; ++x, ++count)
      for (int channel = 0; channel < 3; ++channel) sum[channel] += image.pixel(x, y)[channel];
  }
  for (double& channel : sum) channel /= count;
  return sum;
}

std::string refusal(const HeightField& surface, const RenderSubject& subject) {
  try {
    fresh_picture(surface, subject);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(HeightFieldRenderer, SamePictureToTheBitFromEveryRenderer) {
  const HeightField surface(noisy(130, 200, 0.002), 0.01);
  for (const RenderStyle style : {RenderStyle::sand, RenderStyle::height}) {
    RenderSubject subject = small_picture(style);
    subject.tool = ToolBody{{0.1, 0.2, 0.0}, 0.05};
    HeightFieldRenderer renderer(130, 200, 0.01);
    const Image first = renderer.render(surface, subject), again = renderer.render(surface, subject);
    EXPECT_EQ(first.rgb, again.rgb);
    EXPECT_EQ(renderer.counters().tiles_changed, 0);
    EXPECT_EQ(first.rgb, fresh_picture(surface, subject).rgb);
  }
}

TEST(HeightFieldRenderer, UpdatedPictureEqualsAFreshOne) {
  const HeightGrid start = noisy(200, 270, 0.002);
  HeightGrid tower = start;
  tower.block(60, 100, 10, 10) = 0.8;  // throws a shadow over many tiles, and crosses a tile border
  HeightGrid dent = start;
  dent(190, 5) = -0.05;
  HeightFieldRenderer renderer(200, 270, 0.01);
  int step = 0;
  for (const HeightGrid& heights : {start, tower, start, dent, tower}) {
    for (const RenderStyle style : {RenderStyle::sand, RenderStyle::height}) {
      RenderSubject subject = small_picture(style);
      subject.view.light_elevation = 15.0;
      const HeightField surface(heights, 0.01);
      EXPECT_EQ(renderer.render(surface, subject).rgb, fresh_picture(surface, subject).rgb) << step;
      if (step == 2) {
        EXPECT_EQ(renderer.counters().tiles_changed, 2);  // rows 60 to 69 in columns 100 to 109
      }
      ++step;
    }
  }
}

/// A hand carves and heaps sand along its way, under a high and under a low sun, seen from above and from a
/// side.
TEST(HeightFieldRenderer, AFilmsFramesEqualFreshPicturesAndTakeFewPixels) {
  for (const double elevation : {8.0, 40.0, 90.0}) {
    for (const double sun : {8.0, 50.0}) {
      HeightGrid heights = noisy(400, 400, 0.0002);
      HeightFieldRenderer renderer(400, 400, 0.005);
      RenderSubject subject = small_picture();
      subject.view.elevation = elevation;
      subject.view.light_elevation = sun;
      subject.start = start_heights(HeightField(heights, 0.005));
      for (int frame = 0; frame < 6; ++frame) {
        const int row = 150 + 9 * frame, col = 190 + 13 * frame;
        heights.block(row, col, 5, 7) = frame % 2 ? -0.02 : 0.01;
        subject.tool = ToolBody{{0.005 * (col - 200), 0.005 * (row - 200), -0.01}, 0.015};
        const HeightField surface(heights, 0.005);
        EXPECT_EQ(renderer.render(surface, subject).rgb, fresh_picture(surface, subject).rgb)
            << elevation << " deg, sun at " << sun << " deg, frame " << frame;
        if (frame > 0 && elevation > 30.0) {
          EXPECT_LT(renderer.counters().pixels, 320 * 180 / 2);
        }
      }
      subject.tool.reset();
      const HeightField surface(heights, 0.005);
      EXPECT_EQ(renderer.render(surface, subject).rgb, fresh_picture(surface, subject).rgb);
      renderer.render(surface, subject);
      EXPECT_EQ(renderer.counters().pixels, 0);
    }
  }
}

TEST(HeightFieldRenderer, ChangedTilesAreCounted) {
  HeightFieldRenderer renderer(200, 270, 0.01);
  HeightField surface(noisy(200, 270, 0.002), 0.01);
  renderer.render(surface, small_picture());
  EXPECT_EQ(renderer.counters().tiles_changed, 4 * 5);
  surface.set(100, 100, 0.01);
  renderer.render(surface, small_picture());
  EXPECT_EQ(renderer.counters().tiles_changed, 1);
}

/// Sand that nobody touched is not computed: one heap changes one tile. The picture is that of a renderer
/// that had computed every cell, for another surface and another sun. In one bed only the first cell is at
/// another height.
TEST(HeightFieldRenderer, LevelSandCostsNothingAndLooksTheSame) {
  for (const bool odd_first : {false, true}) {
    HeightField surface(500, 450, 0.01);
    for (int row = 300; row < 312; ++row)
      for (int col = 200; col < 212; ++col) surface.set(row, col, 0.12);
    if (odd_first) surface.set(0, 0, 0.001);
    for (const double sun : {5.0, 30.0}) {
      RenderSubject subject = small_picture();
      subject.view.light_elevation = sun;
      HeightFieldRenderer fresh(500, 450, 0.01), used(500, 450, 0.01);
      const Image picture = fresh.render(surface, subject);
      EXPECT_EQ(fresh.counters().tiles_changed, odd_first ? 8 * 8 : 1);
      RenderSubject other = small_picture();
      other.view.light_elevation = 12.0;
      other.view.light_azimuth = 10.0;
      used.render(HeightField(noisy(500, 450, 0.003), 0.01), other);
      EXPECT_EQ(used.render(surface, subject).rgb, picture.rgb) << sun;
      // The shadow of a low sun goes when the sun rises.
      subject.view.light_elevation = 60.0;
      EXPECT_EQ(fresh.render(surface, subject).rgb, fresh_picture(surface, subject).rgb) << sun;
    }
  }
}

/// The wall of a round bed goes through pixels: nearly all of those have some of both colours.
TEST(HeightFieldRenderer, TheEdgeOfARoundBedIsSmooth) {
  const HeightField surface(200, 200, 0.01, BedShape::round);
  const Image picture = fresh_picture(surface, small_picture(RenderStyle::height, ViewName::top));
  using Colour = std::array<int, 3>;
  const auto colour = [&](int x, int y) {
    const std::uint8_t* rgb = picture.pixel(x, y);
    return Colour{rgb[0], rgb[1], rgb[2]};
  };
  const Colour sand = colour(picture.width / 2, picture.height / 2), wall = {204, 204, 204};
  int steps = 0, mixed = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 1; x + 1 < picture.width; ++x) {
      const Colour left = colour(x - 1, y), here = colour(x, y), right = colour(x + 1, y);
      steps += (left == wall && here == sand) || (left == sand && here == wall);
      mixed +=
          here != wall && here != sand && (left == wall || left == sand) && (right == wall || right == sand);
    }
  EXPECT_GT(mixed, 100);
  EXPECT_LT(steps, mixed / 5);
}

TEST(HeightFieldRenderer, MovedSunGivesWhatAFreshRendererGives) {
  const HeightField surface(noisy(100, 100, 0.003), 0.01);
  HeightFieldRenderer renderer(100, 100, 0.01);
  RenderSubject subject = small_picture();
  renderer.render(surface, subject);
  subject.view.light_azimuth = -30.0;
  subject.view.light_elevation = 12.0;
  EXPECT_EQ(renderer.render(surface, subject).rgb, fresh_picture(surface, subject).rgb);
}

/// Neighbouring tiles are forced to levels far apart. With all tiles at level 0 they share their border
/// vertices, so that picture has no cracks and shows where the bed must be; background well inside of that is
/// a crack.
TEST(HeightFieldRenderer, NoCracksBetweenLevelsOfDetail) {
  const HeightField surface(noisy(300, 333, 0.003), 0.01);
  HeightFieldRenderer renderer(300, 333, 0.01);
  RenderSubject subject = small_picture();
  subject.view.width = 640;
  subject.view.height = 360;
  subject.box = false;
  subject.background = {1.0, 0.0, 1.0};
  // Sand is never more blue than green, however little background shines through.
  const auto sand = [](const Image& image, int x, int y) {
    return image.pixel(x, y)[2] <= image.pixel(x, y)[1];
  };
  int pixels = 0;
  for (const double elevation : {90.0, 35.0, 8.0, 3.0}) {
    for (const double azimuth : {-90.0, -35.0, 60.0}) {
      subject.view.elevation = elevation;
      subject.view.azimuth = azimuth;
      subject.tile_levels.assign(static_cast<std::size_t>(surface.tile_count()), 0);
      const Image whole = renderer.render(surface, subject);
      for (int tile = 0; tile < surface.tile_count(); ++tile)
        subject.tile_levels[static_cast<std::size_t>(tile)] = (tile * 5 + tile / 6 * 3) % 7;
      const Image image = renderer.render(surface, subject);
      constexpr int margin = 5;
      for (int y = margin; y < image.height - margin; ++y) {
        for (int x = margin; x < image.width - margin; ++x) {
          bool inside = true;
          for (int dy = -margin; inside && dy <= margin; ++dy)
            for (int dx = -margin; inside && dx <= margin; ++dx) inside = sand(whole, x + dx, y + dy);
          if (!inside) continue;
          ++pixels;
          ASSERT_TRUE(sand(image, x, y))
              << x << ", " << y << ", elevation " << elevation << ", azimuth " << azimuth;
        }
      }
    }
  }
  EXPECT_GT(pixels, 300000);
}

TEST(HeightFieldRenderer, SymmetricSceneGivesASymmetricPicture) {
  // Cells of half a metre: a pixel is larger than every grain, which would not be symmetric.
  const int n = 200;
  HeightGrid heights(n, n);
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col) {
      const double x = col - 0.5 * (n - 1), y = row - 0.5 * (n - 1);
      // Far above z = 0, where the tint follows millimetres and the triangles' diagonals are not symmetric.
      heights(row, col) = 5.0 + 20.0 * std::exp(-(x * x + 2.0 * y * y) / 900.0) -
                          3.0 * std::exp(-(x * x) / 2000.0 - y * y / 9000.0);
    }
  RenderSubject subject = small_picture(RenderStyle::sand, ViewName::top);
  subject.view.width = subject.view.height = 200;
  subject.view.light_elevation = 90.0;
  subject.box = false;
  subject.tile_levels.assign(16, 0);  // the tiles are not symmetric, so let their detail not depend on them
  const Image image = fresh_picture(HeightField(heights, 0.5), subject);
  int least = 255, most = 0;
  for (int y = 20; y < 180; ++y) {  // inside the bed: the samples of a pixel at its border are not symmetric
    for (int x = 20; x < 180; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        ASSERT_NEAR(image.pixel(x, y)[channel], image.pixel(199 - x, y)[channel], 1) << x << " " << y;
        ASSERT_NEAR(image.pixel(x, y)[channel], image.pixel(x, 199 - y)[channel], 1) << x << " " << y;
      }
      least = std::min<int>(least, image.pixel(x, y)[0]);
      most = std::max<int>(most, image.pixel(x, y)[0]);
    }
  }
  EXPECT_GT(most - least, 10);  // something is to be seen
}

TEST(HeightFieldRenderer, DetailDropsWithDistance) {
  const HeightField surface(noisy(512, 512, 0.002), 0.002);
  HeightFieldRenderer renderer(512, 512, 0.002);
  RenderSubject subject = small_picture(RenderStyle::sand, ViewName::custom);
  std::int64_t before = std::int64_t{1} << 60;
  for (const double distance : {1.5, 3.0, 6.0, 12.0, 24.0}) {
    subject.view.distance = distance;
    renderer.render(surface, subject);
    EXPECT_EQ(renderer.counters().tiles_drawn, 64);
    EXPECT_LT(renderer.counters().triangles, before) << distance;
    before = renderer.counters().triangles;
  }
  EXPECT_LT(before, 64 * 50);
}

TEST(HeightFieldRenderer, TilesOutsideThePictureAreNotDrawn) {
  const HeightField surface(noisy(512, 512, 0.001), 0.002);
  HeightFieldRenderer renderer(512, 512, 0.002);
  RenderSubject subject = small_picture(RenderStyle::sand, ViewName::custom);
  subject.view.distance = 0.1;
  subject.view.elevation = 60.0;
  renderer.render(surface, subject);
  EXPECT_GT(renderer.counters().tiles_drawn, 0);
  EXPECT_LE(renderer.counters().tiles_drawn, 9);
}

TEST(HeightFieldRenderer, GrainDoesNotChangeTheMeanColour) {
  // Without grain: a plane whose pixels are far larger than every grain.
  const auto plane = [](double cell_size) {
    return mean_colour(
        fresh_picture(HeightField(64, 64, cell_size), small_picture(RenderStyle::sand, ViewName::top)));
  };
  const std::array<double, 3> without = plane(10.0);
  for (const double cell_size : {0.2, 0.02, 0.005, 0.001}) {  // pixels from 7 cm to 0.4 mm
    const std::array<double, 3> with = plane(cell_size);
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(with[channel], without[channel], 2.5) << cell_size;
  }
}

TEST(HeightFieldRenderer, FurrowsCastAndCatchLight) {
  HeightGrid heights = HeightGrid::Zero(256, 256);
  for (int col = 0; col < 256; ++col) {
    const double x = (col - 127.5) * 0.002;
    heights.col(col) = std::abs(x) < 0.01 ? -0.005 * (1.0 + std::cos(pi * x / 0.01)) : 0.0;
  }
  RenderSubject subject = small_picture(RenderStyle::sand, ViewName::top);
  subject.view.light_azimuth = 180.0;
  const Image image = fresh_picture(HeightField(heights, 0.002), subject);
  const auto red = [&](double x) {
    return static_cast<int>(image.pixel(static_cast<int>(160 + x * 0.9 * 180 / 0.53), 90)[0]);
  };
  EXPECT_LT(red(-0.005), red(-0.05) - 60);  // the wall next to the sun lies in shadow
  EXPECT_GT(red(0.005), red(-0.005) + 60);  // the one across is lit
}

TEST(HeightFieldRenderer, GrainsOfASteepFaceAreNoStreaks) {
  for (const double degrees : {50.0, 55.0, 60.0, 70.0, 89.0}) {
    SCOPED_TRACE(degrees);
    HeightGrid heights = HeightGrid::Zero(128, 128);
    for (int row = 0; row < 128; ++row)  // a face up to 30 mm
      heights.row(row) =
          std::clamp(0.015 + (row - 63.5) * 0.0005 * std::tan(degrees * pi / 180.0), 0.0, 0.03);
    RenderSubject subject = small_picture(RenderStyle::sand, ViewName::custom);
    subject.view.azimuth = subject.view.light_azimuth = -90.0;
    subject.view.elevation = 10.0;
    subject.view.distance = 0.05;
    subject.box = false;
    subject.view.target = {0.0, 0.0, 0.015};
    const Image image = fresh_picture(HeightField(heights, 0.0005), subject);
    double along = 0.0, upward = 0.0;  // what changes between pixels side by side, and one above the other
    for (int y = 50; y < 130; ++y)     // 180 pixels show 31 mm
      for (int x = 60; x < 260; ++x) {
        along += std::abs(image.pixel(x + 1, y)[0] - image.pixel(x, y)[0]);
        upward += std::abs(image.pixel(x, y + 1)[0] - image.pixel(x, y)[0]);
      }
    EXPECT_GT(along, 0.25 * 200 * 80) << "grains are to be seen";
    EXPECT_GT(upward, 0.5 * along);
  }
}

TEST(HeightFieldRenderer, MapColoursAreThoseOfTheLegend) {
  for (const double value : {0.1, 0.35, 0.8}) {
    RenderSubject subject = small_picture(RenderStyle::height, ViewName::top);
    subject.range = ValueRange{0.0, 1.0};
    const Image image = fresh_picture(HeightField(HeightGrid::Constant(64, 64, value), 0.05), subject);
    const auto colour = sequential_colour(value);
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(image.pixel(120, 90)[channel], 255.0 * colour[channel], 1.0) << value;
  }
  const HeightGrid difference = HeightGrid::Constant(64, 64, -0.5e-3);
  RenderSubject subject = small_picture(RenderStyle::difference, ViewName::top);
  subject.difference = &difference;
  subject.range = ValueRange{-1e-3, 1e-3};
  const Image image = fresh_picture(HeightField(64, 64, 0.05), subject);
  const auto colour = diverging_colour(-0.5);
  for (int channel = 0; channel < 3; ++channel)
    EXPECT_NEAR(image.pixel(120, 90)[channel], 255.0 * colour[channel], 1.0);
}

TEST(HeightFieldRenderer, ContourLinesLieAtTheirHeights) {
  const int n = 256;
  const double cell_size = 2.0 / n;
  HeightGrid heights(n, n);
  for (int col = 0; col < n; ++col)
    heights.col(col) = 0.1 * (col - 0.5 * (n - 1)) * cell_size;  // a slope of 1 in 10
  RenderSubject subject = small_picture(RenderStyle::height, ViewName::top);
  subject.view.width = 1280;
  subject.view.height = 720;
  subject.range = ValueRange{-0.1, 0.1};
  subject.contour_interval = 0.02;
  subject.box = false;
  const Image image = fresh_picture(HeightField(heights, cell_size), subject);
  const auto difference = [&](int x, int other) {
    int sum = 0;
    for (int channel = 0; channel < 3; ++channel)
      sum += std::abs(image.pixel(x, 360)[channel] - image.pixel(other, 360)[channel]);
    return sum;
  };
  const auto off_map = [&](int x) { return std::min(difference(x, x + 8), difference(x, x - 8)); };
  std::vector<int> lines;  // along the middle row: local peaks of what differs from the map on both sides
  for (int x = 260; x < 870; ++x)
    if (off_map(x) > 60 && off_map(x) > off_map(x - 1) && off_map(x) >= off_map(x + 1))
      if (lines.empty() || x > lines.back() + 3) lines.push_back(x);
  ASSERT_EQ(lines.size(), 9u);  // -0.08 to 0.08
  const double spacing = static_cast<double>(lines.back() - lines.front()) / 8.0;
  for (std::size_t i = 0; i < lines.size(); ++i)
    EXPECT_NEAR(lines[i], lines.front() + static_cast<double>(i) * spacing, 1.5);
}

TEST(HeightFieldRenderer, PlaneAtTheHeightOfALineHasNone) {
  RenderSubject subject = small_picture(RenderStyle::height, ViewName::top);
  subject.range = ValueRange{-1.0, 1.0};
  subject.contour_interval = 0.5;
  const Image image = fresh_picture(HeightField(64, 64, 0.05), subject);
  for (int x = 80; x < 160; ++x) EXPECT_EQ(image.pixel(x, 90)[1], image.pixel(120, 90)[1]);
}

TEST(HeightFieldRenderer, FootOfAHeapOnSuchAPlaneHasNone) {
  const int n = 128;
  HeightGrid difference(n, n);
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col)
      difference(row, col) = std::max(0.0, 0.4 - 0.8 * std::hypot(col - 63.5, row - 63.5) / 40.0);
  RenderSubject subject = small_picture(RenderStyle::difference, ViewName::top);
  subject.view.width = 640;
  subject.view.height = 360;
  subject.difference = &difference;
  subject.range = ValueRange{-0.5, 0.5};
  subject.contour_interval = 1.0;  // so the only line would be that of the plane
  const Image image = fresh_picture(HeightField(n, n, 0.01), subject);
  // Along the map's middle row the colour changes steadily, from the foot to the top and to the other foot.
  const auto green = [&](int x) { return static_cast<int>(image.pixel(x, 180)[1]); };
  for (int x = 105; x < 258; ++x) EXPECT_GE(green(x), green(x + 1)) << x;
  for (int x = 262; x < 414; ++x) EXPECT_LE(green(x), green(x + 1)) << x;
  EXPECT_LT(green(260), green(105) - 100);
}

TEST(HeightFieldRenderer, ToolIsDrawnAndThrowsItsShadowAwayFromTheSun) {
  const HeightField surface(128, 128, 0.01);
  RenderSubject subject = small_picture(RenderStyle::sand, ViewName::top);
  subject.view.light_azimuth = 180.0;
  subject.view.light_elevation = 45.0;
  HeightFieldRenderer renderer(128, 128, 0.01);
  const Image without = renderer.render(surface, subject);
  subject.tool = ToolBody{{0.0, 0.0, 0.0}, 0.1};
  const Image with = renderer.render(surface, subject);
  const double pixels_per_metre = 0.9 * 180 / (127 * 0.01 * 1.024);
  const auto change = [&](double x, double y) {
    const int col = static_cast<int>(160 + x * pixels_per_metre),
              row = static_cast<int>(90 - y * pixels_per_metre);
    return with.pixel(col, row)[0] - without.pixel(col, row)[0];
  };
  EXPECT_NE(change(0.0, 0.0), 0);
  EXPECT_LT(change(0.15, 0.0), -60);   // the centre's shadow falls 0.1 m to the right
  EXPECT_GT(change(-0.15, 0.0), -30);  // towards the sun only some sky is missing
  EXPECT_EQ(change(0.0, 0.55), change(-0.55, 0.0));
}

TEST(HeightFieldRenderer, AMeshIsDrawnWhereItIsAndRedrawnAsFromScratch) {
  const HeightField surface(128, 128, 0.01);
  RenderSubject subject = small_picture(RenderStyle::sand, ViewName::top);
  HeightFieldRenderer renderer(128, 128, 0.01);
  const Image without = renderer.render(surface, subject);
  ToolSettings box;
  box.shape = ToolShape::box;
  box.size = {0.3, 0.1, 0.05};
  const double pixels_per_metre = 0.9 * 180 / (127 * 0.01 * 1.024);
  for (const double turn : {0.0, 90.0}) {
    box.orientation.z() = turn;
    const auto mesh = std::make_shared<TriangleMesh>(turned(tool_surface(box), own_rotation(box)));
    subject.tool = ToolBody{{0.1, 0.0, 0.0}, 0.01, mesh};
    const Image with = renderer.render(surface, subject);
    EXPECT_EQ(with.rgb, fresh_picture(surface, subject).rgb);
    const auto changed = [&](double x, double y) {
      const int col = static_cast<int>(160 + x * pixels_per_metre),
                row = static_cast<int>(90 - y * pixels_per_metre);
      return with.pixel(col, row)[0] != without.pixel(col, row)[0];
    };
    const double x = turn == 0.0 ? 0.13 : 0.03, y = turn == 0.0 ? 0.03 : 0.13;  // inside, from its axis
    for (const double sx : {-x, x})
      for (const double sy : {-y, y}) EXPECT_TRUE(changed(0.1 + sx, sy)) << turn;
    EXPECT_FALSE(changed(0.1 + 1.5 * x + 0.03, 0.0));
    EXPECT_FALSE(changed(0.1, 1.5 * y + 0.03));
  }
}

TEST(HeightFieldRenderer, RefusesWhatItCannotDraw) {
  const HeightField surface(64, 64, 0.01);
  RenderSubject subject = small_picture();
  subject.view.width = 8;
  EXPECT_NE(refusal(surface, subject).find("8 x 180"), std::string::npos);
  subject.view.width = 10000;
  EXPECT_NE(refusal(surface, subject).find("10000 x 180"), std::string::npos);
  subject = small_picture();
  subject.view.light_elevation = 0.0;
  EXPECT_NE(refusal(surface, subject).find("light_elevation"), std::string::npos);
  subject = small_picture(RenderStyle::difference);
  EXPECT_NE(refusal(surface, subject).find("difference"), std::string::npos);
  const HeightGrid other = HeightGrid::Zero(63, 64);
  subject.difference = &other;
  EXPECT_NE(refusal(surface, subject).find("64 x 64"), std::string::npos);
  subject = small_picture(RenderStyle::height);
  subject.range = ValueRange{1.0, 1.0};
  EXPECT_NE(refusal(surface, subject).find("scale"), std::string::npos);
  EXPECT_NE(refusal(HeightField(1, 64, 0.01), small_picture()).find("64 x 1"), std::string::npos);
  EXPECT_NE(refusal(HeightField(2, 20000, 0.01), small_picture()).find("20000 x 2"), std::string::npos);
  HeightField broken(64, 64, 0.01);
  broken.set(3, 3, std::nan(""));
  EXPECT_NE(refusal(broken, small_picture()).find("not finite"), std::string::npos);
  HeightFieldRenderer renderer(64, 64, 0.01);
  EXPECT_THROW(renderer.render(HeightField(64, 65, 0.01), small_picture()), Error);
}

TEST(HeightFieldRenderer, DrawsBedsOfEveryShape) {
  for (const auto& [rows, cols] : {std::pair{2, 2}, {2, 200}, {65, 64}, {129, 3}}) {
    for (const ViewName name : {ViewName::overview, ViewName::stroke, ViewName::top}) {
      const Image image =
          fresh_picture(HeightField(rows, cols, 0.01), small_picture(RenderStyle::sand, name));
      EXPECT_NE(image.pixel(160, 90)[0], image.pixel(160, 90)[2])
          << rows << " x " << cols;  // sand in the middle
    }
  }
}

}  // namespace
}  // namespace sandstroke
