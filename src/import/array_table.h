#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "import/sample_table.h"
#include "import/stored_numbers.h"

namespace sandstroke {

/// An array of a file that holds several, each with a name.
struct NamedArray {
  std::string name;
  std::size_t samples = 0, width = 0;
  std::vector<SampleColumn> columns;  ///< none, if the array is wider than it is long
};

/// The array of these numbers, without columns if it is wider than it is long. Its columns are NAME, or
/// NAME.1, NAME.2, ... Numbers that are not finite become NaN. Whole numbers of 16 and more digits are a
/// clock's stamps, and are taken relative to the first.
NamedArray named_array(const std::string& name, const StoredNumbers& numbers);

/// A table of columns of equal length, at least one of which has a finite number. Those without one are left
/// out, and the description says so. kind: "MATLAB file". Error: input, if no column is left.
SampleTable table_of_columns(std::vector<SampleColumn> columns, const std::string& kind,
                             const std::string& file);

/// The words for a format's arrays, and for what is in a file without any.
struct ArrayWords {
  const char *kind, *array;  ///< "MATLAB file", "variable"
  const char* none;          ///< ends "FILE: ", if there are no arrays
  const char* transpose;     ///< how the user transposes an array
};

/// A table of all arrays, if they have one length. Otherwise `part` names an array, and all of its length are
/// taken; or the beginning of names before a point ("s" of "s.x"), and these are taken. Error: input, listing
/// the arrays; or if one that is taken is wider than it is long, because then its samples may be its columns.
SampleTable table_of_arrays(std::vector<NamedArray> arrays, const std::string& part, const std::string& file,
                            const ArrayWords& words);

}  // namespace sandstroke
