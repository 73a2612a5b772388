#pragma once

#include <Eigen/Geometry>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "import/sample_table.h"

namespace sandstroke {

/// The end of a move, or a point of an arc.
struct GcodeSample {
  Eigen::Vector3d position;  // mm
  std::size_t line;
  double length, feed;     // of the move to here: mm, mm/s; 0: no speed was given
  bool down, lifts;        // according to M words
  bool along_xy, along_z;  // directions of the move to here
  bool from_home;          // the tool comes from home, which nobody knows: nothing is drawn on the way
  bool height_known;       // false: Z went home, and was not given since
};

/// The path along which a program of G-code leads its tool.
struct GcodePath {
  std::vector<GcodeSample> samples;
  std::string pen_word;        ///< lifts or lowers the pen: "M3", "M280 S90"; empty: no word does
  bool pen_is_named = false;   ///< by the user
  bool moves_rapidly = false;  ///< G0 moves along X or Y
  bool draws_rapidly = false;  ///< also with the pen down
  std::set<std::pair<char, int>> passed_over;  ///< words: letter, and number times 10
  std::set<std::size_t> homes;                 ///< lines at which the tool goes home from a path
};

/// How far the tip may be off lines and corners. The chords of usual arcs have no corners
/// (keep_lines_straight).
inline constexpr double gcode_line_tolerance = 0.01;  // mm

/// True if the path is somewhere above the lowest Z of its moves along X or Y, not only behind the last of
/// them.
bool z_may_lift_a_pen(const std::vector<GcodeSample>& samples);

/// A table of the samples at which the pen is down: according to M words, and to Z if it only moves by
/// itself. Error: input; `name` is the file's.
SampleTable table_of_gcode(const GcodePath& path, const std::string& name);

/// The box around the points of such a table [mm].
Eigen::AlignedBox3d box_of_gcode(const SampleTable& table);

}  // namespace sandstroke
