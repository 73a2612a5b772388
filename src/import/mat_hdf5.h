#pragma once

#include <filesystem>
#include <vector>

#include "import/array_table.h"

namespace sandstroke {

/// The real vectors and matrices of a MATLAB file of version 7.3, which is an HDF5 file, and those of structs
/// as STRUCT.FIELD; also of an HDF5 file of another program, whose groups are taken for structs. Single
/// numbers, and what is sparse, complex or of another class, are left out; so are links by name and into
/// other files. Error: io; input, if it is damaged, or a struct holds itself.
std::vector<NamedArray> mat_hdf5_arrays(const std::filesystem::path& path);

}  // namespace sandstroke
