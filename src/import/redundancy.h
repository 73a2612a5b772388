#pragma once

#include <string>
#include <vector>

#include "haptics/stroke.h"
#include "import/sample_table.h"

namespace sandstroke {

// Compare what a table says twice. Each returns a sentence for people that names both, without the file; it
// is empty if they agree, or cannot be compared.

/// The times of a column against a stroke that lasts `duration` [s] by something else, such as a rate; `by`
/// names that. unit: of the column; empty: not known, any is taken. Durations may differ by `factor`,
/// and by a step at each end of stamps that are coarser than the samples.
std::string time_disagreement(const SampleColumn& column, const std::string& unit, double duration,
                              const std::string& by, double factor);

/// Numbers of the samples ("frame"), which skip those that were lost, against the times [s] of all samples.
std::string number_disagreement(const SampleColumn& numbers, const std::vector<double>& time);

/// The recorded velocity against positions over time: the speed shows a mistake in a unit, the direction one
/// in an axis. The names are those of the columns, one per axis.
std::string velocity_disagreement(const Stroke& stroke, const std::vector<std::string>& position,
                                  const std::vector<std::string>& velocity);

/// A step to the next sample that leads across a part of the stroke and is much faster than all others; or to
/// or from a sample that stands alone, and much faster than most.
struct Jump {
  std::size_t sample = 0;  ///< at its end
  double distance = 0.0;   ///< m
  double time = 0.0;       ///< s
  double ratio = 0.0;      ///< to the speed of the fastest other steps, or of the usual ones
};
/// All such steps, where the tool is not lifted.
std::vector<Jump> jumps_of(const Stroke& stroke);

}  // namespace sandstroke
