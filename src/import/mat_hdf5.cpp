#include "import/mat_hdf5.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include "core/error.h"
#include "hdf5/foreign_hdf5_reader.h"
#include "import/array_budget.h"
#include "import/mat_level5.h"

namespace sandstroke {
namespace {

using Member = ForeignHdf5Reader::Member;

/// MATLAB's classes of numbers.
constexpr std::array number_classes = {"double", "single", "int8",  "uint8",  "int16",  "uint16",
                                       "int32",  "uint32", "int64", "uint64", "logical"};

class MatHdf5Reader {
 public:
  explicit MatHdf5Reader(const std::filesystem::path& path)
      : file_(path), budget_(path.string(), file_.file_bytes()) {}

  std::vector<NamedArray> arrays() {
    take_members("/", "");
    return std::move(arrays_);
  }

 private:
  /// The class that MATLAB gives an object; empty: none, because another program wrote it.
  std::string class_of(const std::string& object) const {
    return file_.has_attribute(object, "MATLAB_class") ? file_.text_attribute(object, "MATLAB_class") : "";
  }
  bool is_marked(const std::string& object, const char* mark) const {
    return file_.has_attribute(object, mark) && file_.number_attribute(object, mark) != 0.0;
  }

  /// Takes what is in a group. prefix: what the names of its members begin with, "s.".
  void take_members(const std::string& group, const std::string& prefix) {
    for (const Member& member : file_.own_members(group, most_mat_variables)) {
      if (prefix.empty() && member.name.starts_with('#')) continue;  // MATLAB's own: #refs#, #subsystem#
      if (++seen_ > most_mat_variables)
        throw_input_error("{}: has more than {} variables; save only the variables of one stroke",
                          file_.name(), most_mat_variables);
      if (member.kind == Member::Kind::group) take_struct(member, prefix + member.name);
      if (member.kind == Member::Kind::dataset) take_dataset(member.path, prefix + member.name);
    }
  }

  void take_struct(const Member& group, const std::string& name) {
    const std::string type = class_of(group.path);
    if ((!type.empty() && type != "struct") || file_.has_attribute(group.path, "MATLAB_sparse")) return;
    if (std::find(around_.begin(), around_.end(), group.place) != around_.end())
      throw_input_error("{}: struct {} holds itself; the file is damaged: save it again", file_.name(), name);
    if (around_.size() >= most_mat_depth)
      throw_input_error("{}: structs are nested deeper than {} in {}; save the struct of one stroke",
                        file_.name(), most_mat_depth, name);
    around_.push_back(group.place);
    take_members(group.path, name + ".");
    around_.pop_back();
  }

  void take_dataset(const std::string& dataset, const std::string& name) {
    if (!file_.has_numbers(dataset)) return;
    const std::string type = class_of(dataset);
    const bool by_matlab = !type.empty();
    if (by_matlab && std::find(number_classes.begin(), number_classes.end(), type) == number_classes.end())
      return;
    if (is_marked(dataset, "MATLAB_empty")) return;
    const std::vector<hsize_t> shape = file_.shape(dataset);
    if (shape.empty() || shape.size() > 2) return;
    const hsize_t outer = shape.front(), inner = shape.size() == 2 ? shape.back() : 1;
    if (outer == 0 || inner == 0 || (outer == 1 && inner == 1)) return;
    budget_.take(name, static_cast<double>(outer) * static_cast<double>(inner));
    const ForeignHdf5Reader::Numbers numbers = file_.numbers(dataset);
    StoredType stored{static_cast<StoredType::Kind>(numbers.kind), 8,
                      std::endian::native == std::endian::big};
    // HDF5 holds MATLAB's columns one after the other, as rows. Of other programs' squares, rows are samples.
    const bool square_by_rows = !by_matlab && outer == inner;
    arrays_.push_back(square_by_rows ? named_array(name, {stored, numbers.bytes, outer, inner,
                                                          inner * sizeof(double), sizeof(double)})
                                     : mat_array(name, stored, numbers.bytes, inner, outer));
  }

  ForeignHdf5Reader file_;
  ArrayBudget budget_;
  std::size_t seen_ = 0;
  std::vector<std::string> around_;  // places of the groups that are open
  std::vector<NamedArray> arrays_;
};

}  // namespace

std::vector<NamedArray> mat_hdf5_arrays(const std::filesystem::path& path) {
  return MatHdf5Reader(path).arrays();
}

}  // namespace sandstroke
