#pragma once

#include <spdlog/fmt/fmt.h>
#include <tiffio.h>
#include <zlib.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rules/talus.h"

// Files of heights as other programs write them. Row 0 of a grid has the smallest y.
namespace sandstroke {

/// An ESRI ASCII grid.
inline std::string esri_text(const HeightGrid& heights, double cell, const std::string& more = "") {
  std::string text = fmt::format("ncols {}\nnrows {}\nxllcorner 340620.0\nyllcorner 0\ncellsize {}\n{}",
                                 heights.cols(), heights.rows(), cell, more);
  for (Eigen::Index row = heights.rows() - 1; row >= 0; --row)
    for (Eigen::Index col = 0; col < heights.cols(); ++col)
      text += fmt::format("{}{}", heights(row, col), col + 1 < heights.cols() ? ' ' : '\n');
  return text;
}

/// The beginning of a .npy file of version 1.
inline std::string npy_head(const std::string& descr, const std::string& shape, bool fortran = false) {
  std::string header = fmt::format("{{'descr': {}, 'fortran_order': {}, 'shape': {}, }}", descr,
                                   fortran ? "True" : "False", shape);
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size() & 0xff) +
         static_cast<char>(header.size() >> 8) + header;
}

/// The bytes of a number, in either order.
template <class Number>
std::string bytes_of_number(Number number, bool big_endian) {
  std::string bytes(reinterpret_cast<const char*>(&number), sizeof number);
  return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

/// A .npy file of Numbers.
template <class Number>
std::string npy_bytes(const HeightGrid& heights, const std::string& type, bool fortran = false) {
  const bool big = type[0] == '>';
  std::string bytes =
      npy_head("'" + type + "'", fmt::format("({}, {})", heights.rows(), heights.cols()), fortran);
  for (Eigen::Index i = 0; i < heights.size(); ++i) {
    const Eigen::Index row = fortran ? i % heights.rows() : i / heights.cols();
    const Eigen::Index col = fortran ? i / heights.rows() : i % heights.cols();
    bytes += bytes_of_number(static_cast<Number>(heights(row, col)), big);
  }
  return bytes;
}

/// A chunk of a PNG: its type, four letters, and then its data.
inline std::string png_chunk(const std::string& type_and_data) {
  const auto sum =
      crc32(0, reinterpret_cast<const Bytef*>(type_and_data.data()), static_cast<uInt>(type_and_data.size()));
  return bytes_of_number(static_cast<std::uint32_t>(type_and_data.size() - 4), true) + type_and_data +
         bytes_of_number(static_cast<std::uint32_t>(sum), true);
}

/// What a TIFF is like besides its heights.
struct TiffOptions {
  const char* mode = "w";  ///< b: big endian, 8: 64-bit offsets
  std::uint16_t compression = COMPRESSION_NONE, samples = 1, photometric = PHOTOMETRIC_MINISBLACK,
                orientation = ORIENTATION_TOPLEFT;
  std::uint32_t tile = 0;  ///< side; 0: strips of 3 rows
  std::vector<double> pixel_scale = {}, transformation = {};
  std::vector<std::uint16_t> geo_keys = {};
  std::string no_data = {}, metadata = {};
  std::optional<std::uint32_t> second_page = {};  ///< its kind
};

namespace map_files {

inline void add_tags(TIFF* tiff) {
  static const TIFFFieldInfo tags[] = {
      {33550, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("ModelPixelScale")},
      {34264, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("ModelTransformation")},
      {34735, -1, -1, TIFF_SHORT, FIELD_CUSTOM, 1, 1, const_cast<char*>("GeoKeyDirectory")},
      {42112, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, const_cast<char*>("GDALMetadata")},
      {42113, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, const_cast<char*>("GDALNoData")}};
  TIFFMergeFieldInfo(tiff, tags, 5);
}

template <class Number>
void write_pixels(TIFF* tiff, const HeightGrid& heights, const TiffOptions& is) {
  const auto rows = static_cast<std::uint32_t>(heights.rows()),
             cols = static_cast<std::uint32_t>(heights.cols());
  const auto pixel = [&](std::uint32_t row, std::uint32_t col) {
    return row < rows && col < cols ? static_cast<Number>(heights(rows - 1 - row, col)) : Number{77};
  };
  if (is.tile == 0) {
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 3);
    std::vector<Number> line(cols * is.samples);
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (std::uint32_t i = 0; i < line.size(); ++i) line[i] = pixel(row, i / is.samples);
      TIFFWriteScanline(tiff, line.data(), row, 0);
    }
    return;
  }
  TIFFSetField(tiff, TIFFTAG_TILEWIDTH, is.tile);
  TIFFSetField(tiff, TIFFTAG_TILELENGTH, is.tile);
  std::vector<Number> tile(std::size_t{is.tile} * is.tile);
  for (std::uint32_t y = 0; y < rows; y += is.tile)
    for (std::uint32_t x = 0; x < cols; x += is.tile) {
      for (std::uint32_t i = 0; i < tile.size(); ++i) tile[i] = pixel(y + i / is.tile, x + i % is.tile);
      TIFFWriteTile(tiff, tile.data(), x, y, 0, 0);
    }
}

}  // namespace map_files

/// Writes a TIFF of Numbers.
template <class Number>
void write_tiff(const std::filesystem::path& path, const HeightGrid& heights, const TiffOptions& is = {}) {
  TIFF* tiff = TIFFOpen(path.c_str(), is.mode);
  map_files::add_tags(tiff);
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(heights.cols()));
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(heights.rows()));
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8 * sizeof(Number));
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT,
               std::is_floating_point_v<Number> ? SAMPLEFORMAT_IEEEFP
               : std::is_signed_v<Number>       ? SAMPLEFORMAT_INT
                                                : SAMPLEFORMAT_UINT);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, is.samples);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, is.photometric);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, is.compression);
  TIFFSetField(tiff, TIFFTAG_ORIENTATION, is.orientation);
  if (!is.pixel_scale.empty()) TIFFSetField(tiff, 33550, 3, is.pixel_scale.data());
  if (!is.transformation.empty()) TIFFSetField(tiff, 34264, 16, is.transformation.data());
  if (!is.geo_keys.empty())
    TIFFSetField(tiff, 34735, static_cast<int>(is.geo_keys.size()), is.geo_keys.data());
  if (!is.metadata.empty()) TIFFSetField(tiff, 42112, is.metadata.c_str());
  if (!is.no_data.empty()) TIFFSetField(tiff, 42113, is.no_data.c_str());
  map_files::write_pixels<Number>(tiff, heights, is);
  if (is.second_page) {
    TIFFWriteDirectory(tiff);
    const std::uint8_t byte = 255;
    TIFFSetField(tiff, TIFFTAG_SUBFILETYPE, *is.second_page);
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 1);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 1);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 1);
    TIFFWriteScanline(tiff, const_cast<std::uint8_t*>(&byte), 0, 0);
  }
  TIFFClose(tiff);
}

}  // namespace sandstroke
