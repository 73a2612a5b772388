#include "io/png_file.h"
#include "io/png_map.h"

#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/input_file.h"
#include "core/output_file.h"
#include "core/version.h"
#include "io/map_files.h"
#include "map_values.h"
#include "test_folder.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

class PngFile : public testing::Test {
 protected:
  fs::path file(const std::string& name) const { return folder_ / name; }

  /// A PNG as libpng itself writes it; rows from the top, 16-bit samples big-endian.
  fs::path raw_png(const std::string& name, int width, int height, int depth, int colour_type,
                   std::vector<std::uint8_t> bytes) const {
    const fs::path path = file(name);
    std::FILE* out = std::fopen(path.c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, out);
    png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), depth,
                 colour_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    const std::size_t row_bytes = bytes.size() / static_cast<std::size_t>(height);
    for (int row = 0; row < height; ++row)
      png_write_row(png, bytes.data() + static_cast<std::size_t>(row) * row_bytes);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    std::fclose(out);
    return path;
  }

  /// The message of the error of an unreadable file.
  template <class Read>
  std::string refusal(Read read, ErrorKind kind = ErrorKind::input) {
    try {
      read();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind);
      return error.what();
    }
    ADD_FAILURE() << "was read";
    return "";
  }

  TestFolder folder_;
};

Image test_image(int width, int height) {
  Image image(width, height);
  std::uint32_t state = 1;
  for (std::uint8_t& byte : image.rgb)
    byte = static_cast<std::uint8_t>((state = state * 1664525u + 1013904223u) >> 24);
  return image;
}

TEST_F(PngFile, RoundTripsToTheBit) {
  const Image image = test_image(37, 23);
  write_png(file("a.png"), image);
  const Image again = read_png(file("a.png"));
  EXPECT_EQ(again.width, 37);
  EXPECT_EQ(again.height, 23);
  EXPECT_EQ(again.rgb, image.rgb);
  EXPECT_FALSE(fs::exists(part_path(file("a.png"))));
}

TEST_F(PngFile, EqualPicturesGiveEqualBytes) {
  write_png(file("a.png"), test_image(64, 64));
  write_png(file("b.png"), test_image(64, 64));
  EXPECT_EQ(read_text_file(file("a.png")), read_text_file(file("b.png")));
}

TEST_F(PngFile, SaysWhichBuildMadeIt) {
  const std::string bytes = encode_png(test_image(37, 23));
  std::FILE* in = fmemopen(const_cast<char*>(bytes.data()), bytes.size(), "rb");
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, in);
  png_read_info(png, info);
  png_textp texts = nullptr;
  ASSERT_EQ(png_get_text(png, info, &texts, nullptr), 1);
  EXPECT_STREQ(texts[0].key, "Software");
  EXPECT_STREQ(texts[0].text, build);
  png_destroy_read_struct(&png, &info, nullptr);
  std::fclose(in);
}

TEST_F(PngFile, IsTheSameInMemoryAndOnDisk) {
  write_png(file("a.png"), test_image(37, 23));
  EXPECT_EQ(encode_png(test_image(37, 23)), read_text_file(file("a.png")));
}

TEST_F(PngFile, ReadsGrayAndTransparentPicturesAsRgb) {
  const Image gray = read_png(raw_png("gray.png", 2, 1, 8, PNG_COLOR_TYPE_GRAY, {10, 200}));
  EXPECT_EQ(gray.rgb, (std::vector<std::uint8_t>{10, 10, 10, 200, 200, 200}));
  const Image clear = read_png(raw_png("alpha.png", 1, 1, 8, PNG_COLOR_TYPE_RGB_ALPHA, {1, 2, 3, 128}));
  EXPECT_EQ(clear.rgb, (std::vector<std::uint8_t>{1, 2, 3}));
  EXPECT_EQ(clear.alpha, std::vector<std::uint8_t>{128});
  EXPECT_TRUE(gray.alpha.empty());
  const Image deep = read_png(raw_png("deep.png", 2, 1, 16, PNG_COLOR_TYPE_GRAY, {0xff, 0xff, 0x80, 0x80}));
  EXPECT_EQ(deep.rgb, (std::vector<std::uint8_t>{255, 255, 255, 128, 128, 128}));
}

TEST_F(PngFile, HeightsAreExactWithTheLowestRowFirst) {
  const fs::path path =
      raw_png("height.png", 2, 2, 16, PNG_COLOR_TYPE_GRAY, {0x00, 0x00, 0xff, 0xff, 0x12, 0x34, 0x00, 0x01});
  const HeightGrid values = values_of(*open_png_map(path));
  ASSERT_EQ(values.rows(), 2);
  ASSERT_EQ(values.cols(), 2);
  EXPECT_EQ(values(1, 0), 0.0);
  EXPECT_EQ(values(1, 1), 1.0);
  EXPECT_EQ(values(0, 0), 0x1234 / 65535.0);
  EXPECT_EQ(values(0, 1), 1 / 65535.0);
}

