#pragma once

#include <filesystem>
#include <string>

#include "import/sample_table.h"

namespace sandstroke {

/// Reads columns from a MATLAB file (.mat, versions 4 to 7.3): its real numeric vectors and matrices, and
/// those of structs, as STRUCT.FIELD. Samples go along the longer side. A vector is the column NAME; a matrix
/// gives NAME.1, NAME.2, ... Single numbers and columns without a finite number are left out. If the file has
/// variables of several lengths, `part` names a variable, and all of its length are taken; or a struct, and
/// its fields are taken. Error: io; input, listing the variables.
SampleTable read_mat(const std::filesystem::path& path, const std::string& part = "");

}  // namespace sandstroke
