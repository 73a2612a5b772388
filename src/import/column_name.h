#pragma once

#include <string>
#include <vector>

namespace sandstroke {

/// The meaning of a column's name, and its parts.
struct ColumnName {
  enum class Means {
    position,
    velocity,
    force,
    orientation,
    matrix,
    pressure,
    time,
    number,                 ///< of the sample: "frame"
    stroke_number,          ///< another value: another stroke of the pen
    perhaps_stroke_number,  ///< "segment"
    pen_down,               ///< not 0: the pen is down
    pen_up,                 ///< not 0: the pen is up
    perhaps_pen_down,       ///< "button"
    perhaps_pen_up,         ///< "hover"
    other
  };
  Means means = Means::other;
  std::string bare;  ///< without its unit
  std::string
      unit;  ///< unit_symbol() of "x [mm]", "x (Millimetres)", "x_mm", "x/mm", "stamp.sec"; empty: none
  std::string
      group;  ///< the name without the axis, in small letters: "tip pos" of "tip_pos.x" and "x tip pos"
  std::string
      shape;  ///< the name with any axis in its place, and the unit: parts "x" from "X", "x [m]", "pos_x"
  /// 0 to 3: x, y, z, w; of a matrix 0 to 8, row by row; a number, if `numbered`.
  int axis = -1;
  bool numbered = false;  ///< its axis is a number, from 0 or 1 on: "pos.1", "pos_1", "pos[1]"
  bool dotted = false;    ///< "pos.1"
  int rank = 0;           ///< the lower, the plainer is the name
};
ColumnName column_name(const std::string& name);

/// The parts of "a, b ,c", trimmed.
std::vector<std::string> parts_of_list(const std::string& list);

}  // namespace sandstroke
