#pragma once

#include "haptics/stroke.h"
#include "sim/scene.h"

namespace sandstroke {

/// A curved stroke over a bed of 0.24 m, `depth` [m] deep at `speed` [m/s]: 0.29 m long; with `cut` half of
/// it.
Stroke s_curve(double depth, double speed, bool cut = false);

/// A scribble of the same speed over a patch of 60 x 40 mm: to and fro along x, its lines 5 mm apart, then
/// along y over the same ground; with `cut` half as large.
Stroke scribble(double depth, double speed, bool cut = false);

/// The same stroke as a device records it: sampled at 1 kHz, with white noise of `rms` [m] in z. The same
/// each time.
Stroke with_noise(const Stroke& stroke, double rms);

/// The same stroke whose tip, where it is in sand, goes up and down by 0.5 mm at this slope along its way.
Stroke with_slopes(const Stroke& stroke, double slope);

/// A preset's scene for them, with the paper's tool and five cells per tool radius.
Scene hand_scene(ModelPreset preset);

}  // namespace sandstroke
