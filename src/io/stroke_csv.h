#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/stroke.h"

namespace sandstroke {

/// A unit as an exact ratio to the SI unit: value * factor / divisor rounds only once for whole numbers (66
/// ms is the double nearest to 0.066 s), which value * 0.001 does not.
struct Unit {
  double factor = 1.0, divisor = 1.0;
  double to_si(double value) const { return value * factor / divisor; }
};

// Error: input, listing the units there are. pixel_size [m]: what "px" stands for, 0 = not given.
Unit position_unit(const std::string& name, double pixel_size);  ///< m cm mm um in px
Unit time_unit(const std::string& name);                         ///< s ms us ns
Unit speed_unit(const std::string& name);                        ///< m/s cm/s mm/s
Unit force_unit(const std::string& name);                        ///< N mN

/// What to do where a time stamp equals the one before it: report it; keep only the first sample with that
/// stamp; or space the samples evenly up to the next stamp.
enum class EqualTimes { error, drop, spread };

/// Three columns of a table, or two (then z is 0).
struct VectorColumns {
  std::vector<std::string> names;
  Unit unit;
};

/// How a table of samples is to be understood.
struct StrokeCsvFormat {
  VectorColumns position;
  std::optional<VectorColumns> velocity, force;
  std::optional<std::string> time;  ///< column; or else
  double rate = 0.0;                ///< Hz: the samples follow each other evenly
  Unit time_unit;
  std::vector<std::string> columns;  ///< names, where the file has no header row
  std::string pen_up, skip;          ///< a line with this word lifts the pen / is passed over; empty = none
  EqualTimes equal_times = EqualTimes::error;
};

/// Reads a table of comma-separated numbers as a stroke: one sample per line, a header row first unless
/// format.columns names the columns. Of any length: the text is not kept. Blank lines, CRLF and a byte-order
/// mark are fine. After a pen_up line the pen strokes are kept apart (PenState), also where equal stamps are
/// dropped.
///
/// spread: the samples of a run of k equal stamps are placed evenly up to the next stamp, 1/k of the way
/// apart. A run that ends a pen stroke (or the file) is placed with the spacing before it instead, where that
/// is less: what follows is no part of the drawing. Error: input, naming file and line; io where it cannot be
/// read.
Stroke read_stroke_csv(const std::filesystem::path& path, const StrokeCsvFormat& format);
/// The same from text; `name` stands for the file in messages.
Stroke parse_stroke_csv(std::string_view text, const std::string& name, const StrokeCsvFormat& format);

}  // namespace sandstroke
