#pragma once

#include "hdf5/hdf5_writer.h"

namespace sandstroke {

/// An HDF5 file of arrays of any rank over named axes, as HDF5 dimension scales describe them: what netCDF-4
/// programs (xarray) open as a data set with coordinates. Arrays are row-major, of as many values as the
/// product of their shape says.
class Hdf5GridWriter : public Hdf5Writer {
 public:
  using Shape = std::vector<std::size_t>;

  using Hdf5Writer::attribute;
  using Hdf5Writer::Hdf5Writer;
  using Hdf5Writer::write;

  void write(const std::string& dataset, const Shape& shape, const std::vector<double>& values);
  void write(const std::string& dataset, const Shape& shape, const std::vector<std::uint32_t>& values);
  void write(const std::string& dataset, const Shape& shape, const std::vector<std::uint8_t>& values);
  /// Of variable length, which readers take for text; fixed ones come to them as bytes.
  void write(const std::string& dataset, const Shape& shape, const std::vector<std::string>& texts);

  void attribute(const std::string& object, const std::string& attribute,
                 const std::vector<std::uint8_t>& values);

  /// Makes a dataset of rank 1 the scale of an axis of its name.
  void make_scale(const std::string& dataset);
  /// The axes of a dataset by their scales, one per dimension.
  void attach_scales(const std::string& dataset, const std::vector<std::string>& scales);

  /// A coordinate: a dataset of rank 1 that is the scale of the axis of its name.
  void write_scale(const std::string& dataset, const std::vector<double>& values, const std::string& units,
                   const std::string& meaning);
  void write_scale(const std::string& dataset, const std::vector<std::string>& names);

  /// A dataset of doubles of shape (outer..., rows, cols) that has no numbers of its own: block `index`
  /// (row-major over `outer`) is a dataset of another file, named from this file's folder; "." is this file.
  /// Blocks without a file are not-a-number.
  struct Block {
    std::size_t index;
    std::string file, dataset;
  };
  void write_virtual(const std::string& dataset, const Shape& outer, std::size_t rows, std::size_t cols,
                     const std::vector<Block>& blocks);

  /// A dataset of doubles of shape (rows, cols) that has no numbers of its own: it is the dataset `under` of
  /// this file, but in these cells, which no two patches share, other ones. All are of its shape.
  struct Patch {
    std::string dataset;
    std::vector<CellRange> cells;
  };
  void write_patched(const std::string& dataset, std::size_t rows, std::size_t cols, const std::string& under,
                     const std::vector<Patch>& patches);
};

}  // namespace sandstroke
