#include "io/surface_file.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstdio>

#include "core/error.h"
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
  bed.surface.low = -0.01, bed.surface.high = 0.03;
  const HeightField surface = load_surface(bed, folder.path());
  EXPECT_NEAR(surface(1, 0), -0.01, 1e-15);  // row 1 is the larger y
  EXPECT_NEAR(surface(1, 1), 0.03, 1e-15);
  EXPECT_NEAR(surface(0, 0), -0.01 + 0.2 * 0.04, 1e-15);
  EXPECT_NEAR(surface(0, 1), -0.01 + 0.8 * 0.04, 1e-15);

  bed.surface.high = bed.surface.low;  // a range must be stated
  EXPECT_THROW(load_surface(bed, folder.path()), Error);
  bed.surface.high = 0.03;
  bed.cols = 4;  // and the cells must be those of the bed
  EXPECT_THROW(load_surface(bed, folder.path()), Error);
}

}  // namespace
}  // namespace sandstroke
