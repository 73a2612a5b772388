#pragma once

#include "haptics/stroke.h"

namespace sandstroke {

/// Adds samples to a stroke whose samples are the ends of straight lines. A StrokeSampler, which joins
/// samples by a curve, then leaves the lines by no more than about the tolerance [m]. A line gets one sample
/// close to each corner (in direction or speed) where the curve would leave it. From there on three samples
/// lie in a row, and the curve is the line. Corners of fine chords, which stand for a curve, get none. Other
/// columns change evenly along a line.
void keep_lines_straight(Stroke& stroke, double tolerance);

}  // namespace sandstroke
