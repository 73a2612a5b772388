#include "io/png_file.h"

#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/output_file.h"
#include "core/version.h"
#include "io/png_reader.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

const std::string range_keyword = "Heights";

/// Four bytes, the highest first.
std::string big_endian(std::size_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xff);
  return bytes;
}

/// A tEXt chunk as PNG defines it: keyword and text are Latin-1.
std::string text_chunk(const std::string& keyword, const std::string& text) {
  const std::string data = "tEXt" + keyword + '\0' + text;
  const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(data.data()), static_cast<uInt>(data.size()));
  return big_endian(data.size() - 4) + data + big_endian(sum);
}

constexpr std::size_t header_end = 8 + 25;  // signature and IHDR, which comes first

/// Whether most pixels are as the one to their left, as in maps and diagrams, and not in pictures of sand.
bool is_flat(const Image& image) {
  std::int64_t alike = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 1; x < image.width; ++x)
      alike += std::equal(image.pixel(x, y), image.pixel(x, y) + 3, image.pixel(x - 1, y));
  return 2 * alike > std::int64_t{image.width} * image.height;
}

/// Encodes 8-bit RGB with one filter and a short search. In pictures of sand no two pixels are alike:
/// libpng's own choice of filters and its full search take five times as long, for a file as large. There
/// only runs are looked for: a file 6 to 10 % larger, in 0.6 of the time. (Maps would become 27 % larger.)
struct ColourEncoder {
  std::string bytes;
  char message[160] = "out of memory";

  /// Holds only plain data, as libpng requires (see PngReader).
  bool write(const Image& image) {
    constexpr std::size_t part = 8192,
                          around = 12;  // libpng's parts of the compressed pixels, and the bytes around each
    const std::size_t most = compressBound((3 * static_cast<uLong>(image.width) + 1) * image.height);
    bytes.reserve(most + (most / part + 1) * around + 1024);  // reserved now, because append() must not throw
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore_warning);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    if (!info || setjmp(png_jmpbuf(png))) {
      png_destroy_write_struct(&png, &info);
      return false;
    }
    png_set_write_fn(png, this, append, nullptr);
    png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_compression_level(png, 4);
    if (!is_flat(image)) png_set_compression_strategy(png, Z_RLE);
    png_write_info(png, info);
    for (int y = 0; y < image.height; ++y) png_write_row(png, image.pixel(0, y));
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return true;
  }

 private:
  static void append(png_structp png, png_bytep data, png_size_t count) {
    static_cast<ColourEncoder*>(png_get_io_ptr(png))
        ->bytes.append(reinterpret_cast<const char*>(data), count);
  }
  static void fail(png_structp png, png_const_charp message) {
    auto* encoder = static_cast<ColourEncoder*>(png_get_error_ptr(png));
    std::snprintf(encoder->message, sizeof encoder->message, "%s", message);
    png_longjmp(png, 1);
  }
  static void ignore_warning(png_structp, png_const_charp) {}
};

/// Encodes 16-bit gray. chunks: inserted right behind the header.
std::string encode_gray(int width, int height, const png_uint_16* pixels, const std::string& chunks) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(width);
  header.height = static_cast<png_uint_32>(height);
  header.format = PNG_FORMAT_LINEAR_Y;
  header.flags = PNG_IMAGE_FLAG_COLORSPACE_NOT_sRGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&header, bytes.data(), &size, 0, pixels, 0, nullptr))
    throw_io_error("a picture of {} x {} pixels cannot be encoded as PNG ({})", width, height,
                   header.message);
  bytes.resize(size);
  constexpr std::string_view gamma("\0\0\0\4gAMA", 8);
  // libpng marks 16-bit values as linear light. Heights are no light, and no viewer may brighten them.
  if (bytes.compare(header_end, gamma.size(), gamma) == 0) bytes.erase(header_end, 16);
  bytes.insert(header_end, chunks);
  return bytes;
}

}  // namespace

std::string encode_png(const Image& image) {
  ColourEncoder encoder;
  if (!encoder.write(image))
    throw_io_error("a picture of {} x {} pixels cannot be encoded as PNG ({})", image.width, image.height,
                   encoder.message);
  encoder.bytes.insert(header_end, text_chunk("Software", build));
  return std::move(encoder.bytes);
}

std::string encode_height_png(const HeightGrid& heights, const GrayRange& range) {
  if (heights.rows() > largest_png_side || heights.cols() > largest_png_side)
    throw_input_error("{} x {} cells are too many for a PNG; at most {} per side", heights.cols(),
                      heights.rows(), largest_png_side);
  std::vector<png_uint_16> pixels;
  pixels.reserve(static_cast<std::size_t>(heights.size()));
  for (Eigen::Index row = heights.rows() - 1; row >= 0; --row)
    for (Eigen::Index col = 0; col < heights.cols(); ++col) {
      const double fraction = (heights(row, col) - range.black) / (range.white - range.black);
      pixels.push_back(static_cast<png_uint_16>(std::lround(65535.0 * std::clamp(fraction, 0.0, 1.0))));
    }
  return encode_gray(static_cast<int>(heights.cols()), static_cast<int>(heights.rows()), pixels.data(),
                     text_chunk("Software", fmt::format("height map of {}", build)) +
                         text_chunk(range_keyword, fmt::format("{} to {} m", range.black, range.white)));
}

std::optional<GrayRange> read_gray_range(const fs::path& path) {
  const std::string text = PngReader(path).text(range_keyword);
  const char *next = text.data(), *const end = next + text.size();
  const auto number = [&](double& value, std::string_view after) {
    const auto [behind, failure] = std::from_chars(next, end, value);
    const bool sound =
        failure == std::errc() && std::isfinite(value) && std::string_view(behind, end).starts_with(after);
    next = behind + (sound ? after.size() : 0);
    return sound;
  };
  GrayRange range;
  if (!number(range.black, " to ") || !number(range.white, " m") || next != end) return std::nullopt;
  return range;
}

bool has_picture_name(const std::filesystem::path& path) { return small_ending(path) == ".png"; }

void check_picture_name(const std::filesystem::path& path) {
  if (!has_picture_name(path))
    throw_input_error("{}: is not the name of a PNG file; end it with .png", path.string());
}

void write_png(const fs::path& path, const Image& image) {
  write_text_file(path, encode_png(image), picture_output);
}

Image read_png(const fs::path& path) {
  PngReader png(path);
  png.check_size();
  Image image;
  image.width = png.width();
  image.height = png.height();
  if (!png.has_alpha()) {
    image.rgb = png.pixels(3);
    return image;
  }
  const std::vector<png_byte> bytes = png.pixels(4);
  image.rgb.reserve(bytes.size() / 4 * 3);
  image.alpha.reserve(bytes.size() / 4);
  for (std::size_t i = 0; i < bytes.size(); i += 4) {
    image.rgb.insert(image.rgb.end(), &bytes[i], &bytes[i] + 3);
    image.alpha.push_back(bytes[i + 3]);
  }
  return image;
}

}  // namespace sandstroke
