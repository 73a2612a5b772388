#include "io/tiff_map.h"

#include <tiffio.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <span>
#include <string>
#include <type_traits>

#include "core/error.h"
#include "core/input_file.h"
#include "import/stored_numbers.h"
#include "import/text_parts.h"

namespace sandstroke {
namespace {

static_assert(std::endian::native == std::endian::little);  // libtiff gives numbers in the machine's order

constexpr std::uint32_t pixel_scale_tag = 33550, transformation_tag = 34264, geo_keys_tag = 34735,
                        gdal_metadata_tag = 42112, gdal_no_data_tag = 42113;
constexpr std::size_t most_band_bytes = std::size_t{1} << 27;

/// A file that libtiff has open, with the reason of its last failure.
class OpenTiff {
 public:
  explicit OpenTiff(const std::filesystem::path& path) : path_(path) {
    check_readable(path);
    TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
    TIFFOpenOptionsSetMaxSingleMemAlloc(options, tmsize_t{1} << 30);
    TIFFOpenOptionsSetErrorHandlerExtR(options, keep, this);
    TIFFOpenOptionsSetWarningHandlerExtR(options, ignore_warning, nullptr);
    tiff_ =
        TIFFOpenExt(path.c_str(), "rm", options);  // m: not mapped, or a failing disk would end the program
    TIFFOpenOptionsFree(options);
    if (!tiff_) throw_damaged();
  }
  ~OpenTiff() {
    if (tiff_) TIFFClose(tiff_);
  }
  OpenTiff(const OpenTiff&) = delete;
  OpenTiff& operator=(const OpenTiff&) = delete;

  operator TIFF*() const { return tiff_; }
  std::string name() const { return path_.string(); }

  /// The number of a tag that the format requires or gives a default.
  template <class Number>
  Number number(std::uint32_t tag) const {
    Number value{};
    TIFFGetFieldDefaulted(tiff_, tag, &value);
    return value;
  }
  /// The values of a tag that libtiff does not know; empty: it is not there. Error: input, if they are of
  /// another type, whose bytes these would not be.
  template <class Number>
  std::span<const Number> values(std::uint32_t tag) const {
    const TIFFField* const field = TIFFFindField(tiff_, tag, TIFF_ANY);
    std::uint32_t count = 0;
    void* first = nullptr;
    if (!field || TIFFGetField(tiff_, tag, &count, &first) != 1 || !first) return {};
    constexpr TIFFDataType type = std::is_same_v<Number, double>          ? TIFF_DOUBLE
                                  : std::is_same_v<Number, std::uint16_t> ? TIFF_SHORT
                                                                          : TIFF_ASCII;
    if (TIFFFieldDataType(field) != type || TIFFFieldPassCount(field) == 0)
      refuse(fmt::format("has the tag {} with values of another type; save it again", tag));
    return {static_cast<const Number*>(first), count};
  }
  std::string_view text(std::uint32_t tag) const {
    const std::span<const char> characters = values<char>(tag);
    const std::string_view all(characters.data(), characters.size());
    return without_blanks(all.substr(0, all.find('\0')));
  }

  /// Error: io, if the disk is the cause; else input.
  [[noreturn]] void throw_damaged() const {
    check_can_be_read_whole(path_);
    throw_input_error("{}: cannot be read as a TIFF ({}); save it again", name(), message_);
  }
  /// Error: input.
  [[noreturn]] void refuse(const std::string& sentence) const {
    throw_input_error("{}: {}", name(), sentence);
  }

 private:
  [[gnu::format(printf, 4, 0)]] static int keep(TIFF*, void* self, const char*, const char* format,
                                                std::va_list values) {
    auto* tiff = static_cast<OpenTiff*>(self);
    std::vsnprintf(tiff->message_, sizeof tiff->message_, format, values);
    return 1;
  }
  static int ignore_warning(TIFF*, void*, const char*, const char*, std::va_list) { return 1; }

  std::filesystem::path path_;
  TIFF* tiff_ = nullptr;
  char message_[200] = "it is damaged";
};

StoredType type_of(const OpenTiff& tiff) {
  const auto bits = tiff.number<std::uint16_t>(TIFFTAG_BITSPERSAMPLE);
  const auto samples = tiff.number<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL);
  const auto format = tiff.number<std::uint16_t>(TIFFTAG_SAMPLEFORMAT);
  std::uint16_t meaning = PHOTOMETRIC_MINISBLACK;
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &meaning);
  if (samples != 1)
    tiff.refuse(fmt::format("has {}; heights need one value per pixel: gdal_translate -b 1 FILE map.tif",
                            samples <= 4 && meaning == PHOTOMETRIC_RGB
                                ? std::string("colours")
                                : fmt::format("{} values per pixel", samples)));
  if (meaning != PHOTOMETRIC_MINISBLACK)
    tiff.refuse("has gray that is inverted, or colours of a palette; save it as plain gray");
  const bool real = format == SAMPLEFORMAT_IEEEFP && (bits == 16 || bits == 32 || bits == 64);
  const bool whole =
      (format == SAMPLEFORMAT_INT || format == SAMPLEFORMAT_UINT) && (bits == 16 || bits == 32);
  if (!real && !whole)
    tiff.refuse(fmt::format(
        "has pixels of {} bits that are {}; heights need floats, or whole numbers of 16 or 32 bits", bits,
        format == SAMPLEFORMAT_IEEEFP                               ? "floats"
        : format == SAMPLEFORMAT_INT || format == SAMPLEFORMAT_UINT ? "whole numbers"
                                                                    : "neither floats nor whole numbers"));
  return {real                         ? StoredType::Kind::real
          : format == SAMPLEFORMAT_INT ? StoredType::Kind::whole
                                       : StoredType::Kind::natural,
          std::size_t{bits} / 8, false};
}

