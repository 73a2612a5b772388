#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hdf5/hdf5_handle.h"

namespace sandstroke {

/// Also of a dataset of other files' numbers, which Hdf5Reader does not open.
inline std::vector<hsize_t> dataset_shape(const std::filesystem::path& path, const std::string& dataset) {
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, without_locks()), H5Fclose);
  const Hdf5Handle opened(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle space(H5Dget_space(opened), H5Sclose);
  std::vector<hsize_t> shape(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

}  // namespace sandstroke
