#pragma once

#include "haptics/haptic_device.h"
#include "haptics/stroke_sampler.h"

namespace sandstroke {

/// A device whose hand moves along a stroke, scripted or recorded, in real time, and feels nothing: for
/// people without one.
class StrokeDevice : public HapticDevice {
 public:
  /// name: of its specification's model.
  StrokeDevice(Stroke stroke, std::string name);
};

}  // namespace sandstroke
