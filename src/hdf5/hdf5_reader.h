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

/// An HDF5 file opened for reading. Datasets are named by their path ("/trace/time"). Every error names file
/// and dataset. Error: io where the file cannot be opened, input where its content is not what is asked for.
/// No other file is opened for it, and no more memory taken for columns and text than most_unpacked() of its
/// size; grids may be of any size, which is the machine's to hold.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& path);

  const std::string& name() const { return name_; }
  /// True where the dataset or group is there.
  bool has(const std::string& object) const;
  std::vector<hsize_t> shape(const std::string& dataset) const;  ///< empty for a scalar

  std::vector<double> doubles(const std::string& dataset) const;               ///< rank 1
  std::vector<Eigen::Vector3d> vectors(const std::string& dataset) const;      ///< (n, 3)
  std::vector<Eigen::Vector4d> quaternions(const std::string& dataset) const;  ///< (n, 4)
  std::vector<std::uint32_t> integers(const std::string& dataset) const;       ///< rank 1
  /// Shape of a dataset of rank 2 as that of a bed.
  BedGeometry bed_geometry(const std::string& dataset, double cell_size) const;
  /// What a dataset of numbers reads as where nothing was written.
  double fill_value(const std::string& dataset) const;
  /// The parts of a dataset of rank 2 that were written, one at a time, by their first row and column, row by
  /// row. So a huge one with little in it costs little.
  void visit_written(
      const std::string& dataset,
      const std::function<void(Eigen::Index row, Eigen::Index col, const HeightGrid& heights)>& visit) const;
  /// Rank 2, of any size: where nothing was written no tile exists, and the bed is at the fill value.
  HeightField bed(const std::string& dataset, double cell_size) const;
  HeightGrid grid(const std::string& dataset) const;   ///< rank 2
  std::string text(const std::string& dataset) const;  ///< scalar string

  // Attributes of a group or dataset ("/" is the root group).
  bool has_attribute(const std::string& object, const std::string& attribute) const;
  double number_attribute(const std::string& object, const std::string& attribute) const;
  std::string text_attribute(const std::string& object, const std::string& attribute) const;
  double cell_size(const std::string& object) const;  ///< m, its attribute: finite and above 0

  /// Names of a group's members, or of an object's attributes, in alphabetical order.
  std::vector<std::string> members(const std::string& group) const;
  std::vector<std::string> attributes(const std::string& object) const;

 private:
  Hdf5Handle open_dataset(const std::string& dataset) const;
  void read(const std::string& dataset, const Hdf5Handle& opened, hid_t memory_type, void* values) const;
  /// Opens a column and reads its shape; so many bytes per row will be taken for it.
  Hdf5Handle open_column(const std::string& dataset, int rank, std::size_t row_bytes,
                         std::vector<hsize_t>& shape) const;
  /// Opens a dataset of numbers with `rank` dimensions and returns its shape too.
  Hdf5Handle open_numbers(const std::string& dataset, int rank, std::vector<hsize_t>& shape) const;
  Hdf5Handle open_attribute(const std::string& object, const std::string& attribute) const;
  /// HDF5's answer to whether something is there. Error: io, where the disk is why it cannot tell.
  bool yes(const std::function<htri_t()>& ask) const;
  [[noreturn]] void fail(const std::string& object, const std::string& sentence) const;
  /// Where HDF5 could not read it. Error: io, if that is the disk's fault.
  [[noreturn]] void fail_to_read(const std::string& object, const std::string& sentence) const;

  std::string name_;
  Hdf5Handle file_;
  Hdf5Handle access_;  // of objects: links into other files are not followed
  double file_bytes_ = 0.0;
};

}  // namespace sandstroke
