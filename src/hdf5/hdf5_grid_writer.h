#pragma once

#include "hdf5/hdf5_writer.h"

namespace sandstroke {

/// Writes an HDF5 file of arrays of any rank over named axes, which HDF5 dimension scales describe. netCDF-4
/// programs (xarray) open it as a data set with coordinates. Arrays are row-major. They have as many values
/// as the product of their shape.
class Hdf5GridWriter : public Hdf5Writer {
 public:
  using Shape = std::vector<std::size_t>;

  using Hdf5Writer::attribute;
  using Hdf5Writer::Hdf5Writer;
  using Hdf5Writer::write;

  void write(const std::string& dataset, const Shape& shape, const std::vector<double>& values);
  void write(const std::string& dataset, const Shape& shape, const std::vector<std::uint32_t>& values);
  void write(const std::string& dataset, const Shape& shape, const std::vector<std::uint8_t>& values);
  /// Writes texts of variable length, which readers take for text. Fixed lengths would come to them as bytes.
  void write(const std::string& dataset, const Shape& shape, const std::vector<std::string>& texts);

  void attribute(const std::string& object, const std::string& attribute,
                 const std::vector<std::uint8_t>& values);

  /// Makes a dataset of rank 1 the scale of the axis with its name.
  void make_scale(const std::string& dataset);
  /// Gives a dataset's axes their scales, one per dimension.
  void attach_scales(const std::string& dataset, const std::vector<std::string>& scales);
  /// Removes a dataset, if it is there, from its scales, too.
  void remove(const std::string& dataset, const std::vector<std::string>& scales);
  using Hdf5Writer::remove;

  /// Writes a coordinate: a dataset of rank 1 that is the scale of the axis with its name.
  void write_scale(const std::string& dataset, const std::vector<double>& values, const std::string& units,
                   const std::string& meaning);
  void write_scale(const std::string& dataset, const std::vector<std::string>& names);

  /// A dataset of doubles of shape (outer..., rows, cols) without numbers of its own. Block `index`
  /// (row-major over `outer`) is a dataset of another file, named from this file's folder; "." is this file.
  /// Blocks without a file are NaN.
  struct Block {
    std::size_t index;
    std::string file, dataset;
  };
  void write_virtual(const std::string& dataset, const Shape& outer, std::size_t rows, std::size_t cols,
                     const std::vector<Block>& blocks);

  /// A dataset of doubles of shape (rows, cols) without numbers of its own. It reads as the dataset `under`
  /// of this file, but in the cells of a patch as the patch's dataset. Patches share no cells. All datasets
  /// have this shape.
  struct Patch {
    std::string dataset;
    std::vector<CellRange> cells;
  };
  void write_patched(const std::string& dataset, std::size_t rows, std::size_t cols, const std::string& under,
                     const std::vector<Patch>& patches);
};

}  // namespace sandstroke
