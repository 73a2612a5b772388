#pragma once

#include <string>
#include <string_view>

#include "core/output_file.h"

namespace sandstroke {

/// A stepped simulation as it is kept: all that it takes to go on with the same bits.
struct KeptSimulation {
  std::string scene;   ///< TOML
  std::string folder;  ///< of the files that the scene names
  std::string state;   ///< SteppedSimulation::state()
};

inline constexpr OutputKind state_output{"a simulation's state", "sandstroke state 1\n"};

std::string kept_bytes(const KeptSimulation& kept);
/// name: of the file, for messages. Error: input, if these are no state, or one of another version.
KeptSimulation kept_simulation(std::string_view bytes, const std::string& name);

/// Error: input, naming the first line that differs, if the states of two scenes (TOML) do not fit each
/// other.
void check_same_scene(const std::string& here, const std::string& kept);

}  // namespace sandstroke
