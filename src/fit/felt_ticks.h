#pragma once

#include <optional>

#include "fit/contact_law.h"
#include "fit/paper_law.h"
#include "sim/simulation.h"

namespace sandstroke {

/// The input of a fit. In the scene the device follows the stroke (device.model = "kinematic"), so that sand,
/// depths and velocities do not depend on the constants. The stroke has forces and is placed on the bed. A
/// run of it shows a bar and stops if it is interrupted.
struct FeltStroke {
  Scene scene;
  HeightField bed;
  Stroke stroke;

  /// The ticks in which the tool touches sand and a force was recorded. Error: input, unstable.
  std::vector<FeltTick> paper_ticks() const;
  /// The same for a law of the contact, with the force in each of the grid's sands.
  ContactLaw contact_law(SandGrid grid) const;
};

}  // namespace sandstroke
