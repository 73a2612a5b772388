#pragma once

#include "core/output_file.h"
#include "hdf5/hdf5_handle.h"

namespace sandstroke {

/// Takes the place of any HDF5 file.
inline constexpr OutputKind any_hdf5{"an HDF5 file", hdf5_signature};

}  // namespace sandstroke
