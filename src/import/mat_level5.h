#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "import/array_table.h"

namespace sandstroke {

/// Deepest nesting of structs that is read.
inline constexpr int most_mat_depth = 16;
/// Most variables of a MATLAB file, fields of structs included.
inline constexpr std::size_t most_mat_variables = 2'000;

/// True for the bytes of a MATLAB file of level 5 (versions 5 to 7).
bool is_mat_level5(std::string_view bytes);

/// The real vectors and matrices of a MATLAB file of level 5, and those of structs as STRUCT.FIELD. Single
/// numbers, and what is sparse, complex or of another class, are left out. Error: input, if it is damaged.
/// Source: MathWorks, "MAT-File Format", chapter 1.
std::vector<NamedArray> mat_level5_arrays(std::string_view bytes, const std::string& file);

/// The vector or matrix of MATLAB: column after column. Its samples are along the longer side.
NamedArray mat_array(const std::string& name, StoredType type, std::string_view bytes, std::size_t rows,
                     std::size_t columns);

}  // namespace sandstroke
