// Beds that begin as a map: each format gives the heights that were written, other cells keep the volume, and
// what would be taken wrongly is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

#include "core/error.h"
#include "io/map_files.h"
#include "io/png_file.h"
#include "io/surface_file.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Heights of whole centimetres, so that whole numbers hold them, too; `step` [m] per level.
HeightGrid levels(int rows, int cols, int highest, double step, unsigned seed = 1) {
  std::mt19937 random(seed);
  return HeightGrid::NullaryExpr(
      rows, cols, [&] { return step * static_cast<double>(random() % static_cast<unsigned>(highest + 1)); });
}

/// A bed of these cells, of `cell` m each, that begins as the file "map".
BedSettings bed_of(int rows, int cols, double cell, const std::string& file = "map") {
  BedSettings bed;
  bed.rows = rows;
  bed.cols = cols;
  bed.width = cell * cols;
  bed.depth = cell * rows;
  bed.surface.kind = SurfaceKind::file;
  bed.surface.file = file;
  return bed;
}

class SurfaceMap : public ::testing::Test {
 protected:
  HeightGrid load(const BedSettings& bed) { return load_surface(bed, folder_.path()).grid(); }
  std::string refusal(const BedSettings& bed) {
    try {
      load(bed);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
      return error.what();
    }
    return "";
  }
  void expect_refused(const BedSettings& bed, const std::vector<std::string>& parts) {
    const std::string sentence = refusal(bed);
    for (const std::string& part : parts)
      EXPECT_NE(sentence.find(part), std::string::npos) << part << "\n" << sentence;
    EXPECT_NE(sentence.find(bed.surface.file), std::string::npos) << sentence;
  }
  fs::path file(const std::string& name) { return folder_ / name; }

  TestFolder folder_;
};

TEST_F(SurfaceMap, EachFormatGivesTheHeightsThatWereWritten) {
  const HeightGrid h = levels(5, 7, 9, 1.0);
  const auto put = [&](const std::string& bytes) { put_text(file("map"), bytes); };
  const TiffOptions placed{.pixel_scale = {1.0, 1.0, 0.0}};
  const auto with = [&](auto change) {
    TiffOptions is = placed;
    change(is);
    return is;
  };
  const auto map = file("map");
  const std::vector<std::pair<const char*, std::function<void()>>> formats = {
      {"asc", [&] { put(esri_text(h, 1.0)); }},
      {"npy f8", [&] { put(npy_bytes<double>(h, "<f8")); }},
      {"npy big endian", [&] { put(npy_bytes<double>(h, ">f8")); }},
      {"npy f4", [&] { put(npy_bytes<float>(h, "<f4")); }},
      {"npy columns", [&] { put(npy_bytes<float>(h, ">f4", true)); }},
      {"npy i2", [&] { put(npy_bytes<std::int16_t>(h, ">i2")); }},
      {"npy u1", [&] { put(npy_bytes<std::uint8_t>(h, "|u1", true)); }},
      {"npy i8", [&] { put(npy_bytes<std::int64_t>(h, "<i8")); }},
      {"tiff float", [&] { write_tiff<float>(map, h); }},
      {"tiff double", [&] { write_tiff<double>(map, h, placed); }},
      {"tiff i2", [&] { write_tiff<std::int16_t>(map, h); }},
      {"tiff u2", [&] { write_tiff<std::uint16_t>(map, h, placed); }},
      {"tiff i4", [&] { write_tiff<std::int32_t>(map, h, placed); }},
      {"tiff tiles", [&] { write_tiff<float>(map, h, with([](auto& is) { is.tile = 16; })); }},
      {"tiff big endian", [&] { write_tiff<float>(map, h, with([](auto& is) { is.mode = "wb"; })); }},
      {"tiff 64 bits", [&] { write_tiff<float>(map, h, with([](auto& is) { is.mode = "w8"; })); }},
      {"tiff lzw",
       [&] { write_tiff<float>(map, h, with([](auto& is) { is.compression = COMPRESSION_LZW; })); }},
      {"tiff deflate",
       [&] {
         write_tiff<float>(map, h,
                           with([](auto& is) { is.compression = COMPRESSION_ADOBE_DEFLATE, is.tile = 32; }));
       }},
      {"tiff by a matrix",
       [&] {
         write_tiff<float>(map, h, {.transformation = {1, 0, 0, 5, 0, -1, 0, 7, 0, 0, 0, 0, 0, 0, 0, 1}});
       }},
      {"tiff in metres",
       [&] {
         write_tiff<float>(map, h, with([](auto& is) {
                             is.geo_keys = {1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3076, 0, 1, 9001};
                           }));
       }},
      {"tiff with heights in metres",
       [&] {
         write_tiff<float>(map, h, with([](auto& is) {
                             is.metadata =
                                 "<GDALMetadata><Item name=\"UNITTYPE\" "
                                 "role=\"unittype\">metre</Item></GDALMetadata>";
                           }));
       }},
      {"tiff with an overview",
       [&] { write_tiff<float>(map, h, with([](auto& is) { is.second_page = FILETYPE_REDUCEDIMAGE; })); }},
  };
  for (const auto& [name, write] : formats) {
    SCOPED_TRACE(name);
    write();
    EXPECT_TRUE((load(bed_of(5, 7, 1.0)) == h).all());
  }
  // The first row of a TIFF may have the smallest y.
  write_tiff<float>(map, h, {.transformation = {1, 0, 0, 5, 0, 1, 0, 7, 0, 0, 0, 0, 0, 0, 0, 1}});
  EXPECT_TRUE((load(bed_of(5, 7, 1.0)) == h.colwise().reverse()).all());
}

