#include "import/mat.h"

#include <string_view>

#include "core/error.h"
#include "core/input_file.h"
#include "hdf5/hdf5_handle.h"
#include "import/array_budget.h"
#include "import/array_table.h"
#include "import/mat_hdf5.h"
#include "import/mat_level4.h"
#include "import/mat_level5.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

constexpr ArrayWords matlab_words = {
    "MATLAB file", "variable",
    "has no numeric vectors or matrices (tables and timeseries are not supported); save columns: s = "
    "table2struct(T, 'ToScalar', true); save('FILE.mat', '-struct', 's')",
    "A = A'"};

std::vector<NamedArray> arrays_of(const fs::path& path) {
  constexpr std::size_t matlab_header = 512;  // before HDF5 begins
  const std::string begin = beginning_of(path, matlab_header + hdf5_signature.size());
  if (begin.starts_with(hdf5_signature) || begin.ends_with(hdf5_signature)) return mat_hdf5_arrays(path);
  if (begin.starts_with("MATLAB 7.3"))
    throw_input_error(
        "{}: is a MATLAB file of version 7.3 without its HDF5 part; it is damaged: save it again",
        path.string());
  if (is_mat_level5(begin)) return mat_level5_arrays(whole_file(path), path.string());
  if (is_mat_level4(begin)) return mat_level4_arrays(whole_file(path), path.string());
  throw_input_error("{}: is not a MATLAB file that can be read; save it again: save('FILE.mat', '-v7')",
                    path.string());
}

}  // namespace

SampleTable read_mat(const fs::path& path, const std::string& part) {
  return table_of_arrays(arrays_of(path), part, path.string(), matlab_words);
}

}  // namespace sandstroke