TEST_F(PngFile, HeightsAreWrittenAndReadToTheNearestGray) {
  HeightGrid heights(2, 3);
  heights << -0.25, 0.75, 0.25, -0.25 + 12345.4 / 65535.0, 0.8, -1.0;
  put_text(file("h.png"), encode_height_png(heights, {-0.25, 0.75}));
  HeightGrid gray(2, 3);  // what is beyond is cut
  gray << 0.0, 65535.0, 32768.0, 12345.0, 65535.0, 0.0;
  EXPECT_TRUE((65535.0 * values_of(*open_png_map(file("h.png"))) - gray).abs().maxCoeff() < 1e-9);
  put_text(file("turned.png"), encode_height_png(heights, {0.75, -0.25}));
  EXPECT_NEAR(values_of(*open_png_map(file("turned.png")))(0, 0), 1.0, 0.0);
  const std::string bytes = read_text_file(file("h.png"));
  EXPECT_EQ(bytes.find("gAMA"), std::string::npos);  // heights are no light
  EXPECT_EQ(bytes.find("sRGB"), std::string::npos);
  EXPECT_NE(bytes.find(height_png_output.mark), std::string::npos);
  EXPECT_EQ(bytes.find(picture_output.mark), std::string::npos);
}

TEST_F(PngFile, HeightsSayTheirRangeToTheBit) {
  const HeightGrid heights = HeightGrid::Zero(2, 2);
  for (const GrayRange range : {GrayRange{-1.0 / 3.0, 0.1}, {0.0, 1e-300}, {5.0, -1e10}}) {
    put_text(file("h.png"), encode_height_png(heights, range));
    const std::optional<GrayRange> read = read_gray_range(file("h.png"));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->black, range.black);
    EXPECT_EQ(read->white, range.white);
  }
  write_png(file("picture.png"), test_image(2, 2));
  EXPECT_FALSE(read_gray_range(file("picture.png")));
  // A text of others is not taken for a range.
  for (const std::string text :
       {"1 to", "a to b m", "1 to 2 km", "0 to inf m", "1e999 to 2 m", " 1 to 2 m"}) {
    std::string bytes = encode_height_png(heights, {0.0, 1.0});
    const std::size_t chunk = bytes.find("tEXtHeights") - 4;
    bytes.replace(chunk, bytes.find("IDAT") - 4 - chunk,
                  png_chunk("tEXtHeights" + std::string(1, '\0') + text));
    put_text(file("other.png"), bytes);
    EXPECT_FALSE(read_gray_range(file("other.png"))) << text;
  }
}

TEST_F(PngFile, HeightsRefuseOtherKindsOfPng) {
  const fs::path colour = raw_png("rgb.png", 1, 1, 16, PNG_COLOR_TYPE_RGB, {0, 0, 0, 0, 0, 0});
  const std::string colour_refusal = refusal([&] { values_of(*open_png_map(colour)); });
  EXPECT_NE(colour_refusal.find("rgb.png"), std::string::npos);
  EXPECT_NE(colour_refusal.find("16-bit grayscale"), std::string::npos);
  const fs::path shallow = raw_png("eight.png", 1, 1, 8, PNG_COLOR_TYPE_GRAY, {0});
  EXPECT_NE(refusal([&] { values_of(*open_png_map(shallow)); }).find("8-bit grayscale"), std::string::npos);
}

TEST_F(PngFile, RefusesWhatIsNoPng) {
  std::ofstream(file("text.png")) << "this is no picture";
  EXPECT_NE(refusal([&] { read_png(file("text.png")); }).find("not a PNG"), std::string::npos);
  std::ofstream(file("empty.png")).flush();
  EXPECT_NE(refusal([&] { read_png(file("empty.png")); }).find("not a PNG"), std::string::npos);
  EXPECT_NE(refusal([&] { read_png(file("absent.png")); }, ErrorKind::io).find("absent.png"),
            std::string::npos);
  EXPECT_NE(refusal([&] { read_png(folder_.path()); }, ErrorKind::io).find("folder"), std::string::npos);
  // Nothing is at address 0 of this process: reading it is an error of the disk.
  EXPECT_NE(refusal([&] { read_png("/proc/self/mem"); }, ErrorKind::io).find("Input/output error"),
            std::string::npos);
}

TEST_F(PngFile, RefusesEveryTruncation) {
  write_png(file("whole.png"), test_image(16, 16));
  const std::string bytes = read_text_file(file("whole.png"));
  for (const std::size_t length :
       {std::size_t{8}, std::size_t{20}, std::size_t{40}, bytes.size() / 2, bytes.size() - 8}) {
    std::ofstream(file("cut.png"), std::ios::binary) << bytes.substr(0, length);
    EXPECT_NE(refusal([&] { read_png(file("cut.png")); }).find("cut off or damaged"), std::string::npos)
        << length;
  }
}

TEST_F(PngFile, RefusesDamagedPixels) {
  write_png(file("whole.png"), test_image(16, 16));
  std::string bytes = read_text_file(file("whole.png"));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
  std::ofstream(file("bad.png"), std::ios::binary) << bytes;
  EXPECT_NE(refusal([&] { read_png(file("bad.png")); }).find("cut off or damaged"), std::string::npos);
}

TEST_F(PngFile, RefusesTooLargePictures) {
  const fs::path path =
      raw_png("large.png", 20000, 1, 8, PNG_COLOR_TYPE_GRAY, std::vector<std::uint8_t>(20000));
  const std::string message = refusal([&] { read_png(path); });
  EXPECT_NE(message.find("large.png"), std::string::npos);
  EXPECT_NE(message.find("20000 x 1 pixels, which are too many"), std::string::npos);
}

TEST_F(PngFile, AnUnwritablePathIsAnError) {
  const std::string message =
      refusal([&] { write_png(file("no/such/folder.png"), test_image(4, 4)); }, ErrorKind::io);
  EXPECT_NE(message.find("folder.png"), std::string::npos);
}

}  // namespace
}  // namespace sandstroke
