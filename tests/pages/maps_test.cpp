#include "pages/maps.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "core/error.h"
#include "core/output_file.h"
#include "io/png_file.h"
#include "pages/difference_map.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;

std::string decoded(const std::string& text) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text.substr(0, text.find('='))) {
    bits = bits << 6 | static_cast<std::uint32_t>(alphabet.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 255u);
  }
  return bytes;
}

/// The picture that a map of a page holds.
Image picture_of(const Json& map) {
  const std::string uri = map["picture"], begin = "data:image/png;base64,";
  EXPECT_EQ(uri.substr(0, begin.size()), begin);
  const TestFolder folder;
  put_text(folder / "map.png", decoded(uri.substr(begin.size())));
  Image image = read_png(folder / "map.png");
  EXPECT_EQ(map["width"], image.width);
  EXPECT_EQ(map["height"], image.height);
  return image;
}

std::vector<float> floats_of(const std::string& text) {
  const std::string bytes = decoded(text);
  std::vector<float> values;
  for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4) {
    std::uint32_t bits = 0;
    for (std::size_t k = 4; k-- > 0;) bits = bits << 8 | static_cast<std::uint8_t>(bytes[i + k]);
    values.push_back(std::bit_cast<float>(bits));
  }
  return values;
}

/// The pixels in which two pictures of one size differ, as x and y.
std::vector<std::pair<int, int>> differing(const Image& a, const Image& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  std::vector<std::pair<int, int>> found;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      if (!std::equal(a.pixel(x, y), a.pixel(x, y) + 3, b.pixel(x, y))) found.emplace_back(x, y);
  return found;
}

constexpr double cell_size = 0.01, limit = 1e-6;

HeightField level(int rows, int cols) { return HeightField(rows, cols, cell_size); }

/// A furrow in the middle of a bed, and a run of it that has one more cell raised.
ComparedSurfaces furrow(int rows, int cols, int row, int col) {
  HeightField golden = level(rows, cols);
  for (int r = rows / 2; r < rows / 2 + 3; ++r)
    for (int c = cols / 3; c < 2 * cols / 3; ++c) golden.set(r, c, -0.01);
  HeightField run = golden;
  run.set(row, col, golden(row, col) + 0.004);
  return {"Final height", golden, level(rows, cols), run, level(rows, cols), limit};
}

TEST(ShownCells, HoldWhatWasMovedAndWhatDiffersAndLeaveOutTheRest) {
  const CellRange furrow_alone = shown_cells(furrow(300, 300, 150, 150));
  EXPECT_LE(furrow_alone.row_begin, 150);
  EXPECT_GE(furrow_alone.row_end, 153);
  EXPECT_LE(furrow_alone.col_begin, 100);
  EXPECT_GE(furrow_alone.col_end, 200);
  EXPECT_LT(furrow_alone.rows(), 60);
  const CellRange with_far_cell = shown_cells(furrow(300, 300, 2, 290));
  EXPECT_LE(with_far_cell.row_begin, 2);
  EXPECT_GT(with_far_cell.col_end, 290);
  EXPECT_LE(with_far_cell.col_begin, 100);
}

TEST(ShownCells, AreTheWholeBedWhereNothingMovedOrSomethingIsNotFinite) {
  ComparedSurfaces s = furrow(30, 40, 15, 20);
  const CellRange whole{0, 30, 0, 40};
  s.golden.set(3, 3, std::nan(""));
  EXPECT_EQ(shown_cells(s), whole);
  const HeightField flat = level(30, 40);
  EXPECT_EQ(shown_cells({"Final height", flat, flat, flat, flat, limit}), whole);
}