TEST_F(SurfaceMap, AnEsriGridMayBeWrittenInManyWays) {
  HeightGrid h(2, 3);
  h << 0.25, -1.5, 2, 1e-3, 0, 3;  // the second row of the file is the first of the grid
  const std::string rows = "0.001 0 3\n0.25 -1.5 2\n";
  for (const std::string& text : {
           "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 0.5\n" + rows,
           "NCOLS 3\r\nNROWS 2\r\nXLLCENTER 0\r\nYLLCENTER 0\r\nCELLSIZE 0.5\r\nNODATA_VALUE -1\r\n" + rows,
           "\xEF\xBB\xBFncols\t3\nnrows\t2\ncellsize\t5e-1\nNODATA_value nan\n" + rows,
           "nrows 2\nncols 3\ndx 0.5\ndy 0.5\n" + rows,
           std::string("ncols 3 nrows 2 cellsize 0.5\n+0.001 0.0\n3.0 .25\n-1.5e0 2"),
       }) {
    put_text(file("map"), text);
    EXPECT_TRUE((load(bed_of(2, 3, 0.5)) == h).all()) << text;
  }
  put_text(file("map"), "ncols 3\nnrows 2\ndx 0.5\ndy 1.0\n" + rows);  // cells that are not square
  const HeightGrid finer = load(bed_of(4, 3, 0.5));
  for (int row = 0; row < 4; ++row) EXPECT_TRUE((finer.row(row) == h.row(row / 2)).all());
}

/// The plain mean over parts that both grids are made of.
HeightGrid reference_means(const HeightGrid& map, int rows, int cols) {
  const auto height = std::lcm<int>(static_cast<int>(map.rows()), rows),
             width = std::lcm<int>(static_cast<int>(map.cols()), cols);
  HeightGrid sums = HeightGrid::Zero(rows, cols);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      sums(y * rows / height, x * cols / width) += map(y * map.rows() / height, x * map.cols() / width);
  return sums * (static_cast<double>(rows) * cols / (static_cast<double>(height) * width));
}

TEST_F(SurfaceMap, OtherCellsHaveMeansOfTheMapAndItsVolume) {
  for (const auto& [rows, cols] :
       {std::pair{2, 3}, {4, 6}, {14, 21}, {22, 33}, {20, 30}, {100, 150}, {1, 1}}) {
    for (const bool columns : {false, true}) {
      const HeightGrid map = levels(rows, cols, 1000, 1e-3);
      put_text(file("map"), npy_bytes<double>(map, "<f8", columns));
      BedSettings bed = bed_of(20, 30, 0.01);
      if (rows == 1) bed = bed_of(30, 30, 0.01);
      const HeightGrid heights = load(bed);
      EXPECT_LT((heights - reference_means(map, bed.rows, bed.cols)).abs().maxCoeff(), 1e-14) << rows;
      EXPECT_NEAR(heights.mean() / map.mean(), 1.0, 1e-13) << rows;
    }
  }
  // To a part of a cell: 1201 x 801 cells are no 3 : 2.
  const HeightGrid odd = levels(801, 1201, 1000, 1e-3);
  put_text(file("map"), npy_bytes<double>(odd, "<f8"));
  EXPECT_NEAR(load(bed_of(100, 150, 0.002)).mean() / odd.mean(), 1.0, 1e-12);
}

