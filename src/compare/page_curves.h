#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "compare/run_checks.h"

namespace sandstroke {

/// A curve as a page draws it.
struct Curve {
  std::vector<double> time;   ///< s
  std::vector<double> value;  ///< NaN: a gap
};

/// At most about `most` points that stand for all of a longer curve: of each of most / 2 stretches with
/// equally many points the least and the greatest, in their order, and the first that is not finite, if any.
/// So every extreme is kept, where and as it is. Each time has a value.
Curve thinned_curve(const Curve& curve, std::size_t most);

/// The traces of golden and run as a part of a page: force on the device (its magnitude and components),
/// depth and sand level, each with the difference run - golden over the ticks that both have (of the
/// magnitude: the length of the difference). A trace that is missing has no curves. Only what
/// trace_difference looks at is used.
nlohmann::ordered_json traces_part(const std::optional<CountedTrace>& golden,
                                   const std::optional<CountedTrace>& run, const Tolerances& tolerances);

}  // namespace sandstroke
