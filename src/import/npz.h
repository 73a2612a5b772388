#pragma once

#include <filesystem>
#include <string>

#include "import/sample_table.h"

namespace sandstroke {

/// Reads columns from an archive of NumPy arrays (.npz, packed or not). An array of shape (samples) is the
/// column NAME; one of shape (samples, columns) gives NAME.1, NAME.2, ...; one with named fields NAME.FIELD.
/// Arrays of other kinds are left out. If arrays differ in length, `part` names one, and all of its length
/// are taken. Error: io; input, listing the arrays.
SampleTable read_npz(const std::filesystem::path& path, const std::string& part = "");

}  // namespace sandstroke
