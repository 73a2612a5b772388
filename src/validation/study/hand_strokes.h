#pragma once

#include "haptics/stroke.h"
#include "sim/scene.h"

namespace sandstroke {

/// A curved stroke of 0.29 m over a bed of 0.24 m, `depth` [m] deep at `speed` [m/s]. With `cut` half of it.
Stroke s_curve(double depth, double speed, bool cut = false);

/// A scribble over a patch of 60 x 40 mm. It goes to and fro along x, with lines 5 mm apart, then along y
/// over the same ground. With `cut` the patch is half as large.
Stroke scribble(double depth, double speed, bool cut = false);

/// The stroke as a device records it: sampled at 1 kHz, with white noise of `rms` [m] in z. Each call gives
/// the same noise.
Stroke with_noise(const Stroke& stroke, double rms);

/// The stroke with an uneven depth: in sand, the tip goes up and down by 0.5 mm at this slope along its way.
Stroke with_slopes(const Stroke& stroke, double slope);

/// A preset's scene for these strokes, with the paper's tool and five cells per tool radius.
Scene hand_scene(ModelPreset preset);

}  // namespace sandstroke
