#include "io/png_reader.h"

#include <cstdio>

#include "core/error.h"
#include "io/png_file.h"

namespace sandstroke {

PngReader::PngReader(const std::filesystem::path& path) : name_(path.string()), file_(path) {
  png_byte signature[8] = {};
  if (file_.read(signature, 8) != 8 || png_sig_cmp(signature, 0, 8) != 0)
    throw_input_error("{}: is not a PNG file; save the picture as PNG", name_);
  png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore_warning);
  info_ = png_ ? png_create_info_struct(png_) : nullptr;
  if (!info_ || !read_header()) {
    png_destroy_read_struct(&png_, &info_, nullptr);
    throw_damaged();
  }
}

std::string PngReader::text(const std::string& keyword) const {
  png_textp texts = nullptr;
  const int count = png_get_text(png_, info_, &texts, nullptr);
  for (int i = 0; i < count; ++i)
    if (texts[i].key == keyword && texts[i].text) return texts[i].text;
  return "";
}

std::optional<int> PngReader::transparent_gray() const {
  png_color_16p colour = nullptr;
  if (!gray() || !png_get_tRNS(png_, info_, nullptr, nullptr, &colour) || !colour) return {};
  return colour->gray;
}

void PngReader::check_size() const {
  if (width() > largest_png_side || height() > largest_png_side)
    throw_input_error("{}: has {} x {} pixels, which are too many; a picture has at most {} per side", name_,
                      width(), height(), largest_png_side);
}

std::vector<png_byte> PngReader::pixels(int pixel_bytes) {
  const std::size_t row_bytes = static_cast<std::size_t>(width()) * pixel_bytes;
  std::vector<png_byte> bytes(row_bytes * height());
  std::vector<png_bytep> rows(height());
  for (std::size_t row = 0; row < rows.size(); ++row) rows[row] = bytes.data() + row * row_bytes;
  if (!read_rows(rows.data(), pixel_bytes >= 3, pixel_bytes == 4)) throw_damaged();
  return bytes;
}

void PngReader::next_row(png_bytep bytes) {
  if (!read_row(bytes) || (++rows_read_ == height() && !read_end())) throw_damaged();
}

void PngReader::read(png_structp png, png_bytep bytes, png_size_t count) {
  auto* reader = static_cast<PngReader*>(png_get_io_ptr(png));
  if (!reader->take(bytes, count)) png_error(png, "Read Error");
}

/// Keeps exceptions from passing through libpng.
bool PngReader::take(png_bytep bytes, png_size_t count) {
  try {
    return file_.read(bytes, count) == count;
  } catch (const Error&) {
    failure_ = std::current_exception();
    return false;
  }
}

void PngReader::fail(png_structp png, png_const_charp message) {
  auto* reader = static_cast<PngReader*>(png_get_error_ptr(png));
  std::snprintf(reader->message_, sizeof reader->message_, "%s", message);
  png_longjmp(png, 1);
}

bool PngReader::read_header() {
  if (setjmp(png_jmpbuf(png_))) return false;
  png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // so that check_size() gives the reason
  png_set_read_fn(png_, this, read);
  png_set_sig_bytes(png_, 8);
  png_read_info(png_, info_);
  return true;
}

bool PngReader::read_rows(png_bytepp rows, bool as_rgb, bool with_alpha) {
  if (setjmp(png_jmpbuf(png_))) return false;
  if (as_rgb) {
    png_set_expand(png_);
    png_set_scale_16(png_);
    if (!with_alpha) png_set_strip_alpha(png_);
    png_set_gray_to_rgb(png_);
  }
  png_set_interlace_handling(png_);
  png_read_update_info(png_, info_);
  png_read_image(png_, rows);
  png_read_end(png_, nullptr);
  return true;
}

bool PngReader::read_row(png_bytep bytes) {
  if (setjmp(png_jmpbuf(png_))) return false;
  png_read_row(png_, bytes, nullptr);
  return true;
}

bool PngReader::read_end() {
  if (setjmp(png_jmpbuf(png_))) return false;
  png_read_end(png_, nullptr);
  return true;
}

void PngReader::throw_damaged() const {
  if (failure_) std::rethrow_exception(failure_);
  throw_input_error("{}: is cut off or damaged ({}); save the PNG again", name_, message_);
}

}  // namespace sandstroke
