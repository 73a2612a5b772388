#pragma once

#include <Eigen/Core>
#include <set>
#include <string>
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
};

/// GcodePath::pen_word of an engraver, with M3 and M5, or S.
inline constexpr const char* gcode_spindle = "M3";

/// The path along which a program of G-code leads its tool.
struct GcodePath {
  std::vector<GcodeSample> samples;
  std::string pen_word;        ///< lifts or lowers the pen: "M3", "M280 S90"; empty: no word does
  bool draws_rapidly = false;  ///< G0 moves along X or Y
  std::set<int> passed_over;   ///< G words that were passed over, times 10
};

/// How far the tip may be off lines and corners. The chords of usual arcs have no corners
/// (keep_lines_straight).
inline constexpr double gcode_line_tolerance = 0.01;  // mm

/// A table of the samples at which the pen is down: according to M words, and to Z if it only moves by
/// itself. Error: input; `name` is the file's.
SampleTable table_of_gcode(const GcodePath& path, const std::string& name);

}  // namespace sandstroke