TEST_F(SurfaceMap, AMapOfAnotherSizeAsksForItsScale) {
  const HeightGrid map = levels(5, 10, 20, 1.0);
  put_text(file("map"), esri_text(map, 10.0));
  BedSettings bed = bed_of(50, 100, 0.002);
  expect_refused(bed, {"is 100 m by 50 m", "bed is 0.2 m by 0.1 m", "bed.surface.scale = 0.002"});
  bed.surface.scale = 0.002;
  const HeightGrid heights = load(bed);
  for (int row = 0; row < 50; ++row)
    for (int col = 0; col < 100; ++col)
      ASSERT_NEAR(heights(row, col), 0.002 * map(row / 10, col / 10), 1e-15);
  bed.surface.low = -0.01;
  bed.surface.high = 0.03;
  EXPECT_EQ(load(bed).minCoeff(), -0.01);
  EXPECT_EQ(load(bed).maxCoeff(), 0.03);
  bed.surface.scale = 0.003;
  expect_refused(bed, {"is 0.3 m by 0.15 m at bed.surface.scale = 0.003", "bed.surface.scale = 0.002"});
  // Proportions that no scale mends.
  expect_refused(bed_of(50, 80, 0.002), {"has 10 x 5 cells of 10 x 10 m", "bed.size = [0.16, 0.08]"});
  put_text(file("map"), npy_bytes<double>(map, "<f8"));
  expect_refused(bed_of(50, 80, 0.002), {"has 10 x 5 cells,", "bed.size = [0.16, 0.08]"});
}

TEST_F(SurfaceMap, ATiffOfGrayNeedsTheHeightsOfBlackAndWhite) {
  HeightGrid gray(1, 3);
  gray << 0, 65535, 13107;
  write_tiff<std::uint16_t>(file("map"), gray);
  BedSettings bed = bed_of(1, 3, 0.1);
  expect_refused(bed, {"bed.surface.low and high are both 0 m"});
  bed.surface.low = -0.01;
  bed.surface.high = 0.03;
  const HeightGrid heights = load(bed);
  EXPECT_EQ(heights(0, 0), -0.01);
  EXPECT_EQ(heights(0, 1), 0.03);
  EXPECT_NEAR(heights(0, 2), -0.002, 1e-17);
  bed.surface.scale = 0.5;
  expect_refused(bed, {"bed.surface.scale = 0.5 does nothing"});
}

TEST_F(SurfaceMap, TheTransparentGrayOfAPngIsNoData) {
  HeightGrid h = levels(4, 4, 65534, 1e-6);
  h(2, 1) = h(0, 3) = 65535e-6;
  std::string png = encode_height_png(h, {0.0, 65535e-6});
  png.insert(png.find("IDAT") - 4, png_chunk("tRNS\xFF\xFF"));
  put_text(file("map.png"), png);
  BedSettings bed = bed_of(4, 4, 0.1, "map.png");
  expect_refused(bed, {"2 of the bed's 16 cells have no height"});
  bed.surface.nodata = 0.025;
  EXPECT_LT((load(bed) - (h == 65535e-6).select(0.025, h)).abs().maxCoeff(), 1e-15);
}

