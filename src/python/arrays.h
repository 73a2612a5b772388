#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "haptics/stroke.h"
#include "sand/height_field.h"

namespace sandstroke {

/// A read-only array over the owner's numbers, without a copy. The array keeps `owner` alive. strides: the
/// distances between numbers [bytes].
template <class Number>
pybind11::array view_of(const Number* first, std::vector<pybind11::ssize_t> shape,
                        std::vector<pybind11::ssize_t> strides, pybind11::handle owner) {
  pybind11::array array(pybind11::dtype::of<Number>(), std::move(shape), std::move(strides), first, owner);
  array.attr("setflags")(pybind11::arg("write") = false);
  return array;
}

/// An array over one field of consecutive records. `of` selects it, as visit_tick_fields() does.
template <class Record, class Of>
pybind11::array column_view(std::vector<Record>& records, const Of& of, pybind11::handle owner) {
  static Record none;
  auto& first = of(records.empty() ? none : records.front());
  using Field = std::decay_t<decltype(first)>;
  const auto rows = static_cast<pybind11::ssize_t>(records.size());
  constexpr auto step = static_cast<pybind11::ssize_t>(sizeof(Record));
  if constexpr (std::is_arithmetic_v<Field>)
    return view_of(&first, {rows}, {step}, owner);
  else
    return view_of(first.data(), {rows, first.size()}, {step, pybind11::ssize_t{sizeof(double)}}, owner);
}

/// A writable array over a copy of the grid, and the copy itself. Users may reshape or keep the array: the
/// numbers stay where they are, as long as either lives.
struct SharedGrid {
  explicit SharedGrid(const HeightGrid& grid);
  std::shared_ptr<HeightGrid> grid;
  pybind11::array_t<double> array;
};

/// Copies a grid into an array of its own.
pybind11::array_t<double> copy_of(const HeightGrid& grid);

// Centres of a bed's columns and rows [m].
pybind11::array_t<double> columns_of(const BedGeometry& bed);
pybind11::array_t<double> rows_of(const BedGeometry& bed);

/// Reads heights: two dimensions, rows along y; not-a-number where they are masked. Error: input, naming
/// `name`.
HeightGrid grid_with_gaps(const char* name, const pybind11::object& heights);
/// The same. Error: input, also if a height is masked or not a number.
HeightGrid grid_of(const char* name, const pybind11::object& heights);

/// Makes a stroke from arrays by column name (visit_columns): at least "time" [s] and "position" [m]. Error:
/// input, with the column's name and the shape that it must have.
Stroke stroke_of(const pybind11::dict& columns);

}  // namespace sandstroke
