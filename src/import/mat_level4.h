#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "import/array_table.h"

namespace sandstroke {

/// True for the bytes of a MATLAB file of level 4, whose variables have no common header.
bool is_mat_level4(std::string_view bytes);

/// The real vectors and matrices of a MATLAB file of level 4. Single numbers, and what is sparse, complex or
/// text, are left out. Error: input, if it is damaged. Source: MathWorks, "MAT-File Format", chapter 2.
std::vector<NamedArray> mat_level4_arrays(std::string_view bytes, const std::string& file);

}  // namespace sandstroke
