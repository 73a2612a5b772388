#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/check.h"
#include "compare/run_checks.h"
#include "io/run_file.h"
#include "picture/image.h"
#include "sim/run_result.h"

namespace sandstroke {

// A golden entry is what the run of a scene must give, small enough for the repository: a folder with
//
//   golden.h5        attributes of /: format = "sandstroke.golden", format_version = 1
//     /surface         attributes rows, cols, cell_size [m], and initial_hash (of the initial heights in
//                      steps of 2^-20 m: coarse, so that the last bits of sin() do not matter)
//     /surface/change  (n, m) float64, final - initial height [m] of the smallest block of cells with all of
//                      it, from (row, col) on (two attributes); rounded to 2^-30 m
//     /trace           attribute ticks
//     /trace/rows      (7, k) float64 of every 10th tick: time [s], three rows of device_force [N], depth and
//                      level [m], contact (0 or 1); force rounded to 2^-20 N, depth and level to 2^-30 m
//   picture.png      the final surface in the scene's own view
//   provenance.toml  the build that wrote it, what it ran (hashes), what came out; no date, so that the same
//                    run gives the same text
//
// Rounding costs at most 4.7e-10 m and 4.8e-7 N, far below the tolerances.

/// A finished run of a scene, and what else a golden entry keeps of it.
struct GoldenRun {
  std::filesystem::path run_file;
  Image picture;
  RunResult result;
};

/// To be asked before the run: that the files of an entry may be replaced. Error: input, io.
void check_golden_replaceable(const std::filesystem::path& entry);

/// Puts a golden entry in place of what is there, if anything, as a whole or not at all. Other files in its
/// folder stay. Error: input where the run is not complete and finite, or files must not be replaced; io.
void write_golden(const std::filesystem::path& entry, const GoldenRun& run);

/// golden.h5, read back.
struct GoldenContent {
  double cell_size = 0.0;  ///< m
  std::string initial_hash;
  HeightGrid change;                  ///< m, of the whole bed
  std::optional<CountedTrace> trace;  ///< every 10th tick; its other fields say nothing
};

// Error: input where the file is missing or damaged.
GoldenContent read_golden(const std::filesystem::path& entry);
Image read_golden_picture(const std::filesystem::path& entry);
/// Name and value of what provenance.toml says about the build and what it ran.
std::vector<std::pair<std::string, std::string>> golden_provenance(const std::filesystem::path& entry);

/// Final - initial heights [m] of a run.
HeightGrid height_change(const RunFile& run);

/// The trace of a run as a golden entry keeps it, but not rounded; none where the run has none.
std::optional<CountedTrace> golden_trace(const RunFile& run);

/// Judges a run by a golden entry: the same scene and stroke, initial surface, change of heights, trace,
/// picture.
Comparison compare_golden(const std::string& name, const std::filesystem::path& entry, const GoldenRun& run,
                          const Tolerances& tolerances);

}  // namespace sandstroke
