#pragma once

#include <string>

#include "core/output_file.h"

namespace sandstroke {

/// A stepped simulation as it is kept: all that it takes to go on with the same bits.
struct KeptSimulation {
  std::string scene;   ///< TOML
  std::string folder;  ///< of the files that the scene names
  std::string state;   ///< SteppedSimulation::state()

  template <class State>
  void visit_state(State& visitor) {
    visitor.value("scene", scene);
    visitor.value("folder", folder);
    visitor.value("state", state);
  }
};

inline constexpr OutputKind simulation_state{"a simulation's state, as Simulation.save() or state() makes it",
                                             "sandstroke state 1\n"};

}  // namespace sandstroke