TEST_F(SurfaceMap, CellsWithoutDataAreCountedOrFilled) {
  HeightGrid h = levels(6, 6, 9, 0.01);
  h(0, 0) = h(0, 1) = h(5, 3) = -9999.0;
  HeightGrid holes = (h == -9999.0).select(nan, h), filled = (h == -9999.0).select(0.025, h);
  const HeightGrid lowest = (h == -9999.0).select(-3.4028234663852886e38, h);
  const HeightGrid infinite = (h == -9999.0).select(-std::numeric_limits<double>::infinity(), h);
  const TiffOptions is{.pixel_scale = {0.1, 0.1, 0.0}, .no_data = "-9999"};
  const std::vector<std::function<void()>> formats = {
      [&] { put_text(file("map"), esri_text(h, 0.1, "NODATA_value -9999\n")); },
      [&] { put_text(file("map"), esri_text(h, 0.1)); },  // the format's own number for no data
      [&] { put_text(file("map"), esri_text(holes, 0.1)); },
      [&] { put_text(file("map"), esri_text((h == -9999.0).select(-nan, h), 0.1)); },
      [&] { put_text(file("map"), esri_text(lowest, 0.1, "NODATA_value -3.40282346639e+38\n")); },
      [&] { put_text(file("map"), npy_bytes<double>(holes, "<f8")); },
      [&] { put_text(file("map"), npy_bytes<double>(holes, "<f8", true)); },
      [&] { write_tiff<double>(file("map"), h, is); },
      [&] { write_tiff<double>(file("map"), holes); },
      [&] { write_tiff<double>(file("map"), infinite, {.no_data = "-inf"}); },
  };
  for (std::size_t i = 0; i < formats.size(); ++i) {
    SCOPED_TRACE(i);
    formats[i]();
    BedSettings bed = bed_of(6, 6, 0.1);
    expect_refused(bed, {"3 of the bed's 36 cells have no height", "bed.surface.nodata"});
    bed.surface.nodata = 0.025;
    EXPECT_TRUE((load(bed) == filled).all());
    // Filled first, then fitted to other cells.
    bed = bed_of(9, 9, 0.6 / 9);
    expect_refused(bed, {"of the bed's 81 cells have no height"});
    bed.surface.nodata = 0.025;
    EXPECT_LT((load(bed) - reference_means(filled, 9, 9)).abs().maxCoeff(), 1e-15);
    bed.surface.low = 0.1;
    bed.surface.high = 0.2;
    const double first = holes.isNaN().select(1.0, h).minCoeff(),
                 last = holes.isNaN().select(-1.0, h).maxCoeff();
    const HeightGrid raised = holes.isNaN().select(0.025, 0.1 + 0.1 * (h - first) / (last - first));
    EXPECT_LT((load(bed) - reference_means(raised, 9, 9)).abs().maxCoeff(), 1e-15);
  }
}

TEST_F(SurfaceMap, AMapWithoutAnyHeightIsRefused) {
  put_text(file("map"), npy_bytes<double>(HeightGrid::Constant(4, 4, nan), "<f8"));
  BedSettings bed = bed_of(4, 4, 0.05);
  expect_refused(bed, {"no cell has a height"});
  bed.surface.nodata = 0.01;
  bed.surface.high = 0.02;
  expect_refused(bed, {"no cell has a height"});
}

TEST_F(SurfaceMap, BeyondTheWallOfARoundBedNoDataIsNeeded) {
  const BedGeometry round(20, 20, 0.01, BedShape::round);
  HeightGrid h = levels(20, 20, 9, 0.001);
  for (int row = 0; row < 20; ++row)
    for (int col = 0; col < 20; ++col)
      if (!round.has_sand(row, col)) h(row, col) = -9999.0;
  put_text(file("map"), esri_text(h, 0.01));
  BedSettings bed = bed_of(20, 20, 0.01);
  expect_refused(bed, {"set bed.shape = \"round\""});
  bed.shape = BedShape::round;
  const HeightGrid heights = load(bed);
  EXPECT_TRUE(((heights == h) || (heights == 0.0 && h == -9999.0)).all());
  h(10, 10) = -9999.0;
  put_text(file("map"), esri_text(h, 0.01));
  expect_refused(bed, {"1 of the bed's 400 cells have no height"});
}

TEST_F(SurfaceMap, HeightsThatNoBedHasAreRefused) {
  HeightGrid h = levels(4, 4, 9, 0.01);
  const auto refused = [&](double height, const std::vector<std::string>& parts) {
    h(1, 2) = h(3, 3) = height;
    put_text(file("map"), npy_bytes<double>(h, "<f8"));
    expect_refused(bed_of(4, 4, 0.05), parts);
  };
  for (const double number : {-9999.0, -32768.0, 999999.0, 1e20})
    refused(number, {"2 cells have the height", "usually means no data", "nan"});
  // To the last digit: as -3.40282e+38 it would be another number, and be refused again.
  refused(-3.4028234663852886e38, {"-a_nodata -3.4028234663852886e+38"});
  refused(1512.0, {"to 1512 m are beyond the 2 m", "bed.surface.low and high"});
  refused(std::numeric_limits<double>::infinity(), {"2 cells have heights that are not finite"});
  BedSettings bed = bed_of(4, 4, 0.05);
  h(1, 2) = h(3, 3) = 0.0;
  put_text(file("map"), npy_bytes<double>(h, "<f8"));
  bed.surface.high = 12.0;  // millimetres
  expect_refused(bed, {"to 12 m"});
  bed = bed_of(4, 4, 0.05);
  bed.surface.nodata = -9999.0;
  expect_refused(bed, {"bed.surface.nodata", "-9999"});
}

