#pragma once

#include <string>

#include "haptics/stroke_sampler.h"

namespace sandstroke {

/// What of a stroke a run plays with the tool down, and the gaps in which it is lifted.
struct PlayedPart {
  double played = 0.0, whole = 0.0;  ///< s
  int gaps = 0;
};
PlayedPart played_part(const StrokeSampler& stroke);
/// "plays 0.055 s of 1.7 s: the tool is lifted in 30 gaps"
std::string played_text(const PlayedPart& part);

/// A sentence for whoever took milliseconds for seconds, or has one time that is wrong: over a minute of the
/// stroke, and over 99 % of it, lie where there are no samples (Stroke::sampled_between). Or for whoever
/// plays what a starved recorder left, and where it lifts the tool; or samples of which most are joined to
/// no other. Empty: not so, for hands do rest between two drags. `name` is the stroke's.
std::string coverage_warning(const Stroke& stroke, const std::string& name);

}  // namespace sandstroke
