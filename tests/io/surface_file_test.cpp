#include "io/surface_file.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstdio>

#include "core/error.h"
#include "hdf5/hdf5_writer.h"
#include "io/input_kind.h"
#include "io/png_file.h"
#include "kept_log.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// Writes a 16-bit grayscale PNG; values row by row from the top.
void write_gray16(const fs::path& path, int width, int height, const std::vector<std::uint16_t>& values) {
  FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, width, height, 16, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  for (int row = 0; row < height; ++row) {
    std::vector<png_byte> bytes;
    for (int col = 0; col < width; ++col) {
      const std::uint16_t value = values[row * width + col];
      bytes.push_back(static_cast<png_byte>(value >> 8));
      bytes.push_back(static_cast<png_byte>(value & 255));
    }
    png_write_row(png, bytes.data());
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

TEST(SurfaceFile, APngGivesHeightsBetweenLowAndHighWithItsTopAtLargeY) {
  const TestFolder folder;
  write_gray16(folder / "heights.png", 2, 2, {0, 65535, 13107, 52428});  // 0, 1; 0.2, 0.8
  BedSettings bed;
  bed.width = bed.depth = 0.2;
  bed.cols = bed.rows = 2;
  bed.surface.kind = SurfaceKind::file;
  bed.surface.file = "heights.png";
  bed.surface.low = -0.01;
  bed.surface.high = 0.03;
  const HeightField surface = load_surface(bed, folder.path());
  EXPECT_NEAR(surface(1, 0), -0.01, 1e-15);  // row 1 is the larger y
  EXPECT_NEAR(surface(1, 1), 0.03, 1e-15);
  EXPECT_NEAR(surface(0, 0), -0.01 + 0.2 * 0.04, 1e-15);
  EXPECT_NEAR(surface(0, 1), -0.01 + 0.8 * 0.04, 1e-15);

  bed.surface.high = bed.surface.low;  // a range must be stated
  EXPECT_THROW(load_surface(bed, folder.path()), Error);
}

BedSettings bed_from(const std::string& file) {
  BedSettings bed;
  bed.width = 0.3;
  bed.cols = 3;
  bed.depth = 0.2;
  bed.rows = 2;
  bed.surface.kind = SurfaceKind::file;
  bed.surface.file = file;
  return bed;
}

TEST(SurfaceFile, APngThatIsNotSquareHasItsColumnsAlongX) {
  const TestFolder folder;
  write_gray16(folder / "heights.png", 3, 2, {0, 13107, 26214, 39321, 52428, 65535});
  BedSettings bed = bed_from("heights.png");
  bed.surface.low = 1.0;
  bed.surface.high = 2.0;
  const HeightField surface = load_surface(bed, folder.path());
  ASSERT_EQ(surface.rows(), 2);
  ASSERT_EQ(surface.cols(), 3);
  EXPECT_NEAR(surface.cell_size(), 0.1, 1e-16);
  for (int col = 0; col < 3; ++col) {
    EXPECT_NEAR(surface(1, col), 1.0 + 0.2 * col, 1e-15);
    EXPECT_NEAR(surface(0, col), 1.6 + 0.2 * col, 1e-15);
  }
}

TEST(SurfaceFile, APngMaySayItsHeightsWhereTheSceneSaysNone) {
  const TestFolder folder;
  HeightGrid heights(2, 3);
  heights << -0.1, 0.2, 0.3, 0.0, -0.1, 0.1;
  put_text(folder / "heights.png", encode_height_png(heights, {-0.1, 0.3}));
  BedSettings bed = bed_from("heights.png");
  const HeightGrid own = load_surface(bed, folder.path()).grid();
  EXPECT_LE((own - heights).abs().maxCoeff(), 0.50000001 * 0.4 / 65535.0);
  EXPECT_EQ(own(0, 0), -0.1);  // black and white to the bit: -0.1 + 0.4 is not 0.3
  EXPECT_EQ(own(0, 2), 0.3);
  EXPECT_EQ(with_own_range(bed, folder.path()).surface.low, -0.1);
  EXPECT_EQ(with_own_range(bed, folder.path()).surface.high, 0.3);
  bed.surface.low = 1.0;
  bed.surface.high = 2.0;
  EXPECT_EQ(load_surface(bed, folder.path())(0, 2), 2.0);
}

TEST(SurfaceFile, ARunsFinalSurfaceNeedsCellsOfTheBedsSize) {
  const TestFolder folder;
  for (const auto& [fraction, taken] :
       {std::pair{0.0, true}, {0.95e-9, true}, {-0.95e-9, true}, {1.05e-9, false}, {-1.05e-9, false}}) {
    Hdf5Writer file(folder / "run.h5", output_kind(InputKind::run));
    file.attribute("/", "complete", 1.0);
    file.make_group("/surface");
    file.attribute("/surface", "cell_size", 0.1 * (1.0 + fraction));
    file.write("/surface/initial", HeightGrid::Zero(2, 3));
    HeightGrid final(2, 3);
    final << 1, 2, 3, 4, 5, 6;
    file.write("/surface/final", final);
    file.finish();
    if (taken)
      EXPECT_TRUE((load_surface(bed_from("run.h5"), folder.path()).grid() == final).all()) << fraction;
    else
      EXPECT_THROW(load_surface(bed_from("run.h5"), folder.path()), Error) << fraction;
  }
  BedSettings turned = bed_from("run.h5");
  std::swap(turned.rows, turned.cols);
  std::swap(turned.width, turned.depth);
  EXPECT_THROW(load_surface(turned, folder.path()), Error);
}

TEST(SurfaceFile, SandOfARunWithoutItsStonesIsWarnedOf) {
  const TestFolder folder;
  const auto warned = [&](const BedSettings& bed) {
    const KeptLog log;
    Scene scene;
    scene.bed = bed;
    load_bed(scene, folder.path());
    return log.text();
  };
  for (const bool stones : {true, false}) {
    {
      Hdf5Writer file(folder / "run.h5", output_kind(InputKind::run));
      file.attribute("/", "complete", 1.0);
      file.write("/scene", std::string());
      file.make_group("/surface");
      file.attribute("/surface", "cell_size", 0.1);
      file.write("/surface/initial", HeightGrid::Zero(2, 3));
      file.write("/surface/final", HeightGrid::Zero(2, 3));
      if (stones) file.write("/surface/floor", HeightGrid::Constant(2, 3, -1.0));
      file.finish();
    }
    const std::string said = warned(bed_from("run.h5"));
    EXPECT_EQ(said.find((folder / "run.h5").string() + ": has stones or a floor") != std::string::npos,
              stones);
    EXPECT_EQ(said.empty(), !stones) << said;
    EXPECT_EQ(load_surface(bed_from("run.h5"), folder.path()).ground(), nullptr);
  }
  write_gray16(folder / "heights.png", 3, 2, {0, 0, 0, 0, 0, 0});
  BedSettings picture = bed_from("heights.png");
  picture.surface.high = 0.1;
  EXPECT_EQ(warned(picture), "");
  EXPECT_EQ(warned(BedSettings{}), "");
}

TEST(SurfaceFile, HeightsMustBeFinite) {
  const TestFolder folder;
  Hdf5Writer file(folder / "run.h5");
  file.attribute("/", "format", "sandstroke.run");
  file.attribute("/", "format_version", 1.0);
  file.attribute("/", "complete", 1.0);
  file.make_group("/surface");
  file.attribute("/surface", "cell_size", 0.1);
  HeightGrid heights = HeightGrid::Zero(2, 3);
  file.write("/surface/initial", heights);
  heights(1, 2) = std::numeric_limits<double>::quiet_NaN();
  file.write("/surface/final", heights);
  file.finish();
  EXPECT_THROW(load_surface(bed_from("run.h5"), folder.path()), Error);
}

}  // namespace
}  // namespace sandstroke
