#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "import/stored_numbers.h"

namespace sandstroke {

/// A number, or several of one kind, in each element of a NumPy array.
struct NpyField {
  std::string name;  ///< "pos", "tip.pos" of a field in a field; empty: the whole element
  StoredType type;
  std::size_t offset = 0;  ///< bytes from the element's beginning
  std::size_t count = 1;   ///< numbers, one after the other
  std::string unit;        ///< of times: "s", "ms", "us", "ns"; empty: no time
  bool is_date = false;    ///< a time since 1970
  bool is_truth = false;   ///< True or False, as 1 or 0
};

/// What the header of a .npy file says.
struct NpyHeader {
  std::vector<std::size_t> shape;  ///< empty for a scalar
  bool column_major = false;       ///< "fortran_order"
  std::size_t element_bytes = 0;
  bool has_objects = false;      ///< of Python, pickled
  std::vector<NpyField> fields;  ///< that are real numbers or times
  std::size_t bytes = 0;         ///< of the header; the elements follow
};

/// Reads the beginning of a .npy file, of versions 1, 2 and 3. name: stands for the file in messages. Error:
/// input. Source: numpy.lib.format of NumPy 1.24.
NpyHeader npy_header(std::string_view bytes, const std::string& name);

}  // namespace sandstroke
