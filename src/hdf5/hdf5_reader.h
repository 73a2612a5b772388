#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "hdf5/hdf5_handle.h"
#include "sand/height_field.h"

namespace sandstroke {

/// True for whole and real numbers, and for enumerations of them (h5py's bool).
bool is_hdf5_number(hid_t type);

/// An HDF5 file opened for reading. Datasets are named by their path ("/trace/time"). Every error names file
/// and dataset. Error: io, if the file cannot be opened; input, if its content is not as asked for. The
/// reader opens no other file. For columns and text it takes no more memory than most_unpacked() of the
/// file's size. Grids may have any size that the machine can hold.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& path);

  const std::string& name() const { return name_; }
  /// True if the dataset or group exists.
  bool has(const std::string& object) const;
  std::vector<hsize_t> shape(const std::string& dataset) const;  ///< empty for a scalar

  std::vector<double> doubles(const std::string& dataset) const;               ///< rank 1
  std::vector<Eigen::Vector3d> vectors(const std::string& dataset) const;      ///< (n, 3)
  std::vector<Eigen::Vector4d> quaternions(const std::string& dataset) const;  ///< (n, 4)
  std::vector<std::uint32_t> integers(const std::string& dataset) const;       ///< rank 1
  /// The shape of a dataset of rank 2 as a bed's geometry.
  BedGeometry bed_geometry(const std::string& dataset, double cell_size) const;
  /// The value that unwritten parts of a dataset of numbers read as.
  double fill_value(const std::string& dataset) const;
  /// Visits the written parts of a dataset of rank 2, row by row, each with its first row and column. A huge
  /// dataset with little in it therefore costs little.
  void visit_written(
      const std::string& dataset,
      const std::function<void(Eigen::Index row, Eigen::Index col, const HeightGrid& heights)>& visit) const;
  /// Rank 2, of any size. Unwritten parts get no tiles, and the bed is at the fill value there.
  HeightField bed(const std::string& dataset, double cell_size) const;
  HeightGrid grid(const std::string& dataset) const;   ///< rank 2
  std::string text(const std::string& dataset) const;  ///< scalar string

  // Attributes of a group or dataset ("/" is the root group).
  bool has_attribute(const std::string& object, const std::string& attribute) const;
  double number_attribute(const std::string& object, const std::string& attribute) const;
  std::string text_attribute(const std::string& object, const std::string& attribute) const;
  double cell_size(const std::string& object) const;  ///< the attribute of this name [m]: finite and > 0

  /// Names of a group's members, or of an object's attributes, in alphabetical order.
  std::vector<std::string> members(const std::string& group) const;
  std::vector<std::string> attributes(const std::string& object) const;

 protected:
  Hdf5Handle open_dataset(const std::string& dataset) const;
  void read(const std::string& dataset, const Hdf5Handle& opened, hid_t memory_type, void* values) const;
  [[noreturn]] void fail(const std::string& object, const std::string& sentence) const;
  /// Throws after HDF5 could not read an object. Error: io, if the disk is the cause; else input.
  [[noreturn]] void fail_to_read(const std::string& object, const std::string& sentence) const;

  std::string name_;
  Hdf5Handle file_;
  Hdf5Handle access_;  // for objects: links into other files are not followed
  double file_bytes_ = 0.0;

 private:
  /// Opens a column and reads its shape. row_bytes: memory that each row will take.
  Hdf5Handle open_column(const std::string& dataset, int rank, std::size_t row_bytes,
                         std::vector<hsize_t>& shape) const;
  /// Opens a dataset of numbers with `rank` dimensions and returns its shape too.
  Hdf5Handle open_numbers(const std::string& dataset, int rank, std::vector<hsize_t>& shape) const;
  Hdf5Handle open_attribute(const std::string& object, const std::string& attribute) const;
  /// HDF5's answer to a question about the file. Error: io, if it cannot tell because of the disk.
  bool yes(const std::function<htri_t()>& ask) const;
};

}  // namespace sandstroke
