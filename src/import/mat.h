#pragma once

#include <filesystem>
#include <string>

#include "import/sample_table.h"

namespace sandstroke {

/// Columns from a MATLAB file (.mat, up to version 7.3): its real numeric vectors and matrices, and those of
/// structs, one level deep, as STRUCT.FIELD. Samples go along the longer side. A vector is the column NAME; a
/// matrix gives NAME.1, NAME.2, ... Single numbers, and what is never finite, are left out; so are samples of
/// which a number is not finite. `part` names a variable or a struct, where the file has variables of several
/// lengths: all that are as long as it are taken (of a struct: its fields). Error: io; input, listing the
/// variables.
SampleTable read_mat(const std::filesystem::path& path, const std::string& part = "");

}  // namespace sandstroke
