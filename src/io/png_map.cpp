#include "io/png_map.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/error.h"
#include "io/png_reader.h"

namespace sandstroke {
namespace {

class PngMap : public HeightMap {
 public:
  explicit PngMap(const std::filesystem::path& path) : png_(path) {
    png_.check_size();
    if (!png_.gray() || png_.bit_depth() != 16)
      throw_input_error("{}: is {}-bit {}; heights need a 16-bit grayscale PNG", png_.name(),
                        png_.bit_depth(), png_.gray() ? "grayscale" : "colour or with alpha");
    set_size(png_.name(), png_.height(), png_.width());
    constexpr double most_interlaced = 0x1p26;  // cells
    if (png_.interlaced() && static_cast<double>(layout_.rows) * layout_.cols > most_interlaced)
      throw_input_error("{}: has {} x {} pixels, too many for an interlaced PNG; save it without interlacing",
                        png_.name(), layout_.cols, layout_.rows);
    layout_.gray = true;
    no_data_ = png_.transparent_gray();  // as GDAL writes it
    row_.resize(2 * static_cast<std::size_t>(layout_.cols));
  }

  void next_line(double* values) override {
    if (png_.interlaced()) {
      take_from_all();
    } else {
      png_.next_row(row_.data());
    }
    for (std::size_t i = 0; i < row_.size(); i += 2) {
      const int gray = row_[i] * 256 + row_[i + 1];
      *values++ = gray == no_data_ ? std::numeric_limits<double>::quiet_NaN() : gray / 65535.0;
    }
  }

 private:
  /// The rows of an interlaced PNG are known only when all of it is.
  void take_from_all() {
    if (all_.empty()) all_ = png_.pixels(2);
    std::copy_n(all_.begin() + static_cast<std::ptrdiff_t>(taken_), row_.size(), row_.begin());
    taken_ += row_.size();
  }

  PngReader png_;
  std::optional<int> no_data_;
  std::vector<png_byte> row_, all_;
  std::size_t taken_ = 0;
};

}  // namespace

std::unique_ptr<HeightMap> open_png_map(const std::filesystem::path& path) {
  return std::make_unique<PngMap>(path);
}

}  // namespace sandstroke