/// Refuses maps whose lengths are no metres. Source: OGC GeoTIFF 1.1, GeoKeyDirectoryTag.
void check_units(const OpenTiff& tiff) {
  constexpr std::uint16_t model_type = 1024, length_unit = 3076, height_unit = 4099, geographic = 2,
                          metre = 9001;
  const auto keys = tiff.values<std::uint16_t>(geo_keys_tag);
  for (std::size_t i = 4; i + 4 <= keys.size(); i += 4) {
    const std::uint16_t key = keys[i], place = keys[i + 1], value = keys[i + 3];
    if (place != 0) continue;  // a value in another tag
    if (key == model_type && value == geographic)
      tiff.refuse("has cells in degrees; project it to metres: gdalwarp -t_srs EPSG:CODE FILE map.tif");
    if ((key == length_unit || key == height_unit) && value >= 9002 && value <= 9300 && value != metre)
      tiff.refuse(
          fmt::format("has {} in another unit than metres (EPSG:{}); convert them, and remove the unit",
                      key == length_unit ? "lengths" : "heights", value));
  }
  // As GDAL writes it: <Item name="UNITTYPE" sample="0" role="unittype">ft</Item>
  constexpr std::string_view before = "role=\"unittype\">";
  const std::string_view metadata = tiff.text(gdal_metadata_tag);
  const std::size_t found = metadata.find(before);
  if (found == std::string_view::npos) return;
  const std::string_view rest = metadata.substr(found + before.size()), unit = rest.substr(0, rest.find('<'));
  constexpr std::array metres = {"m", "metre", "metres", "meter", "meters"};
  if (std::find(metres.begin(), metres.end(), unit) == metres.end())
    tiff.refuse(fmt::format(
        "has heights in '{}' instead of metres; convert them: gdal_calc.py -A FILE --calc=A*METRES "
        "--outfile=map.tif",
        unit));
}

/// Refuses files of which this would read only a part, or the wrong numbers.
void check_one_map(const OpenTiff& tiff) {
  const std::string_view metadata = tiff.text(gdal_metadata_tag);
  if (metadata.find("role=\"scale\"") != std::string_view::npos ||
      metadata.find("role=\"offset\"") != std::string_view::npos)
    tiff.refuse(
        "has a scale or an offset for its numbers; apply them: gdal_translate -unscale -ot Float32 FILE "
        "map.tif");
  const auto orientation = tiff.number<std::uint16_t>(TIFFTAG_ORIENTATION);
  if (orientation != ORIENTATION_TOPLEFT)
    tiff.refuse(fmt::format("is stored turned or mirrored (orientation {}); save it upright", orientation));
  constexpr int most_pages = 64;
  for (int page = 1; page < most_pages && TIFFReadDirectory(tiff) == 1; ++page) {
    const auto kind = tiff.number<std::uint32_t>(TIFFTAG_SUBFILETYPE);
    if (kind & FILETYPE_MASK)
      tiff.refuse(
          "has a mask for cells without data; write them as a number: gdalwarp -dstnodata -9999 FILE "
          "map.tif");
    if (!(kind & FILETYPE_REDUCEDIMAGE))
      tiff.refuse("has several pictures; save the one with the heights by itself");
  }
  if (TIFFSetDirectory(tiff, 0) != 1) tiff.throw_damaged();
}

/// The size of a pixel along x and y; y is negative if the first row has the smallest y. None: it is not
/// said.
std::optional<Eigen::Vector2d> pixel_size(const OpenTiff& tiff) {
  Eigen::Vector2d size(0.0, 0.0);
  if (const auto scale = tiff.values<double>(pixel_scale_tag); scale.size() >= 2) {
    size = {scale[0], scale[1]};
  } else if (const auto matrix = tiff.values<double>(transformation_tag); matrix.size() == 16) {
    if (matrix[1] != 0.0 || matrix[4] != 0.0)
      tiff.refuse("is a map that is rotated; turn it so that north is up: gdalwarp FILE map.tif");
    size = {matrix[0], -matrix[5]};
  }
  if (size.isZero(0.0)) return {};
  if (!size.allFinite() || !(size.x() > 0.0) || size.y() == 0.0)
    tiff.refuse(fmt::format("has pixels of {} x {} m, which is no size; correct it", size.x(), size.y()));
  return size;
}

