#pragma once

#include <string>

#include "core/key_visitor.h"
#include "haptics/stroke.h"

namespace sandstroke {

enum class Separator { found, comma, semicolon, tab, blanks };
enum class DecimalMark { found, point, comma };

/// How to treat a time stamp that equals the one before it: report it; keep only the first sample with that
/// stamp; or space the samples evenly up to the next stamp.
enum class EqualTimes { error, drop, spread };

/// How to treat a sample that lacks a value: leave it out and lift the tool, or report it.
enum class Missing { gap, error };

/// True for the word that switches off columns which their names would tell: force = "none".
inline bool is_none(const std::string& columns) { return columns == "none"; }

/// How a table of samples becomes a stroke ([stroke.table] in a scene). Settings that are empty, 0 or `found`
/// come from the table. Columns are named, or numbered from 1; lists have commas between their items. "none"
/// leaves out velocity, force, orientation or pressure, even if names tell them.
struct TableSettings {
  std::string position;       ///< 2 or 3 columns, each with - in front if its sign changes: "-x,z,y"
  std::string position_unit;  ///< m cm mm um in px, or metres: "1e-5"
  double pixel_size = 0.0;    ///< m, for px
  std::string time;           ///< or two columns: seconds and nanoseconds
  std::string time_unit;
  double rate = 0.0;   ///< Hz, instead of times
  double speed = 0.0;  ///< m/s, instead of times: they follow from the length of the way
  EqualTimes equal_times = EqualTimes::error;
  Missing missing = Missing::gap;
  std::string velocity, velocity_unit;
  std::string force, force_unit;
  ForceSign force_sign = ForceSign::not_said;
  std::string orientation;    ///< 4 columns (quaternion x, y, z, w) or 9 (rotation matrix, row by row)
  std::string pressure;       ///< column of the pen's pressure, in any unit
  std::string stroke_number;  ///< column that changes where another stroke of the pen begins
  std::string pen_state;      ///< column: the pen is down where it is not 0; with - in front: up
  std::string part;     ///< one of several recordings in a file: a bag's topic, a variable of a .mat file
  std::string columns;  ///< names of all columns, if the table has no header
  Separator separator = Separator::found;
  DecimalMark decimal = DecimalMark::found;
  std::string encoding;        ///< as iconv names it
  int skip_lines = 0;          ///< at the beginning
  std::string skip, pen_up;    ///< first words of lines
  std::string pen_down;        ///< G-code's word that lowers the pen
  double gap_threshold = 0.0;  ///< s; 0: usual_gap_threshold(), and none with `speed`
  std::string frame = "bed";   ///< "bed" or "device"
  std::string merge;           ///< a second table, with force or orientation at its own times
  std::string merge_part;      ///< `part` of the second table, which may be the same file
  std::string merge_time, merge_time_unit;
  double merge_rate = 0.0;   ///< Hz
  double merge_shift = 0.0;  ///< s, added to the times of the second table
};

/// Shows all keys of [stroke.table], which is open, and all options of `stroke convert`. It is the only list
/// of them.
void describe_table(KeyVisitor& visitor, TableSettings& table);

}  // namespace sandstroke