TEST_F(SurfaceMap, DamagedFilesAreRefusedWithTheirPlace) {
  const HeightGrid h = levels(3, 4, 9, 0.01);
  const std::string grid = esri_text(h, 0.1), npy = npy_bytes<double>(h, "<f8");
  const std::string head = "ncols 4\nnrows 3\ncellsize 0.1\n";
  write_tiff<float>(file("whole.tif"), h, {.tile = 16});
  std::string tiff(1 << 16, '\0');
  {
    std::ifstream in(file("whole.tif"), std::ios::binary);
    in.read(tiff.data(), static_cast<std::streamsize>(tiff.size()));
    tiff.resize(static_cast<std::size_t>(in.gcount()));
  }
  const std::vector<std::pair<std::string, std::vector<std::string>>> files = {
      {grid.substr(0, grid.rfind(' ')), {"of 4 x 3 heights", "cut off"}},
      {grid + "5\n", {"'5' follows the last height"}},
      {head + "0,1 0 0 0\n", {":4:", "'0,1' has a comma"}},
      {"ncols 4\nnrows 3\ncellsize 0,5\n", {":3:", "'0,5' has a comma"}},
      {head + "0 0 x 0\n", {":4:", "'x' is not a number"}},
      {"ncols 4\nnrows 3\ncellsise 1\n", {":3:", "'cellsise' is no key"}},
      {"ncols 4\nncols 3\n", {":2:", "twice"}},
      {"ncols 4\ncellsize 1\n0\n", {"has no nrows"}},
      {"ncols 4\nnrows 3\n0\n", {"no cellsize above 0"}},
      {"ncols 4.5\nnrows 3\ncellsize 1\n0\n", {"no whole number"}},
      {"ncols 0\nnrows 3\ncellsize 1\n0\n", {"0 x 3 cells"}},
      {"ncols 1e9\nnrows 3\ncellsize 1\n0\n", {"too many"}},
      {head + std::string(1000, '1'), {"is no number"}},
      {npy.substr(0, npy.size() - 1), {"cut off"}},
      {npy + "x", {"goes on behind"}},
      {npy.substr(0, 20), {"header"}},
      {npy_head("'<f8'", "(3,)"), {"has 1 dimensions", "numpy.squeeze"}},
      {npy_head("'<c16'", "(3, 4)"), {"something else than heights"}},
      {npy_head("'|O'", "(3, 4)"), {"something else than heights"}},
      {npy_head("[('x', '<f8')]", "(3, 4)"), {"something else than heights"}},
      {npy_head("'<M8[s]'", "(3, 4)"), {"something else than heights"}},
      {npy_head("'|b1'", "(3, 4)"), {"something else than heights"}},
      {npy_head("'<f8'", "(60000, 60000)"), {"too many"}},
      {tiff.substr(0, 20), {"cannot be read as a TIFF"}},
      {tiff.substr(0, 100), {"cannot be read as a TIFF"}},
      {tiff.substr(0, 8), {"cannot be read as a TIFF"}},
  };
  for (const auto& [bytes, parts] : files) {
    put_text(file("map"), bytes);
    expect_refused(bed_of(3, 4, 0.1), parts);
  }
}

TEST_F(SurfaceMap, TiffsThatWouldBeTakenWronglyAreRefused) {
  const HeightGrid h = levels(3, 4, 9, 0.01);
  const TiffOptions placed{.pixel_scale = {0.1, 0.1, 0.0}};
  const auto refused = [&](const std::vector<std::string>& parts, auto change) {
    TiffOptions is = placed;
    change(is);
    write_tiff<float>(file("map"), h, is);
    expect_refused(bed_of(3, 4, 0.1), parts);
  };
  refused({"degrees", "gdalwarp"}, [](auto& is) { is.geo_keys = {1, 1, 0, 1, 1024, 0, 1, 2}; });
  refused({"lengths in another unit", "9003"},
          [](auto& is) { is.geo_keys = {1, 1, 0, 1, 3076, 0, 1, 9003}; });
  refused({"heights in another unit", "9002"},
          [](auto& is) { is.geo_keys = {1, 1, 0, 1, 4099, 0, 1, 9002}; });
  refused({"heights in 'ft' instead of metres", "gdal_calc.py"}, [](auto& is) {
    is.metadata = "<GDALMetadata><Item name=\"UNITTYPE\" role=\"unittype\">ft</Item></GDALMetadata>";
  });
  refused({"rotated"}, [](auto& is) {
    is.pixel_scale = {};
    is.transformation = {1, 0.5, 0, 5, -0.5, -1, 0, 7, 0, 0, 0, 0, 0, 0, 0, 1};
  });
  refused({"no size"}, [](auto& is) { is.pixel_scale = {-1.0, 1.0, 0.0}; });
  refused({"values per pixel"}, [](auto& is) { is.samples = 2; });
  refused({"colours"}, [](auto& is) { is.samples = 3, is.photometric = PHOTOMETRIC_RGB; });
  refused({"inverted"}, [](auto& is) { is.photometric = PHOTOMETRIC_MINISWHITE; });
  refused({"orientation 4"}, [](auto& is) { is.orientation = ORIENTATION_BOTLEFT; });
  refused({"several pictures"}, [](auto& is) { is.second_page = 0; });
  refused({"a mask", "gdalwarp -dstnodata"}, [](auto& is) { is.second_page = FILETYPE_MASK; });
  refused({"scale or an offset", "-unscale"}, [](auto& is) {
    is.metadata = "<GDALMetadata><Item name=\"SCALE\" sample=\"0\" role=\"scale\">0.1</Item></GDALMetadata>";
  });
  write_tiff<std::uint8_t>(file("map"), h, placed);
  expect_refused(bed_of(3, 4, 0.1), {"8 bits"});
}

