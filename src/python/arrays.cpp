#include "python/arrays.h"

#include <pybind11/stl.h>
#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "core/error.h"
#include "haptics/gap_threshold.h"

namespace sandstroke {
namespace {

namespace py = pybind11;

template <class Number>
using Dense = py::array_t<Number, py::array::c_style | py::array::forcecast>;

std::string shape_text(const py::array& array) {
  std::vector<py::ssize_t> shape(array.shape(), array.shape() + array.ndim());
  return fmt::format("({})", fmt::join(shape, ", "));
}

/// The mask of a masked array, row by row; none: it is no masked array. Read as an array like others, it has
/// any numbers under its mask.
std::optional<Dense<bool>> mask_of(const py::object& given) {
  const py::object masked = py::module_::import("numpy").attr("ma");
  if (!py::isinstance(given, masked.attr("MaskedArray"))) return {};
  return Dense<bool>(masked.attr("getmaskarray")(given));
}

template <class Number>
Dense<Number> numbers(const char* name, const py::object& given, py::ssize_t components) {
  py::array array;
  try {
    array = py::array(given);
  } catch (const py::error_already_set&) {
    array = py::array();
  }
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u' && kind != 'b')
    throw_input_error("stroke: {} must be an array of numbers", name);
  const bool fits = components == 0 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == components;
  if (!fits)
    throw_input_error("stroke: {} has the shape {}; it must be {}", name, shape_text(array),
                      components == 0 ? "(n,)" : fmt::format("(n, {})", components));
  if (const std::optional<Dense<bool>> mask = mask_of(given))
    if (const auto masked = std::count(mask->data(), mask->data() + mask->size(), true); masked > 0)
      throw_input_error("stroke: {} has {} masked numbers; fill them, or leave these samples out", name,
                        masked);
  return Dense<Number>(array);
}

template <class Number>
void take(const char* name, const py::object& given, std::vector<Number>& column) {
  if constexpr (std::is_arithmetic_v<Number>) {
    const Dense<Number> array = numbers<Number>(name, given, 0);
    column.assign(array.data(), array.data() + array.size());
  } else {
    constexpr py::ssize_t components = Number::SizeAtCompileTime;
    const Dense<double> array = numbers<double>(name, given, components);
    column.resize(static_cast<std::size_t>(array.shape(0)));
    for (std::size_t i = 0; i < column.size(); ++i)
      column[i] = Eigen::Map<const Number>(array.data() + components * static_cast<py::ssize_t>(i));
  }
}

}  // namespace

SharedGrid::SharedGrid(const HeightGrid& heights) : grid(std::make_shared<HeightGrid>(heights)) {
  const py::capsule owner(new std::shared_ptr<HeightGrid>(grid),
                          [](void* kept) { delete static_cast<std::shared_ptr<HeightGrid>*>(kept); });
  array = py::array_t<double>({grid->rows(), grid->cols()}, grid->data(), owner);
}

py::array_t<double> copy_of(const HeightGrid& grid) {
  py::array_t<double> array({grid.rows(), grid.cols()});
  std::copy(grid.data(), grid.data() + grid.size(), array.mutable_data());
  return array;
}

py::array_t<double> columns_of(const BedGeometry& bed) {
  py::array_t<double> centres(bed.cols());
  for (int col = 0; col < bed.cols(); ++col) centres.mutable_at(col) = bed.x_of(col);
  return centres;
}

py::array_t<double> rows_of(const BedGeometry& bed) {
  py::array_t<double> centres(bed.rows());
  for (int row = 0; row < bed.rows(); ++row) centres.mutable_at(row) = bed.y_of(row);
  return centres;
}

HeightGrid grid_with_gaps(const char* name, const py::object& given) {
  py::array array;
  try {
    array = py::array(given);
  } catch (const py::error_already_set&) {
  }
  const char kind = array.dtype().kind();
  if (array.ndim() != 2 || (kind != 'f' && kind != 'i' && kind != 'u'))
    throw_input_error("{}: must have two dimensions of numbers, rows along y and columns along x", name);
  const Dense<double> heights(array);
  HeightGrid grid = Eigen::Map<const HeightGrid>(heights.data(), heights.shape(0), heights.shape(1));
  if (const std::optional<Dense<bool>> mask = mask_of(given))
    for (py::ssize_t i = 0; i < mask->size(); ++i)
      if (mask->data()[i]) grid.data()[i] = std::numeric_limits<double>::quiet_NaN();
  return grid;
}

HeightGrid grid_of(const char* name, const py::object& given) {
  HeightGrid grid = grid_with_gaps(name, given);
  if (!grid.allFinite()) throw_input_error("{}: a height is masked or not a number", name);
  return grid;
}

Stroke stroke_of(const py::dict& columns) {
  Stroke stroke;
  stroke.source = "stroke";
  std::size_t known = 0;
  std::vector<std::string> names;
  if (columns.contains("gap_threshold")) {
    ++known;
    stroke.gap_threshold =
        numbers<double>("gap_threshold", py::make_tuple(columns["gap_threshold"]), 0).at(0);
    if (!(stroke.gap_threshold > 0.0)) throw_input_error("stroke: gap_threshold must be above 0 s");
  }
  visit_columns(stroke, [&](const char* name, auto& column) {
    names.emplace_back(name);
    if (!columns.contains(name) || py::object(columns[name]).is_none()) {
      known += columns.contains(name);
      return;
    }
    ++known;
    take(name, columns[name], column);
  });
  if (known != columns.size()) {
    for (const auto& [name, column] : columns)
      if (const auto text = name.cast<std::string>();
          text != "gap_threshold" && std::find(names.begin(), names.end(), text) == names.end())
        throw_input_error(
            "stroke: '{}' is not a column of a stroke; the columns are {}, also pen_down and gap_threshold{}",
            text, fmt::join(names, ", "),
            text == "x" || text == "y" || text == "z" ? "; x, y and z are the columns of position (n, 3)"
                                                      : "");
  }
  for (const char* name : {"time", "position"})
    if (!columns.contains(name)) throw_input_error("stroke: needs the column {}", name);
  if (!columns.contains("gap_threshold")) stroke.gap_threshold = usual_gap_threshold(stroke);
  check_stroke(stroke, "stroke");
  return stroke;
}

}  // namespace sandstroke
