#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "import/array_budget.h"
#include "import/array_table.h"

namespace sandstroke {

/// Reads the columns of a NumPy array (.npy): of shape (samples) or (samples, columns), whose columns are 1,
/// 2,
/// ...; or with named fields, which are columns FIELD, or FIELD.1, FIELD.2, ... if a field has several
/// numbers. Error: io; input, if it holds something else, or is wider than it is long.
SampleTable read_npy(const std::filesystem::path& path);

/// An array from a .npy file, or why it gives no columns: text, complex or single numbers, Python's objects,
/// or another number of dimensions.
struct NpyArray {
  NamedArray array;
  std::string why_not;  ///< ends "FILE: "; empty: it has columns, or is wider than it is long
};

/// The array in the bytes of a .npy file. Its columns are NAME, or NAME.1, NAME.2, ...; of named fields
/// NAME.FIELD. label: stands for the file in messages. Error: input, if it is damaged.
NpyArray npy_array(std::string_view bytes, const std::string& name, const std::string& label,
                   ArrayBudget& budget);

}  // namespace sandstroke
