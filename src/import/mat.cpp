#include "import/mat.h"

#include <matio.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "core/error.h"
#include "core/input_file.h"
#include "hdf5/hdf5_storage.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

using MatFile = std::unique_ptr<mat_t, decltype([](mat_t* file) { Mat_Close(file); })>;
using MatHandle = std::unique_ptr<matvar_t, decltype([](matvar_t* variable) { Mat_VarFree(variable); })>;

/// A vector or matrix, turned so that samples are rows.
struct MatVariable {
  std::string name;
  std::size_t samples = 0, width = 0;
  std::vector<std::vector<double>> columns;
};

class MatReader {
 public:
  explicit MatReader(const fs::path& path) : name_(path.string()) {
    check_readable(path);
    Mat_LogInitFunc("sandstroke", [](int, auto*) {});  // char* before 1.5.27, since then const char*
    file_.reset(Mat_Open(name_.c_str(), MAT_ACC_RDONLY));
    if (!file_)
      throw_input_error("{}: is not a MATLAB file that can be read; save it again: save('FILE.mat', '-v7')",
                        name_);
    bytes_left_ = most_unpacked(static_cast<double>(fs::file_size(path)));
  }

  std::vector<MatVariable> variables() {
    constexpr std::size_t most = 10'000;
    std::vector<MatVariable> found;
    while (const MatHandle variable{Mat_VarReadNextInfo(file_.get())}) {
      if (found.size() > most)
        throw_input_error("{}: has more than {} variables; save only the variables of one stroke", name_,
                          most);
      const std::string name = variable->name ? variable->name : "";
      if (variable->class_type != MAT_C_STRUCT) {
        take(variable.get(), name, found);
        continue;
      }
      char* const* fields = Mat_VarGetStructFieldnames(variable.get());
      const unsigned count =
          is_single(variable.get()) && fields ? Mat_VarGetNumberOfFields(variable.get()) : 0;
      for (unsigned i = 0; i < count; ++i)
        if (matvar_t* field = Mat_VarGetStructFieldByIndex(variable.get(), i, 0))
          take(field, fmt::format("{}.{}", name, fields[i]), found);
    }
    return found;
  }

 private:
  static bool is_single(const matvar_t* variable) {
    return variable->rank == 2 && variable->dims && variable->dims[0] == 1 && variable->dims[1] == 1;
  }

  void take(matvar_t* variable, const std::string& name, std::vector<MatVariable>& found) {
    const bool numbers = variable->class_type >= MAT_C_DOUBLE && variable->class_type <= MAT_C_UINT64;
    if (!numbers || variable->isComplex || variable->rank != 2 || !variable->dims || is_single(variable))
      return;
    const std::size_t rows = variable->dims[0], columns = variable->dims[1];
    if (rows == 0 || columns == 0) return;
    bytes_left_ -= static_cast<double>(rows) * static_cast<double>(columns) * sizeof(double);
    if (bytes_left_ < 0.0 || Mat_VarReadDataAll(file_.get(), variable) != 0 || !variable->data)
      throw_input_error("{}: variable {} of {} by {} cannot be read; the file is damaged: save it again",
                        name_, name, rows, columns);
    const auto entry = entries(variable);
    const std::size_t size = Mat_SizeOfClass(variable->class_type);
    if (variable->nbytes / size / rows < columns)
      throw_input_error("{}: variable {} is cut off; save the file again", name_, name);
    MatVariable made{name, std::max(rows, columns), std::min(rows, columns), {}};
    for (std::size_t k = 0; k < made.width; ++k) {
      std::vector<double>& column = made.columns.emplace_back();
      for (std::size_t i = 0; i < made.samples; ++i)
        column.push_back(entry(variable->data, columns > rows ? k + i * rows : i + k * rows));
    }
    found.push_back(std::move(made));
  }

  using Entry = double (*)(const void* values, std::size_t i);
  template <class Number>
  static double entry_of(const void* values, std::size_t i) {
    return static_cast<double>(static_cast<const Number*>(values)[i]);
  }
  static Entry entries(const matvar_t* variable) {
    switch (variable->class_type) {
      case MAT_C_SINGLE:
        return entry_of<float>;
      case MAT_C_INT8:
        return entry_of<std::int8_t>;
      case MAT_C_UINT8:
        return entry_of<std::uint8_t>;
      case MAT_C_INT16:
        return entry_of<std::int16_t>;
      case MAT_C_UINT16:
        return entry_of<std::uint16_t>;
      case MAT_C_INT32:
        return entry_of<std::int32_t>;
      case MAT_C_UINT32:
        return entry_of<std::uint32_t>;
      case MAT_C_INT64:
        return entry_of<std::int64_t>;
      case MAT_C_UINT64:
        return entry_of<std::uint64_t>;
      default:
        return entry_of<double>;
    }
  }

  std::string name_;
  MatFile file_;
  double bytes_left_ = 0.0;
};

std::string listed(const std::vector<MatVariable>& variables) {
  std::vector<std::string> names;
  for (const MatVariable& one : variables)
    names.push_back(fmt::format("{} ({} x {})", one.name, one.samples, one.width));
  return fmt::format("{}", fmt::join(names, ", "));
}

/// The variables to take, all of one length.
std::vector<MatVariable> chosen(std::vector<MatVariable> variables, const std::string& part,
                                const std::string& name) {
  const auto exact =
      std::find_if(variables.begin(), variables.end(), [&](const auto& one) { return one.name == part; });
  std::vector<MatVariable> fit;
  std::set<std::size_t> lengths;
  for (const MatVariable& one : variables) {
    if (exact != variables.end() ? one.samples == exact->samples
                                 : part.empty() || one.name.starts_with(part + ".")) {
      fit.push_back(one);
      lengths.insert(one.samples);
    }
  }
  if (fit.empty())
    throw_input_error("{}: has no variable '{}'; stroke.table.part (stroke convert: --part) takes one of: {}",
                      name, part, listed(variables));
  if (lengths.size() == 1) return fit;
  throw_input_error(
      "{}: its variables differ in length; name one with stroke.table.part (stroke convert: --part), and all "
      "variables of that length are read: {}",
      name, listed(fit));
}

}  // namespace

SampleTable read_mat(const fs::path& path, const std::string& part) {
  std::vector<MatVariable> variables = MatReader(path).variables();
  if (variables.empty()) {
    throw_input_error(
        "{}: has no numeric vectors or matrices (tables and timeseries are not supported); save columns: s = "
        "table2struct(T, 'ToScalar', true); save('FILE.mat', '-struct', 's')",
        path.string());
  }
  SampleTable table;
  for (MatVariable& one : chosen(std::move(variables), part, path.string()))
    for (std::size_t k = 0; k < one.columns.size(); ++k)
      table.columns.push_back(
          {one.width == 1 ? one.name : fmt::format("{}.{}", one.name, k + 1), "", std::move(one.columns[k])});
  table.description = fmt::format("MATLAB file: {} columns, {} samples", table.columns.size(), table.size());
  return table;
}

}  // namespace sandstroke
