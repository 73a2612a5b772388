// Talus angles by place from a file: each format gives tan of the angles that were written, other cells have
// the mean of it, and what would be taken wrongly is refused or told.
#include "io/sand_map_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/error.h"
#include "core/warning.h"
#include "hdf5/hdf5_writer.h"
#include "io/input_kind.h"
#include "io/map_files.h"
#include "io/png_file.h"
#include "kept_log.h"
#include "sand/make_ground.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

constexpr double no_angle = std::numeric_limits<double>::quiet_NaN();

BedSettings bed_of_cells(int rows, int cols) {
  BedSettings bed;
  bed.rows = rows;
  bed.cols = cols;
  bed.width = 3.0;
  bed.depth = 3.0 * rows / cols;
  return bed;
}

/// Whole degrees from 20 to 39.
HeightGrid some_angles(int rows, int cols) {
  return HeightGrid::NullaryExpr(
      rows, cols, [](auto row, auto col) { return 20.0 + static_cast<double>((7 * row + 3 * col) % 20); });
}

HeightGrid slopes_of(const HeightGrid& angles) {
  return angles.unaryExpr([](double angle) { return talus_slope(angle); });
}

class SandMapFile : public testing::Test {
 protected:
  SandMapFile() { map_.file = "map"; }

  HeightGrid load(const BedSettings& bed) {
    GroundSettings ground;
    ground.map = map_;
    return *with_sand_map(ground, bed, folder_.path()).map->slopes;
  }
  void expect_refused(const BedSettings& bed, const std::vector<std::string>& parts) {
    try {
      load(bed);
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      const std::string sentence = error.what();
      EXPECT_EQ(sentence.find((folder_ / map_.file).string() + ": "), 0u) << sentence;
      for (const std::string& part : parts)
        EXPECT_NE(sentence.find(part), std::string::npos) << part << "\n" << sentence;
    }
  }
  /// A picture, whose black and white are to be 0 and 1.
  void put_picture(const HeightGrid& shares) {
    map_.file = "map.png";
    put_text(folder_ / "map.png", encode_height_png(shares, {0.0, 1.0}));
  }
  void put_array(const HeightGrid& angles, bool by_columns = false) {
    put_text(folder_ / "map", npy_bytes<double>(angles, "<f8", by_columns));
  }

  TestFolder folder_;
  SandMap map_;
};

TEST_F(SandMapFile, EachFormatGivesTheSlopesOfItsAngles) {
  const HeightGrid angles = some_angles(4, 6);
  const std::vector<std::function<void()>> formats = {
      [&] { put_text(folder_ / "map", esri_text(angles, 25.0)); },  // of any size: it covers the bed
      [&] { put_array(angles); },
      [&] { put_array(angles, true); },
      [&] { put_text(folder_ / "map", npy_bytes<std::uint8_t>(angles, "|u1")); },
      [&] {
        write_tiff<float>(folder_ / "map", angles, {.pixel_scale = {3.0, 3.0, 0.0}});
      },
  };
  for (const auto& write : formats) {
    write();
    EXPECT_TRUE((load(bed_of_cells(4, 6)) == slopes_of(angles)).all());
  }
}

TEST_F(SandMapFile, APictureHasTheAnglesOfBlackAndWhite) {
  HeightGrid shares(2, 3);
  shares << 0.0, 1.0, 0.2, 0.8, 0.4, 0.0;
  put_picture(shares);
  expect_refused(bed_of_cells(2, 3), {"does not say its angles; set sand.map.low and sand.map.high"});
  map_.low = 25.0;
  expect_refused(bed_of_cells(2, 3), {"set sand.map.low and sand.map.high"});
  map_.high = 35.0;
  const HeightGrid slopes = load(bed_of_cells(2, 3));
  EXPECT_EQ(slopes(0, 0), talus_slope(25.0));
  EXPECT_EQ(slopes(0, 1), talus_slope(35.0));
  EXPECT_NEAR(slopes(1, 0), talus_slope(33.0), 1e-14);
  map_.low = 35.0;  // white may be the flatter one
  map_.high = 25.0;
  EXPECT_EQ(load(bed_of_cells(2, 3))(0, 1), talus_slope(25.0));
  map_.high = 35.0;  // the same sand everywhere
  EXPECT_TRUE((load(bed_of_cells(20, 30)) == talus_slope(35.0)).all());
}

TEST_F(SandMapFile, ACellHasTheMeanOfTan) {
  HeightGrid angles(2, 4);
  angles << 20.0, 40.0, 30.0, 50.0, 20.0, 40.0, 10.0, 60.0;
  put_array(angles);
  const HeightGrid slopes = load(bed_of_cells(1, 2));
  EXPECT_NEAR(slopes(0, 0), 0.5 * (talus_slope(20.0) + talus_slope(40.0)), 1e-15);
  EXPECT_NEAR(slopes(0, 1),
              0.25 * (talus_slope(30.0) + talus_slope(50.0) + talus_slope(10.0) + talus_slope(60.0)), 1e-15);
  // Split, they stay.
  const HeightGrid split = load(bed_of_cells(10, 20));
  for (int row = 0; row < 10; ++row)
    for (int col = 0; col < 20; ++col)
      ASSERT_EQ(split(row, col), talus_slope(angles(row / 5, col / 5))) << row << " " << col;
  put_array(HeightGrid::Constant(21, 30, 34.0));
  for (const int cells : {10, 20, 30, 70})
    EXPECT_TRUE((load(bed_of_cells(7 * cells / 10, cells)) == talus_slope(34.0)).all()) << cells;
}

