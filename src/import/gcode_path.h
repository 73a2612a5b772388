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
  double length, feed;     // of the way here: mm, mm/s; 0 where no speed was said
  bool down, lifts;        // as M words have it
  bool along_xy, along_z;  // the way here
};

/// As GcodePath::pen_word: M3 and M5, or S, of an engraver.
inline constexpr const char* gcode_spindle = "M3";

/// Where a program of G-code leads its tool.
struct GcodePath {
  std::vector<GcodeSample> samples;
  std::string pen_word;        ///< that says whether the pen is down: "M3", "M280 S90"; empty: none does
  bool draws_rapidly = false;  ///< G0 leads along X or Y
  std::set<int> passed_over;   ///< G words that were, in tenths
};

/// How far the tip may be off lines and corners. The chords of usual arcs have none (keep_lines_straight).
inline constexpr double gcode_line_tolerance = 0.01;  // mm

/// The samples at which the pen is down: by the M words, and by Z where it only moves by itself. Error:
/// input; `name` is the file's.
SampleTable table_of_gcode(const GcodePath& path, const std::string& name);

}  // namespace sandstroke
