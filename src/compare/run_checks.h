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

// What both a pair of run files and a golden entry are judged by. Whatever is missing or of another shape is
// a check that failed, with a sentence.

/// True for a complete run.
Check complete_check(const std::string& which, const RunFile& run);

/// That the surfaces of all frames of both can be read; they are not compared, the final ones are. Error:
/// input, where one cannot, or holds what is not a number.
Check frames_check(const RunFile& golden, const RunFile& run);

/// Two surfaces of one bed, cell by cell; beds of other cells fail.
Check height_check(const std::string& name, const HeightField& golden, const HeightField& run, double limit);

/// Cell sizes [m]: the same up to rounding.
Check cell_size_check(double golden, double run);

/// Numbers of ticks (the same), and time, force, depth and level over the ticks that both traces have. A
/// trace that is missing on one side fails; on both, there is nothing to compare.
std::vector<Check> trace_checks(const std::optional<std::vector<TickRecord>>& golden,
                                const std::optional<std::vector<TickRecord>>& run,
                                const Tolerances& tolerances);

/// Largest difference and share of differing pixels.
std::vector<Check> picture_checks(const Image& golden, const Image& run, const Tolerances& tolerances);

/// Appends what `make` returns, with the time that it took, or, where the data it asks for is missing or
/// damaged (Error: input), the failed check `name` with the error's sentence. What is_of_the_machine() says
/// nothing about the data: Error.
void add_checks(std::vector<Check>& checks, const std::string& name,
                const std::function<std::vector<Check>()>& make);

}  // namespace sandstroke