TEST_F(SandMapFile, ASeamOnFacesIsThatOfARegionToTheBit) {
  HeightGrid angles = HeightGrid::Constant(60, 90, 25.0);
  angles.rightCols(45).setConstant(35.0);
  put_array(angles);
  GroundSettings by_map, by_region;
  by_map.map = map_;
  by_region.regions.resize(1);
  by_region.regions[0].centre = {50.0, 0.0};
  by_region.regions[0].size = {100.0, 100.0};
  by_region.regions[0].talus_angle = 35.0;
  for (const int cols : {30, 54, 90, 150}) {  // even: the seam is between cells
    BedSettings bed = bed_of_cells(2 * cols / 3, cols);
    bed.width = 0.125 * bed.cols;  // so that the region's edge is exactly there
    bed.depth = 0.125 * bed.rows;
    const BedGeometry geometry(bed.rows, bed.cols, bed.cell_size());
    const auto one = make_ground(geometry, with_sand_map(by_map, bed, folder_.path()), talus_slope(25.0)),
               other = make_ground(geometry, by_region, talus_slope(25.0));
    EXPECT_TRUE((one->talus_slopes.grid() == other->talus_slopes.grid()).all()) << cols;
  }
}

TEST_F(SandMapFile, IsReadAnewForOtherCellsOnly) {
  put_array(some_angles(40, 60));
  GroundSettings ground;
  ground.map = map_;
  const GroundSettings coarse = with_sand_map(ground, bed_of_cells(20, 30), folder_.path());
  EXPECT_EQ(with_sand_map(coarse, bed_of_cells(20, 30), folder_.path()).map->slopes, coarse.map->slopes);
  EXPECT_TRUE((*with_sand_map(coarse, bed_of_cells(40, 60), folder_.path()).map->slopes ==
               slopes_of(some_angles(40, 60)))
                  .all());
  EXPECT_FALSE(with_sand_map({}, bed_of_cells(20, 30), folder_.path()).map);
  const std::string hash = sand_map_hash(coarse);
  EXPECT_EQ(sand_map_hash(with_sand_map(ground, bed_of_cells(20, 30), folder_.path())), hash);
  HeightGrid other = some_angles(40, 60);
  other(39, 59) += 1e-9;
  put_array(other);
  EXPECT_NE(sand_map_hash(with_sand_map(ground, bed_of_cells(20, 30), folder_.path())), hash);
  EXPECT_EQ(sand_map_hash(ground), "");
}

TEST_F(SandMapFile, ValuesThatAreNoAnglesAreRefused) {
  for (const double wrong : {0.0, -1.0, 90.0, 255.0, -9999.0, std::numeric_limits<double>::infinity()}) {
    HeightGrid angles = some_angles(4, 6);
    angles(1, 2) = angles(3, 3) = wrong;
    put_array(angles);
    map_.nodata = 30.0;
    expect_refused(bed_of_cells(4, 6), {fmt::format("2 cells have values that are not between 0 and 90, such "
                                                    "as {}; give angles in degrees",
                                                    wrong)});
  }
  put_array(HeightGrid::Constant(4, 6, no_angle));
  expect_refused(bed_of_cells(4, 6), {"no cell has a talus angle"});
  put_array(some_angles(4, 6));
  map_.low = 20.0;
  expect_refused(bed_of_cells(4, 6), {"sand.map.low and high are for pictures"});
  map_.low.reset();
  // 0.1 and 89.9 degrees are angles.
  HeightGrid steep = some_angles(4, 6);
  steep(0, 0) = 0.1;
  steep(3, 5) = 89.9;
  put_array(steep);
  EXPECT_TRUE((load(bed_of_cells(4, 6)) == slopes_of(steep)).all());
}

TEST_F(SandMapFile, FilesThatAreNoMapsAreRefused) {
  { Hdf5Writer(folder_ / "map", output_kind(InputKind::run)).finish(); }
  expect_refused(bed_of_cells(4, 6), {"a run file holds no talus angles; give a 16-bit grayscale PNG"});
  put_text(folder_ / "map", "[bed]\n");
  expect_refused(bed_of_cells(4, 6), {"is no map that sandstroke reads; save the talus angles as"});
  map_.file = "map.csv";
  put_text(folder_ / "map.csv", "1,2\n");
  expect_refused(bed_of_cells(4, 6), {"numpy.save"});
  map_.file = "map.png";
  map_.low = map_.high = 30.0;
  Image picture(6, 4);
  write_png(folder_ / "map.png", picture);
  expect_refused(bed_of_cells(4, 6), {"16-bit grayscale PNG"});
  put_picture(HeightGrid::Constant(4, 5, 0.5));
  expect_refused(bed_of_cells(4, 6), {"5 x 4 cells, which a bed of 3 m by 2 m cannot have without "
                                      "distortion; cut the map, or set bed.size = [3, 2.4] and bed.cells"});
  map_.file = "map";
  map_.low.reset();
  map_.high.reset();
  put_text(folder_ / "map", esri_text(some_angles(4, 5), 2.0));
  expect_refused(bed_of_cells(4, 6), {"5 x 4 cells of 2 x 2 m", "set bed.size = [3, 2.4] and bed.cells"});
}