TEST(SurfacesPart, APositionIsTheSamePixelInAllThreeMaps) {
  const int row = 152, col = 140;
  const ComparedSurfaces s = furrow(300, 300, row, col);
  const Json part = surfaces_part(s);
  ASSERT_EQ(part["maps"].size(), 3u);
  const CellRange shown = shown_cells(s);
  const std::vector<std::pair<int, int>> pixel{{col - shown.col_begin, shown.row_end - 1 - row}};
  const Image golden = picture_of(part["maps"][0]), run = picture_of(part["maps"][1]);
  EXPECT_EQ(golden.width, shown.cols());
  EXPECT_EQ(golden.height, shown.rows());
  EXPECT_EQ(differing(golden, run), pixel);
  Image without = picture_of(part["maps"][2]);
  const Image with = without;
  std::copy_n(with.pixel(0, 0), 3, without.pixel(pixel[0].first, pixel[0].second));
  EXPECT_EQ(differing(with, without), pixel);
  EXPECT_EQ(with.pixel(0, 0)[0], with.pixel(0, 0)[2]) << "white where they are equal";
  EXPECT_GT(with.pixel(pixel[0].first, pixel[0].second)[0], with.pixel(pixel[0].first, pixel[0].second)[2])
      << "red: the run is higher";
  // The ring around the largest is at the cell's centre, and the extent's corners are those of its cells.
  EXPECT_DOUBLE_EQ(part["largest"]["x"], (col - 149.5) * cell_size);
  EXPECT_DOUBLE_EQ(part["largest"]["y"], (row - 149.5) * cell_size);
  EXPECT_DOUBLE_EQ(part["extent"]["x"][0], (shown.col_begin - 150) * cell_size);
  EXPECT_DOUBLE_EQ(part["extent"]["y"][1], (shown.row_end - 150) * cell_size);
}

TEST(SurfacesPart, GoldenAndRunHaveOneScaleAndTheDifferenceOneAroundZero) {
  const Json part = surfaces_part(furrow(60, 60, 30, 30));
  const Json &golden = part["maps"][0]["scale"], &difference = part["maps"][2]["scale"];
  EXPECT_EQ(golden, part["maps"][1]["scale"]);
  EXPECT_EQ(golden["unit"], "mm");
  EXPECT_DOUBLE_EQ(golden["low"], -10.0);
  EXPECT_DOUBLE_EQ(golden["high"], 0.0);
  EXPECT_DOUBLE_EQ(difference["low"], -4.0);
  EXPECT_DOUBLE_EQ(difference["high"], 4.0);
  EXPECT_NE(golden["colours"], difference["colours"]);
}

TEST(SurfacesPart, ShowsASingleCellOfALargeBed) {
  ComparedSurfaces s = furrow(900, 3000, 2, 3);
  s.run.set(897, 2996, s.golden(897, 2996) - 0.002);
  const Json part = surfaces_part(s);
  const Image golden = picture_of(part["maps"][0]), difference = picture_of(part["maps"][2]);
  EXPECT_LE(golden.width, 1400);
  EXPECT_EQ(golden.width, difference.width);
  EXPECT_EQ(golden.height, difference.height);
  int red = 0, blue = 0;
  for (int y = 0; y < difference.height; ++y)
    for (int x = 0; x < difference.width; ++x) {
      const int warm = difference.pixel(x, y)[0] - difference.pixel(x, y)[2];
      red += warm > 60;
      blue += warm < -60;
    }
  EXPECT_GE(red, 4);
  EXPECT_GE(blue, 4);
  const std::vector<float> heights = floats_of(part["spots"]["golden"]),
                           differences = floats_of(part["spots"]["difference"]);
  ASSERT_EQ(heights.size(), differences.size());
  EXPECT_EQ(std::count(differences.begin(), differences.end(), 0.004f), 1);
  EXPECT_EQ(std::count(differences.begin(), differences.end(), -0.002f), 1);
  EXPECT_EQ(differences.front(), 0.004f) << "row 0 first";
  EXPECT_EQ(std::count(heights.begin(), heights.end(), -0.01f),
            std::count_if(heights.begin(), heights.end(), [](float h) { return h < 0.0f; }));
}

