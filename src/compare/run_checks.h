#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/check.h"
#include "compare/tolerances.h"
#include "io/run_file.h"
#include "picture/image.h"

namespace sandstroke {

// Checks for both a pair of run files and a golden entry. Data that is missing or of another shape gives a
// failed check with a sentence.

/// Passes for a complete run.
Check complete_check(const std::string& which, const RunFile& run);

/// Checks that the surfaces of all frames of both can be read. It does not compare them; the final ones are
/// compared. Error: input, where one cannot be read, or holds what is not a number.
Check frames_check(const RunFile& golden, const RunFile& run);

/// Compares two surfaces of one bed, cell by cell. Beds of other cells fail.
Check height_check(const std::string& name, const HeightField& golden, const HeightField& run, double limit);

/// Compares the floors under the sand of two runs; no check where neither has one. Cells that have a floor in
/// one run only fail, as do floors that are further apart than limit [m], or of other cells.
std::vector<Check> floor_checks(const RunFile& golden, const RunFile& run, double limit);

/// Compares cell sizes [m]: they are the same up to rounding.
Check cell_size_check(double golden, double run);

/// Compares the numbers of ticks, and time, force, depth and level over the ticks that both traces have. A
/// trace that only one side has fails. Where neither has one, the check passes.
std::vector<Check> trace_checks(const std::optional<std::vector<TickRecord>>& golden,
                                const std::optional<std::vector<TickRecord>>& run,
                                const Tolerances& tolerances);

/// The largest difference of two pictures, and the fraction of their pixels that differ by more than
/// pixel_above.
std::vector<Check> picture_checks(const Image& golden, const Image& run, const Tolerances& tolerances);

/// Appends what `make` returns, with the time it took. Where the data is missing or damaged (Error: input),
/// appends the failed check `name` with the error's sentence. Passes on errors that is_of_the_machine(): they
/// say nothing about the data.
void add_checks(std::vector<Check>& checks, const std::string& name,
                const std::function<std::vector<Check>()>& make);

}  // namespace sandstroke
