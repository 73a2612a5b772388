#pragma once

#include <string>

#include "haptics/stroke.h"

namespace sandstroke {

/// A sentence for whoever took milliseconds for seconds, or has one time that is wrong: over a minute of the
/// stroke, and over 99 % of it, lie where there are no samples (Stroke::sampled_between). Empty: not so, for
/// hands do rest between two drags. `name` is the stroke's.
std::string coverage_warning(const Stroke& stroke, const std::string& name);

}  // namespace sandstroke