TEST(SurfacesPart, HasBothSurfacesOfDifferentShapesAndNoDifference) {
  ComparedSurfaces s = furrow(60, 40, 30, 20);
  s.run = s.run_initial = level(50, 40);
  const Json part = surfaces_part(s);
  EXPECT_EQ(part["maps"].size(), 2u);
  EXPECT_NE(part["text"].get<std::string>().find("40 x 60 cells, the run 40 x 50"), std::string::npos);
  EXPECT_FALSE(part.contains("spots"));
}

TEST(SurfacesPart, NumbersThatAreNoneAreGreyAndLeaveTheRestVisible) {
  ComparedSurfaces s = furrow(60, 60, 30, 30);
  s.run.set(5, 7, std::nan(""));
  const Json part = surfaces_part(s);
  const Image difference = picture_of(part["maps"][2]);
  const std::uint8_t* pixel = difference.pixel(7, 59 - 5);
  EXPECT_EQ(std::vector<int>(pixel, pixel + 3), (std::vector<int>{128, 128, 128}));
  EXPECT_DOUBLE_EQ(part["maps"][2]["scale"]["high"], 4.0);
  s.golden = s.run = HeightField(HeightGrid::Constant(60, 60, std::nan("")), cell_size);
  const Json of_nothing = surfaces_part(s);
  for (const Json& map : of_nothing["maps"]) {
    EXPECT_TRUE(std::isfinite(map["scale"]["low"].get<double>()));
    EXPECT_LT(map["scale"]["low"], map["scale"]["high"]);
  }
}

TEST(SurfacesPart, HasAScaleForEqualSurfacesAndNoToleranceToo) {
  ComparedSurfaces s = furrow(60, 60, 30, 30);
  s.golden = s.run;
  s.limit = 0.0;
  const Json part = surfaces_part(s);
  EXPECT_LT(part["maps"][2]["scale"]["low"], part["maps"][2]["scale"]["high"]);
  EXPECT_FALSE(part.contains("largest"));
}

TEST(SurfacesPart, ShowsWhatWasTouchedOfAHugeBed) {
  const int side = BedGeometry::most_cells;
  ComparedSurfaces s{"Final height",    level(side, side), level(side, side),
                     level(side, side), level(side, side), limit};
  EXPECT_THROW(surfaces_part(s), Error) << "all of it is too much for a page";
  for (int col = 40000; col < 40100; ++col) s.golden.set(30000, col, -0.01);
  s.run = s.golden;
  s.run.set(30050, 40050, 0.004);
  const Json part = surfaces_part(s);
  ASSERT_EQ(part["maps"].size(), 3u);
  EXPECT_LT(part["maps"][0]["width"], 200);
  EXPECT_DOUBLE_EQ(part["largest"]["x"], s.golden.x_of(40050));
}

TEST(PicturesPart, HoldsThePicturesAsTheyAreAndTheirDifference) {
  Image golden(30, 20), run(30, 20);
  for (std::size_t i = 0; i < golden.rgb.size(); ++i) golden.rgb[i] = static_cast<std::uint8_t>(i * 7);
  run.rgb = golden.rgb;
  run.pixel(11, 6)[1] = static_cast<std::uint8_t>(golden.pixel(11, 6)[1] ^ 64);
  const Json part = pictures_part("Picture", golden, run, 2);
  EXPECT_EQ(picture_of(part["maps"][0]).rgb, golden.rgb);
  EXPECT_EQ(picture_of(part["maps"][1]).rgb, run.rgb);
  EXPECT_EQ(picture_of(part["maps"][2]).rgb, picture_difference_map(golden, run, 64).rgb);
  EXPECT_EQ(part["maps"][2]["scale"]["high"], 64.0);
  EXPECT_EQ(part["largest"], Json({{"x", 11.5}, {"y", 6.5}}));
  EXPECT_EQ(pictures_part("Picture", golden, Image(30, 21), 2)["maps"].size(), 2u);
}

