#pragma once

#include "haptics/stroke.h"

namespace sandstroke {

/// Removes tremble and noise from a stroke. Positions and velocities of every joined piece pass a low-pass
/// filter without phase shift. Its gain is 1 / (1 + (f / cut_off)^4), like that of a Butterworth filter of
/// second order that runs forward and backward. So a sine at the cut-off [Hz] is halved. Times may be
/// irregular: a piece minimises sum w |x - sample|^2 + lambda sum w |x''|^2, w being the time that a sample
/// stands for (Whittaker; solved as by Reinsch, Numer. Math. 10, 1967). A straight uniform motion stays to
/// rounding, both ends of a piece stay where they are. Pieces of two samples, and those that are sampled at
/// less than twice the cut-off, stay as they are. Error: input, if the cut-off is so low compared with the
/// rate (0.16 Hz at 1 kHz) that rounding would show.
Stroke smoothed(const Stroke& stroke, double cut_off);

/// Whether smoothed() changes any piece: it leaves those that are sampled too rarely, or have two samples.
bool is_smoothed(const Stroke& stroke, double cut_off);

}  // namespace sandstroke
