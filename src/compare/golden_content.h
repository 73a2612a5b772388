#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "compare/run_checks.h"
#include "io/run_file.h"

namespace sandstroke {

// golden.h5 is what a golden entry keeps of a run in numbers:
//
//   attributes of /: format = "sandstroke.golden", format_version = 2
//   /scene           the resolved scene (TOML)
//   /surface         attributes rows, cols, cell_size [m], and initial_hash (of the initial heights in
//                    steps of 2^-20 m: coarse, so that the last bits of sin() do not matter)
//   /surface/change  (n, m) float64, final - initial height [m], rounded to 2^-30 m, in the smallest block
//                    that holds all changes; the attributes row and col say where the block begins
//   /trace           attribute servo_rate [Hz]
//   /trace/ticks     (7, ticks) uint64, every tick, as golden_trace.h says
//
// Rounding costs at most 4.7e-10 m of a height, 3.8e-6 N of a force's component and 3.8e-9 m of a depth: far
// below the tolerances.
/// golden.h5, read back.
struct GoldenContent {
  std::string scene;       ///< resolved, as TOML
  double cell_size = 0.0;  ///< m
  std::string initial_hash;
  HeightGrid change;  ///< m, of the whole bed
  std::optional<std::vector<TickRecord>> trace;
};

/// A hash of the initial heights [m].
std::string initial_hash(const HeightGrid& heights);

/// Final - initial heights [m] of a run.
HeightGrid height_change(const RunFile& run);

/// Writes golden.h5. Error: input, where the run is not complete or not finite; io.
void write_golden_content(const std::filesystem::path& path, const RunFile& run);

/// Reads golden.h5. update: the command that makes the entry anew, for messages. Error: input, where the file
/// is damaged or of another format.
GoldenContent read_golden_content(const std::filesystem::path& path, const std::string& update);

}  // namespace sandstroke
