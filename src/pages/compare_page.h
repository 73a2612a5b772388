#pragma once

#include <filesystem>
#include <string>

#include "compare/check.h"
#include "compare/golden.h"
#include "compare/run_checks.h"
#include "io/run_file.h"
#include "pages/page_of_parts.h"
#include "picture/image.h"

namespace sandstroke {

// Pages on a comparison: the checks, maps of golden, run and difference, traces, and what is known about the
// files. Where the data of a part is missing or damaged, the page says so instead of showing it.

/// A page on two run files: final surfaces, initial ones where they differ, traces. coarsen: see
/// compare_runs().
PageOfParts run_page(const RunFile& golden, const RunFile& run, const Comparison& comparison,
                     const Tolerances& tolerances, bool coarsen = false);

/// A page on two pictures, with the names of their files.
PageOfParts picture_page(const std::filesystem::path& golden_file, const Image& golden,
                         const std::filesystem::path& run_file, const Image& run,
                         const Comparison& comparison, const Tolerances& tolerances);

/// A page on a run and its golden entry: change of height, picture, traces.
PageOfParts golden_page(const GoldenEntry& entry, const GoldenRun& run, const Comparison& comparison,
                        const Tolerances& tolerances);

}  // namespace sandstroke
