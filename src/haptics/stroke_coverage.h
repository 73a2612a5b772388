#pragma once

#include <string>

#include "haptics/stroke_sampler.h"

namespace sandstroke {

/// The part of a stroke that a run plays with the tool down, and the gaps in which the tool is lifted.
struct PlayedPart {
  double played = 0.0, whole = 0.0;  ///< s
  int gaps = 0;
};
PlayedPart played_part(const StrokeSampler& stroke);
/// "plays 0.055 s of 1.7 s: the tool is lifted in 30 gaps"
std::string played_text(const PlayedPart& part);

/// Returns a warning in three cases. Over a minute of the stroke, and over 99 % of it, has no samples
/// (Stroke::sampled_between): milliseconds were taken for seconds, or one time is wrong. A starved recorder
/// made it: the warning tells how much of it a run plays, and in how many gaps the tool is lifted. Most
/// samples are joined to no other. Otherwise empty, since hands do rest between two drags. `name` is the
/// stroke's.
std::string coverage_warning(const Stroke& stroke, const std::string& name);

}  // namespace sandstroke
