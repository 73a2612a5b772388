#include "hdf5/hdf5_grid_writer.h"

#include <hdf5_hl.h>

#include <limits>

namespace sandstroke {
namespace {

std::vector<hsize_t> extent(const Hdf5GridWriter::Shape& shape) { return {shape.begin(), shape.end()}; }

/// Properties of a dataset whose doubles are in other datasets. Where there are none, it reads as NaN.
Hdf5Handle virtual_properties() {
  Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties, false);
  constexpr double fill = std::numeric_limits<double>::quiet_NaN();
  H5Pset_fill_value(properties, H5T_NATIVE_DOUBLE, &fill);
  return properties;
}

}  // namespace

void Hdf5GridWriter::write(const std::string& dataset, const Shape& shape,
                           const std::vector<double>& values) {
  put(dataset, H5T_NATIVE_DOUBLE, extent(shape), values.data());
}
void Hdf5GridWriter::write(const std::string& dataset, const Shape& shape,
                           const std::vector<std::uint32_t>& values) {
  put(dataset, H5T_NATIVE_UINT32, extent(shape), values.data());
}
void Hdf5GridWriter::write(const std::string& dataset, const Shape& shape,
                           const std::vector<std::uint8_t>& values) {
  put(dataset, H5T_NATIVE_UINT8, extent(shape), values.data());
}
void Hdf5GridWriter::write(const std::string& dataset, const Shape& shape,
                           const std::vector<std::string>& texts) {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  std::vector<const char*> characters;
  for (const std::string& text : texts) characters.push_back(text.c_str());
  put(dataset, type, extent(shape), characters.data());
}

void Hdf5GridWriter::attribute(const std::string& object, const std::string& attribute,
                               const std::vector<std::uint8_t>& values) {
  put_attribute(object, attribute, H5T_NATIVE_UINT8, {values.size()}, values.data());
}

void Hdf5GridWriter::make_scale(const std::string& dataset) {
  const Hdf5Handle opened(H5Dopen2(file(), dataset.c_str(), H5P_DEFAULT), H5Dclose);
  check(opened.valid() && H5DSset_scale(opened, dataset.substr(dataset.rfind('/') + 1).c_str()) >= 0,
        dataset);
}

void Hdf5GridWriter::attach_scales(const std::string& dataset, const std::vector<std::string>& scales) {
  const Hdf5Handle opened(H5Dopen2(file(), dataset.c_str(), H5P_DEFAULT), H5Dclose);
  for (std::size_t i = 0; i < scales.size(); ++i) {
    const Hdf5Handle scale(H5Dopen2(file(), scales[i].c_str(), H5P_DEFAULT), H5Dclose);
    check(H5DSattach_scale(opened, scale, static_cast<unsigned>(i)) >= 0, dataset);
  }
}

void Hdf5GridWriter::remove(const std::string& dataset, const std::vector<std::string>& scales) {
  if (!has(dataset)) return;
  {
    const Hdf5Handle opened(H5Dopen2(file(), dataset.c_str(), H5P_DEFAULT), H5Dclose);
    for (std::size_t i = 0; i < scales.size(); ++i) {
      const Hdf5Handle scale(H5Dopen2(file(), scales[i].c_str(), H5P_DEFAULT), H5Dclose);
      const auto axis = static_cast<unsigned>(i);
      if (H5DSis_attached(opened, scale, axis) > 0)
        check(H5DSdetach_scale(opened, scale, axis) >= 0, dataset);
    }
  }
  remove(dataset);
}

void Hdf5GridWriter::write_scale(const std::string& dataset, const std::vector<double>& values,
                                 const std::string& units, const std::string& meaning) {
  constexpr std::size_t worth_packing = 4096;  // evenly spaced numbers shrink to a 20th
  put(dataset, H5T_NATIVE_DOUBLE, {values.size()}, values.data(),
      values.size() > worth_packing ? Compression::fast : Compression::none);
  describe(dataset, units, meaning);
  make_scale(dataset);
}

void Hdf5GridWriter::write_scale(const std::string& dataset, const std::vector<std::string>& names) {
  write(dataset, {names.size()}, names);
  make_scale(dataset);
}

void Hdf5GridWriter::write_virtual(const std::string& dataset, const Shape& outer, std::size_t rows,
                                   std::size_t cols, const std::vector<Block>& blocks) {
  std::vector<hsize_t> shape = extent(outer);
  shape.insert(shape.end(), {rows, cols});
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
  const hsize_t part[2] = {rows, cols};
  const Hdf5Handle part_space(H5Screate_simple(2, part, nullptr), H5Sclose);
  const Hdf5Handle properties = virtual_properties();
  std::vector<hsize_t> start(shape.size(), 0), count(shape.size(), 1);
  count[outer.size()] = rows;
  count[outer.size() + 1] = cols;
  for (const Block& block : blocks) {
    std::size_t rest = block.index;
    for (std::size_t axis = outer.size(); axis-- > 0; rest /= outer[axis]) start[axis] = rest % outer[axis];
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
    check(H5Pset_virtual(properties, space, block.file.c_str(), block.dataset.c_str(), part_space) >= 0,
          dataset);
  }
  H5Sselect_all(space);
  create(dataset, H5T_NATIVE_DOUBLE, space, properties);
}

void Hdf5GridWriter::write_patched(const std::string& dataset, std::size_t rows, std::size_t cols,
                                   const std::string& under, const std::vector<Patch>& patches) {
  const hsize_t shape[2] = {rows, cols};
  const Hdf5Handle space(H5Screate_simple(2, shape, nullptr), H5Sclose),
      rest(H5Screate_simple(2, shape, nullptr), H5Sclose);
  const Hdf5Handle properties = virtual_properties();
  const auto map = [&](const Hdf5Handle& cells, const std::string& source) {
    check(H5Pset_virtual(properties, cells, ".", source.c_str(), cells) >= 0, dataset);
  };
  H5Sselect_all(rest);
  for (const Patch& patch : patches) {
    H5Sselect_none(space);
    for (const CellRange& cells : patch.cells) {
      const hsize_t start[2] = {static_cast<hsize_t>(cells.row_begin), static_cast<hsize_t>(cells.col_begin)};
      const hsize_t count[2] = {static_cast<hsize_t>(cells.rows()), static_cast<hsize_t>(cells.cols())};
      H5Sselect_hyperslab(space, H5S_SELECT_OR, start, nullptr, count, nullptr);
      H5Sselect_hyperslab(rest, H5S_SELECT_NOTB, start, nullptr, count, nullptr);
    }
    map(space, patch.dataset);
  }
  if (H5Sget_select_npoints(rest) > 0) map(rest, under);
  H5Sselect_all(space);
  create(dataset, H5T_NATIVE_DOUBLE, space, properties);
}

}  // namespace sandstroke
