#pragma once

#include <hdf5.h>

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sand/height_field.h"

namespace sandstroke {

/// Owns one HDF5 identifier.
class Hdf5Handle {
 public:
  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = H5I_INVALID_HID; }
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() { close(); }
  /// False where closing failed (a full disk shows here at the latest).
  bool close() {
    if (id_ < 0) return true;
    const bool closed = close_(id_) >= 0;
    id_ = H5I_INVALID_HID;
    return closed;
  }
  operator hid_t() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  herr_t (*close_)(hid_t) = nullptr;
};

/// An HDF5 file opened for reading. Datasets are named by their path ("/trace/time"). Every error names file and
/// dataset. Error: io where the file cannot be opened, input where its content is not what is asked for.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& path);

  const std::string& name() const { return name_; }
  bool has(const std::string& dataset) const;
  /// Extent of a dataset; empty for a scalar.
  std::vector<hsize_t> shape(const std::string& dataset) const;

  std::vector<double> doubles(const std::string& dataset) const;             ///< rank 1
  std::vector<Eigen::Vector3d> vectors(const std::string& dataset) const;    ///< (n, 3)
  std::vector<std::uint32_t> integers(const std::string& dataset) const;     ///< rank 1
  HeightGrid grid(const std::string& dataset) const;                         ///< rank 2
  std::string text(const std::string& dataset) const;                        ///< scalar string

  // Attributes of a group or dataset ("/" is the root group).
  bool has_attribute(const std::string& object, const std::string& attribute) const;
  double number_attribute(const std::string& object, const std::string& attribute) const;
  std::string text_attribute(const std::string& object, const std::string& attribute) const;

  /// Names of a group's members, in alphabetical order.
  std::vector<std::string> members(const std::string& group) const;

 private:
  Hdf5Handle open_dataset(const std::string& dataset, int rank) const;

  std::string name_;
  Hdf5Handle file_;
};

/// A rank-1 or (n, width) dataset of one numeric type that grows by appending rows.
class Hdf5Column {
 public:
  Hdf5Column() = default;
  /// width 1: rank 1. The rows are doubles unless `bytes`: then uint8.
  void append(const double* rows, std::size_t count);
  void append_bytes(const std::uint8_t* rows, std::size_t count);

 private:
  friend class Hdf5Writer;
  void extend(const void* rows, std::size_t count, hid_t memory_type);

  std::string where_;
  Hdf5Handle dataset_;
  hsize_t width_ = 1, count_ = 0;
};

/// An HDF5 file being written as PATH.part and renamed to PATH by finish(). Groups on the way to a dataset are
/// made as needed. Error: io, for whatever the system refuses.
class Hdf5Writer {
 public:
  explicit Hdf5Writer(const std::filesystem::path& path);
  /// Without finish(): the .part file stays, closed and readable up to the last flush.
  ~Hdf5Writer();

  void write(const std::string& dataset, const std::vector<double>& values);
  void write(const std::string& dataset, const std::vector<Eigen::Vector3d>& values);
  void write(const std::string& dataset, const std::vector<std::uint32_t>& values);
  void write(const std::string& dataset, const std::vector<std::uint8_t>& values);
  /// Chunked; compressed (shuffle + deflate 1) unless the file is to be written fast.
  void write(const std::string& dataset, const HeightGrid& heights, bool compressed = true);
  void write(const std::string& dataset, const std::string& text);

  void attribute(const std::string& object, const std::string& attribute, double value);
  void attribute(const std::string& object, const std::string& attribute, const std::string& value);

  /// An empty dataset that grows; width columns.
  Hdf5Column column(const std::string& dataset, int width = 1);
  Hdf5Column byte_column(const std::string& dataset);
  void make_group(const std::string& group);

  void flush();
  /// Flushes, closes and renames. All columns must be gone before.
  void finish();

 private:
  Hdf5Handle create(const std::string& dataset, hid_t type, const std::vector<hsize_t>& shape,
                    const std::vector<hsize_t>& chunk, bool growing, bool compressed);
  void put(const std::string& dataset, hid_t type, const std::vector<hsize_t>& shape, const void* values);
  Hdf5Handle open_object(const std::string& object) const;

  std::filesystem::path path_;
  Hdf5Handle file_;
};

}  // namespace sandstroke
