#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "compare/check.h"
#include "compare/golden_content.h"
#include "compare/run_checks.h"
#include "io/run_file.h"
#include "picture/image.h"
#include "sim/run_result.h"

namespace sandstroke {

// A golden entry is what the run of a scene must give, small enough for the repository: a folder with
//
//   golden.h5        the run in numbers (golden_content.h)
//   picture.png      the final surface in the scene's own view
//   provenance.toml  the build that wrote it, hashes of what it ran, the results; no date, so that the same
//                    run gives the same text
//   tolerances.toml  tolerances that people set for this entry (tolerances.h); may be missing

/// Where an entry is, and the command that makes it anew.
struct GoldenEntry {
  std::string name;  ///< of the scene
  std::filesystem::path folder;
  std::string update;  ///< "sandstroke golden update wscg"
};

/// A finished run of a scene, and what else a golden entry keeps of it.
struct GoldenRun {
  std::filesystem::path run_file;
  Image picture;
  RunResult result;
  double seconds = 0.0;  ///< for running and drawing
};

/// Checks that the files of an entry may be replaced. Call it before the run. Error: input, io.
void check_golden_replaceable(const std::filesystem::path& folder);

/// Writes a golden entry as a whole or not at all, in place of an old one if there is one. Other files in its
/// folder stay. Error: input where the run is not complete and finite, or files must not be replaced; io.
void write_golden(const std::filesystem::path& folder, const GoldenRun& run);

// Error: input where the file is missing or damaged.
GoldenContent read_golden(const GoldenEntry& entry);
Image read_golden_picture(const GoldenEntry& entry);
/// Names and values in provenance.toml: the build, and what it ran.
std::vector<std::pair<std::string, std::string>> golden_provenance(const GoldenEntry& entry);

/// Compares a run with a golden entry: the same scene and stroke, initial surface, change of heights, trace,
/// picture.
Comparison compare_golden(const GoldenEntry& entry, const GoldenRun& run, const Tolerances& tolerances);

}  // namespace sandstroke