TEST_F(SandMapFile, CellsWithoutDataAreRefusedOrSet) {
  HeightGrid angles = some_angles(4, 6);
  angles(1, 2) = angles(3, 3) = no_angle;
  put_array(angles);
  expect_refused(bed_of_cells(4, 6), {"2 of the bed's 24 cells have no talus angle", "set sand.map.nodata"});
  expect_refused(bed_of_cells(2, 3), {"2 of the bed's 6 cells have no talus angle"});
  map_.nodata = 31.0;
  const HeightGrid filled = angles.isNaN().select(31.0, angles);
  EXPECT_TRUE((load(bed_of_cells(4, 6)) == slopes_of(filled)).all());
  put_array(filled);
  const HeightGrid whole = load(bed_of_cells(2, 3));
  put_array(angles);
  EXPECT_TRUE((load(bed_of_cells(2, 3)) == whole).all());
  // The transparent gray of a picture.
  std::string png =
      encode_height_png(angles.isNaN().select(1.0, HeightGrid::Constant(4, 6, 0.5)), {0.0, 1.0});
  png.insert(png.find("IDAT") - 4, png_chunk("tRNS\xFF\xFF"));
  map_.file = "map.png";
  map_.low = map_.high = 25.0;
  put_text(folder_ / "map.png", png);
  EXPECT_TRUE((load(bed_of_cells(4, 6)) ==
               angles.isNaN().select(talus_slope(31.0), HeightGrid::Constant(4, 6, talus_slope(25.0))))
                  .all());
}

TEST_F(SandMapFile, BeyondTheWallOfARoundBedNoDataIsNeeded) {
  BedSettings bed = bed_of_cells(20, 20);
  const BedGeometry round(20, 20, bed.cell_size(), BedShape::round);
  HeightGrid angles = some_angles(20, 20);
  for (int row = 0; row < 20; ++row)
    for (int col = 0; col < 20; ++col)
      if (!round.has_sand(row, col)) angles(row, col) = no_angle;
  put_array(angles);
  expect_refused(bed, {"set bed.shape = \"round\""});
  bed.shape = BedShape::round;
  const HeightGrid slopes = load(bed);
  EXPECT_TRUE((angles.isNaN() || slopes == slopes_of(angles)).all());
  EXPECT_TRUE((slopes > talus_slope(19.0) && slopes < talus_slope(40.0)).all());
  angles(10, 10) = no_angle;
  put_array(angles);
  expect_refused(bed, {"1 of the bed's 400 cells have no talus angle"});
}

TEST_F(SandMapFile, TheLogSaysWhatWasRead) {
  const KeptLog log;
  put_text(folder_ / "map", esri_text(some_angles(4, 6), 25.0));
  load(bed_of_cells(20, 30));
  put_array(HeightGrid::Constant(20, 30, 30.0));
  load(bed_of_cells(20, 30));
  map_.file = "map.png";
  map_.low = 25.0;
  map_.high = 35.0;
  HeightGrid dark = HeightGrid::Constant(20, 30, 0.5);
  dark(0, 0) = 0.0;
  put_picture(dark);
  load(bed_of_cells(20, 30));
  const std::string name = (folder_ / "map").string();
  EXPECT_EQ(log.text(),
            name + ": 6 x 4 cells of 25 m fitted to 30 x 20 cells of 0.1 m; talus angles 20 to 39 deg\n" +
                name + ": 30 x 20 cells; talus angle 30 deg; its first row is at the smallest y\n" + name +
                ".png: 30 x 20 cells; talus angles 25 to 30 deg\n");
}

TEST_F(SandMapFile, RadiansAndSlopesAreDoubted) {
  const WarningList given;
  const HeightGrid angles = some_angles(4, 6);
  put_array(angles);
  load(bed_of_cells(4, 6));
  EXPECT_TRUE(given.warnings().empty());
  put_array(slopes_of(angles));
  load(bed_of_cells(4, 6));
  put_array(angles * 0.0174533);
  load(bed_of_cells(4, 6));
  ASSERT_EQ(given.warnings().size(), 2u);
  for (const Warning& warning : given.warnings()) {
    EXPECT_EQ(warning.code, WarningCode::map_radians);
    EXPECT_NE(warning.text.find("numpy.degrees"), std::string::npos) << warning.text;
  }
}

}  // namespace
}  // namespace sandstroke
