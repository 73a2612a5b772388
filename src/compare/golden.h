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
//   provenance.toml  the build that wrote it, what it ran (hashes), what came out; no date, so that the same
//                    run gives the same text
//   tolerances.toml  what people wrote who want other tolerances (tolerances.h); may be missing

/// Where one is, and what to type to make it anew.
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
  double seconds = 0.0;  ///< that running and drawing took
};

/// To be asked before the run: that the files of an entry may be replaced. Error: input, io.
void check_golden_replaceable(const std::filesystem::path& folder);

/// Puts a golden entry in place of what is there, if anything, as a whole or not at all. Other files in its
/// folder stay. Error: input where the run is not complete and finite, or files must not be replaced; io.
void write_golden(const std::filesystem::path& folder, const GoldenRun& run);

// Error: input where the file is missing or damaged.
GoldenContent read_golden(const GoldenEntry& entry);
Image read_golden_picture(const GoldenEntry& entry);
/// Name and value of what provenance.toml says about the build and what it ran.
std::vector<std::pair<std::string, std::string>> golden_provenance(const GoldenEntry& entry);

/// Judges a run by a golden entry: the same scene and stroke, initial surface, change of heights, trace,
/// picture.
Comparison compare_golden(const GoldenEntry& entry, const GoldenRun& run, const Tolerances& tolerances);

}  // namespace sandstroke
