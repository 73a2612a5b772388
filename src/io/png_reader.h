#pragma once

#include <png.h>

#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/input_file.h"

namespace sandstroke {

/// Reads one PNG. libpng reports errors by longjmp, which must not pass over anything with a destructor. Each
/// method that calls libpng sets its own return point and holds only plain data. Error of each: input, if the
/// file is no PNG, cut off or damaged; io.
class PngReader {
 public:
  explicit PngReader(const std::filesystem::path& path);
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  const std::string& name() const { return name_; }
  int width() const { return static_cast<int>(png_get_image_width(png_, info_)); }
  int height() const { return static_cast<int>(png_get_image_height(png_, info_)); }
  int bit_depth() const { return png_get_bit_depth(png_, info_); }
  bool has_alpha() const {
    return (png_get_color_type(png_, info_) & PNG_COLOR_MASK_ALPHA) ||
           png_get_valid(png_, info_, PNG_INFO_tRNS);
  }
  bool gray() const { return png_get_color_type(png_, info_) == PNG_COLOR_TYPE_GRAY; }
  /// The stored gray of the pixels of a gray PNG that are transparent; none: none are.
  std::optional<int> transparent_gray() const;
  bool interlaced() const { return png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE; }

  /// The text of a keyword before the pixels; empty if there is none.
  std::string text(const std::string& keyword) const;

  /// Must be called before memory is taken for the pixels. Error: input.
  void check_size() const;

  /// Pixels of `pixel_bytes` each, rows from the top: 3 = 8-bit RGB, 4 = with alpha, which the file must
  /// have, 2 = 16-bit gray as stored (big-endian).
  std::vector<png_byte> pixels(int pixel_bytes);

  /// The next row from the top, as stored, of a PNG that is not interlaced.
  void next_row(png_bytep bytes);

 private:
  static void read(png_structp png, png_bytep bytes, png_size_t count);
  bool take(png_bytep bytes, png_size_t count);
  static void fail(png_structp png, png_const_charp message);
  static void ignore_warning(png_structp, png_const_charp) {}

  bool read_header();
  bool read_rows(png_bytepp rows, bool as_rgb, bool with_alpha);
  bool read_row(png_bytep bytes);
  bool read_end();
  [[noreturn]] void throw_damaged() const;

  std::string name_;
  InputFile file_;
  std::exception_ptr failure_;  // of the disk
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  int rows_read_ = 0;
  char message_[160] = "out of memory";
};

}  // namespace sandstroke