/// The number that GDAL's tag says. None: there is no tag, or it says not-a-number.
std::optional<double> no_data_of(std::string_view text) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (text == "inf") return infinity;
  if (text == "-inf") return -infinity;
  return finite_number(text);
}

class TiffMap : public HeightMap {
 public:
  explicit TiffMap(const std::filesystem::path& path) : tiff_(path) {
    set_size(tiff_.name(), tiff_.number<std::uint32_t>(TIFFTAG_IMAGELENGTH),
             tiff_.number<std::uint32_t>(TIFFTAG_IMAGEWIDTH));
    type_ = type_of(tiff_);
    check_units(tiff_);
    if (const auto size = pixel_size(tiff_)) {
      layout_.cell = size->cwiseAbs();
      layout_.from_top = size->y() > 0.0;
    }
    no_data_ = no_data_of(tiff_.text(gdal_no_data_tag));
    layout_.gray = type_.kind == StoredType::Kind::natural && !layout_.cell;
    check_one_map(tiff_);
    tiled_ = TIFFIsTiled(tiff_) != 0;
    row_bytes_ = type_.bytes * static_cast<std::size_t>(layout_.cols);
    tiled_ ? open_tiles() : open_strips();
  }

  void next_line(double* values) override {
    const auto count = static_cast<std::size_t>(layout_.cols);
    const StoredNumbers numbers{type_, next_row(), count, 1, type_.bytes, 0};
    const double white = layout_.gray ? std::ldexp(1.0, 8 * static_cast<int>(type_.bytes)) - 1.0 : 1.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double value = numbers.real(i, 0);
      values[i] =
          no_data_ && is_no_data(value, *no_data_) ? std::numeric_limits<double>::quiet_NaN() : value / white;
    }
    ++row_;
  }

 private:
  void open_strips() {
    if (TIFFScanlineSize64(tiff_) != row_bytes_) tiff_.throw_damaged();
    band_.resize(row_bytes_);
  }
  void open_tiles() {
    tile_cols_ = tiff_.number<std::uint32_t>(TIFFTAG_TILEWIDTH);
    band_rows_ = tiff_.number<std::uint32_t>(TIFFTAG_TILELENGTH);
    const std::size_t tile_bytes = type_.bytes * tile_cols_ * band_rows_,
                      band_bytes = row_bytes_ * band_rows_;
    if (tile_bytes == 0 || std::max(tile_bytes, band_bytes) > most_band_bytes)
      tiff_.refuse(
          fmt::format("has tiles of {} x {} pixels; save it with smaller ones", tile_cols_, band_rows_));
    if (TIFFTileSize64(tiff_) != tile_bytes) tiff_.throw_damaged();
  }

  /// The bytes of the next row from the top.
  std::string_view next_row() {
    if (!tiled_) {
      if (TIFFReadScanline(tiff_, band_.data(), row_, 0) != 1) tiff_.throw_damaged();
      return band_;
    }
    const std::uint32_t row_in_band = row_ % band_rows_;
    if (row_in_band == 0) read_band();
    return std::string_view(band_).substr(row_in_band * row_bytes_, row_bytes_);
  }

  /// Reads the tiles that the next rows cross.
  void read_band() {
    const auto cols = static_cast<std::uint32_t>(layout_.cols);
    // Not before the map is known to fit the bed.
    tile_.resize(type_.bytes * tile_cols_ * band_rows_);
    band_.resize(row_bytes_ * band_rows_);
    for (std::uint32_t col = 0; col < cols; col += tile_cols_) {
      if (TIFFReadTile(tiff_, tile_.data(), col, row_, 0, 0) < 0) tiff_.throw_damaged();
      const std::size_t bytes = type_.bytes * std::min(tile_cols_, cols - col);
      for (std::size_t row = 0; row < band_rows_; ++row)
        std::copy_n(tile_.data() + row * type_.bytes * tile_cols_, bytes,
                    band_.data() + row * row_bytes_ + type_.bytes * col);
    }
  }

  OpenTiff tiff_;
  StoredType type_;
  std::optional<double> no_data_;
  bool tiled_ = false;
  std::size_t row_bytes_ = 0;
  std::uint32_t tile_cols_ = 0, band_rows_ = 0, row_ = 0;
  std::string tile_, band_;  // band: the row, or the rows of the tiles that it crosses
};

}  // namespace

std::unique_ptr<HeightMap> open_tiff_map(const std::filesystem::path& path) {
  return std::make_unique<TiffMap>(path);
}

}  // namespace sandstroke