TEST_F(SurfaceMap, KindsThatAreNotReadNameAWayOut) {
  const std::vector<std::pair<std::string, std::string>> names = {
      {"a.csv", "numpy.loadtxt"},         {"a.xyz", "gdal_translate"},
      {"a.dem", "gdal_translate"},        {"a.hgt", "gdalwarp"},
      {"a.flt", "gdal_translate"},        {"a.vrt", "gdal_translate"},
      {"a.bil", "gdal_translate"},        {"a.grd", "gdal_translate"},
      {"a.txt", "numpy.loadtxt"},         {"a.stl", "make a grid"},
      {"a.r16", "numpy.fromfile"},        {"a.tif", "is not what its ending"},
      {"a.npy", "is not what its ending"}};
  for (const auto& [name, way_out] : names) {
    put_text(file(name), "1 2 3\n");
    expect_refused(bed_of(3, 4, 0.1, name), {way_out});
  }
  for (const std::string& bytes : {std::string(), std::string("some text"), std::string("\1\2\0\3", 4)}) {
    put_text(file("map"), bytes);
    expect_refused(bed_of(3, 4, 0.1), {"neither a run file nor a map"});
  }
  for (const auto& [begin, way_out] : {std::pair{"\x1F\x8B", "gunzip"},
                                       {"\xFF\xFEn", "UTF-8"},
                                       {"north: 1\n", "gdal_translate"},
                                       {"1 2", "ncols"}}) {
    put_text(file("map.asc"), begin);
    expect_refused(bed_of(3, 4, 0.1, "map.asc"), {way_out});
  }
  put_text(file("map"), "[bed]\nsize = [1.0, 1.0]\n");
  expect_refused(bed_of(3, 4, 0.1), {"is a scene, not a run file"});
  const std::vector<std::pair<std::string, std::string>> begins = {
      {"LASF", "pdal translate"}, {"CDF\x01", "gdal_translate"}, {"DSAA", "Surfer"},
      {"\x1F\x8B", "gunzip"},     {"PK\x03\x04", "unpack"},      {"\xFF\xD8\xFF", "16-bit"}};
  for (const auto& [begin, way_out] : begins) {
    put_text(file("map"), begin + std::string(100, '\1'));
    expect_refused(bed_of(3, 4, 0.1), {way_out});
  }
}

TEST_F(SurfaceMap, ItsHeaderIsCheckedBeforeItsHeightsAreRead) {
  // Each ends behind its header: what it lacks is found only if somebody reads on.
  const BedSettings bed = bed_of(100, 100, 0.003);
  std::string png = encode_height_png(HeightGrid::Zero(8, 16), {0.0, 0.01});
  const std::vector<std::string> files = {
      png.substr(0, png.find("IDAT") + 4),
      "ncols 16000\nnrows 8000\ncellsize 1\n",
      npy_head("'<f8'", "(8000, 16000)"),
  };
  for (const std::string& bytes : files) {
    put_text(file("map.png"), bytes);
    put_text(file("map"), bytes);
    expect_refused(bytes == files[0] ? bed_of(100, 100, 0.003, "map.png") : bed, {"without distortion"});
  }
}

}  // namespace
}  // namespace sandstroke
