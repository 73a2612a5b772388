#pragma once

#include <string>
#include <vector>

namespace sandstroke {

/// The meaning of a column's name, and its parts.
struct ColumnName {
  enum class Means { position, velocity, force, orientation, matrix, pressure, time, number, other };
  Means means = Means::other;
  std::string bare;       ///< without its unit
  std::string unit;       ///< "mm" of "x [mm]", "x (mm)", "x_mm", "x/mm"; empty: none
  std::string group;      ///< the name without the axis, in small letters: "tip pos" of "tip_pos.x"
  int axis = -1;          ///< 0 to 3: x, y, z, w; of a matrix 0 to 8, row by row
  bool numbered = false;  ///< its axis is a number, "pos.1"
  int rank = 0;           ///< the lower, the plainer is the name
};
ColumnName column_name(const std::string& name);

/// The parts of "a, b ,c", trimmed.
std::vector<std::string> parts_of_list(const std::string& list);

}  // namespace sandstroke
