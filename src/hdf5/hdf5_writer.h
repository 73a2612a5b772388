#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

#include "core/file_lock.h"
#include "core/output_file.h"
#include "hdf5/hdf5_handle.h"
#include "sand/height_field.h"

namespace sandstroke {

/// How a dataset is compressed. none; fast: shuffle + deflate 1; small: shuffle + deflate 9.
enum class Compression { none, fast, small };

// The types of numbers in columns and attributes. A bool is a byte, 1 or 0.
inline hid_t hdf5_type(bool) { return H5T_NATIVE_UINT8; }
inline hid_t hdf5_type(double) { return H5T_NATIVE_DOUBLE; }
inline hid_t hdf5_type(std::uint8_t) { return H5T_NATIVE_UINT8; }
inline hid_t hdf5_type(std::uint32_t) { return H5T_NATIVE_UINT32; }
inline hid_t hdf5_type(std::int32_t) { return H5T_NATIVE_INT32; }
inline hid_t hdf5_type(std::int64_t) { return H5T_NATIVE_INT64; }
inline hid_t hdf5_type(std::uint64_t) { return H5T_NATIVE_UINT64; }

/// A dataset of numbers that grows row by row: rank 1, or (n, width). Made by Hdf5Writer::column.
class Hdf5Column {
 public:
  Hdf5Column() = default;
  /// Appends `count` rows of `width` numbers each. Error: io.
  template <class Number>
  void append(const Number* rows, std::size_t count) {
    extend(rows, count, hdf5_type(Number{}));
  }
  std::uint64_t rows() const { return count_; }

 private:
  friend class Hdf5Writer;
  void extend(const void* rows, std::size_t count, hid_t memory_type);

  std::string where_;  // file and dataset, for messages
  Hdf5Handle dataset_;
  hsize_t width_ = 1, count_ = 0;
};

/// A dataset of doubles of rank 2, written chunk by chunk. Chunks that are never written take no room in the
/// file and read as the fill value. Made by Hdf5Writer::chunks.
class Hdf5Chunks {
 public:
  std::size_t cols() const { return cols_; }          ///< of a chunk
  std::size_t size() const { return rows_ * cols_; }  ///< numbers in a chunk
  /// Writes a whole chunk, row after row. row, col: its first row and column in the dataset (multiples of the
  /// chunk's size). Numbers outside the dataset do not matter. Error: io.
  void write(int row, int col, const double* numbers);

 private:
  friend class Hdf5Writer;
  std::string where_;  // file and dataset, for messages
  Hdf5Handle dataset_;
  std::size_t rows_ = 1, cols_ = 1;
};

/// A kind of output that is an HDF5 file. Until the first flush it holds only its superblock.
constexpr OutputKind hdf5_output(std::string_view name, std::string_view mark, int format_version = 1) {
  OutputKind kind{name, hdf5_signature, mark, 96};
  kind.hdf5 = true;
  kind.version = format_version;
  return kind;
}

/// Writes an HDF5 file as PATH.part, which finish() renames to PATH. It makes the groups on the way to a
/// dataset. Attributes of the root say what the file is: written_by and, for a kind with a mark, format =
/// that mark and format_version. Error: io, if the system refuses something, or another process writes the
/// file; input, if it must not replace what is there.
class Hdf5Writer {
 public:
  /// from_part: with all that PATH.part holds, which stays as it is until the next flush().
  enum class Begins { anew, from_part };
  /// Without a kind it replaces nothing.
  explicit Hdf5Writer(const std::filesystem::path& path, const OutputKind& kind = {},
                      Begins begins = Begins::anew);
  Hdf5Writer(const Hdf5Writer&) = delete;
  /// Without finish() the .part file stays, if anything was flushed into it.
  ~Hdf5Writer();

  void write(const std::string& dataset, const std::vector<double>& values);
  void write(const std::string& dataset, const std::vector<Eigen::Vector3d>& values);  ///< (n, 3)
  void write(const std::string& dataset, const std::vector<Eigen::Vector4d>& values);  ///< (n, 4)
  void write(const std::string& dataset, const std::vector<std::uint32_t>& values);
  void write(const std::string& dataset, const std::vector<std::uint8_t>& values);
  void write(const std::string& dataset, const HeightGrid& heights,
             Compression compression = Compression::none);
  /// Writes numbers from 0 to 2^53 as 64-bit integers, strongly compressed. For few rows and many columns.
  void write_whole_numbers(const std::string& dataset, const HeightGrid& numbers);
  void write(const std::string& dataset, const std::string& text);
  void write(const std::string& dataset, const std::vector<std::string>& texts);  ///< padded to the longest

  template <class Number>
  requires std::is_arithmetic_v<Number>
  void attribute(const std::string& object, const std::string& attribute, Number value) {
    put_attribute(object, attribute, hdf5_type(value), {}, &value);
  }
  void attribute(const std::string& object, const std::string& attribute, const std::string& value);
  /// Describes a dataset as netCDF does (CF conventions): long_name, and units if there are any.
  void describe(const std::string& dataset, const std::string& units, const std::string& meaning);

  template <class Number = double>
  Hdf5Column column(const std::string& dataset, int width = 1) {
    return growing(dataset, hdf5_type(Number{}), width);
  }
  /// chunk: rows and columns, at most as many as the dataset has.
  Hdf5Chunks chunks(const std::string& dataset, std::array<int, 2> shape, std::array<int, 2> chunk,
                    double fill);
  /// A column() of a file that is gone on with, cut off after so many rows. Error: input, if it has fewer.
  Hdf5Column shortened(const std::string& dataset, std::uint64_t rows);
  bool has(const std::string& object) const;
  /// Removes a group or dataset, if it is there.
  void remove(const std::string& object);
  void make_group(const std::string& group);

  /// From now on, all that was written so far can be read from the .part file, even if a kill hits a later
  /// flush (part_driver.h).
  void flush();
  /// Flushes, closes and renames.
  void finish();

 protected:
  Hdf5Handle create(const std::string& dataset, hid_t type, const Hdf5Handle& space,
                    const Hdf5Handle& properties, hid_t access = H5P_DEFAULT);
  void put(const std::string& dataset, hid_t type, const std::vector<hsize_t>& shape, const void* values,
           Compression compression = Compression::none);
  /// shape: empty for a scalar.
  void put_attribute(const std::string& object, const std::string& attribute, hid_t type,
                     const std::vector<hsize_t>& shape, const void* values);
  void check(bool done, const std::string& object) const;
  hid_t file() const { return file_; }

 private:
  void commit();
  Hdf5Column growing(const std::string& dataset, hid_t type, int width);

  /// Removes a .part file that holds nothing.
  void drop();

  std::filesystem::path path_;
  OutputKind kind_;
  FileLock lock_;  // of the .part file
  Hdf5Handle file_;
  bool flushed_ = false;
};

}  // namespace sandstroke