TEST(SurfacesPart, HasTheExtentOfABedThatIsNotSquareAndNumbersRowsFirst) {
  ComparedSurfaces s = furrow(120, 300, 70, 140);
  const Json part = surfaces_part(s);
  const CellRange shown = shown_cells(s);
  ASSERT_NE(shown.rows(), shown.cols());
  const Json& extent = part["extent"];
  EXPECT_DOUBLE_EQ(extent["x"][0], (shown.col_begin - 150) * cell_size);
  EXPECT_DOUBLE_EQ(extent["x"][1], (shown.col_end - 150) * cell_size);
  EXPECT_DOUBLE_EQ(extent["y"][0], (shown.row_begin - 60) * cell_size);
  EXPECT_DOUBLE_EQ(extent["y"][1], (shown.row_end - 60) * cell_size);
  EXPECT_EQ(part["spots"]["cells"], Json({shown.rows(), shown.cols()}));
  EXPECT_EQ(part["spots"]["side"], 1);
  EXPECT_EQ(part["spots"]["cols"], shown.cols());
  const std::vector<float> heights = floats_of(part["spots"]["golden"]),
                           differences = floats_of(part["spots"]["difference"]);
  ASSERT_EQ(heights.size(), static_cast<std::size_t>(shown.rows() * shown.cols()));
  for (int row = shown.row_begin; row < shown.row_end; ++row)
    for (int col = shown.col_begin; col < shown.col_end; ++col) {
      const auto at =
          static_cast<std::size_t>((row - shown.row_begin) * shown.cols() + col - shown.col_begin);
      ASSERT_EQ(heights[at], static_cast<float>(s.golden(row, col))) << row << ", " << col;
      ASSERT_EQ(differences[at], static_cast<float>(s.run(row, col) - s.golden(row, col)));
    }
  const std::string text = part["maps"][2]["text"];
  EXPECT_NE(text.find("Largest 0.004 m at x = -0.095 m, y = 0.105 m (row 70, col 140), limit 1e-06 m; RMS "
                      "2.108e-05 m; volume +4e-07 m³."),
            std::string::npos)
      << text;  // 4 mm / sqrt(36000); 4 mm x (10 mm)^2
}

TEST(PicturesPart, SaysWhereAndHowManyPixelsDiffer) {
  const Image golden(40, 20);
  Image run = golden;
  run.pixel(31, 5)[2] = 9;
  run.pixel(30, 5)[0] = 4;
  const Json part = pictures_part("Picture", golden, run, 2);
  EXPECT_EQ(part["extent"], Json({{"x", {0, 40}}, {"y", {20, 0}}}));
  EXPECT_EQ(part["text"], "40 x 20 pixels.");
  const std::string text = part["maps"][2]["text"];
  EXPECT_NE(text.find("Largest 9 of 255 at pixel x = 31, y = 5, limit 2; 0.25 % of the pixels differ"),
            std::string::npos)
      << text;
  EXPECT_EQ(part["maps"][2]["scale"]["low"], -9.0);
  const Json same = pictures_part("Picture", golden, golden, 7);
  EXPECT_FALSE(same.contains("largest"));
  EXPECT_EQ(same["maps"][2]["scale"]["high"], 7.0) << "the limit, where that is more";
}

TEST(SurfacesPart, TheDifferencesColoursSpanTheLimitAtLeast) {
  ComparedSurfaces s = furrow(60, 60, 30, 30);  // 4 mm apart in one cell
  for (const auto& [limit_of_it, span] : {std::pair{0.003, 4.0}, {0.005, 5.0}}) {
    s.limit = limit_of_it;
    const Json scale = surfaces_part(s)["maps"][2]["scale"];
    EXPECT_DOUBLE_EQ(scale["low"], -span);
    EXPECT_DOUBLE_EQ(scale["high"], span);
  }
}

}  // namespace
}  // namespace sandstroke
