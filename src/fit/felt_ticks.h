#pragma once

#include <optional>

#include "fit/contact_law.h"
#include "fit/paper_law.h"
#include "sim/simulation.h"

namespace sandstroke {

/// What a fit is given: a scene that the device follows (device.model = "kinematic"), so that sand, depths
/// and velocities do not hang on the constants; its bed, and its stroke, with forces, placed on it. A run of
/// it shows a bar and stops where it is interrupted.
struct FeltStroke {
  Scene scene;
  HeightField bed;
  Stroke stroke;

  /// The ticks in which the tool touches sand, at the time of a recorded force. Error: input, unstable.
  std::vector<FeltTick> paper_ticks() const;
  /// The same of a law of the contact, felt in each of the grid's sands.
  ContactLaw contact_law(SandGrid grid) const;
};

}  // namespace sandstroke
