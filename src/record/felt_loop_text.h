#pragma once

#include <string>

#include "record/felt_loop.h"

namespace sandstroke {

// Texts about a FeltLoop, for people.

/// "506 N/m, 33 N s/m"
std::string felt_sand_text(const FeltSand& sand);
/// The same for what a device names; "unknown" where it names nothing.
std::string named_text(const FeltSand& named);
/// The assumptions of theory about loop, device and hand.
std::string assumed_text(const DeviceSettings& device);
/// Whether the device can hold the sand, and if not, which settings of the scene would do.
std::string verdict_text(const FeltLoop& loop, const Scene& scene);

/// Error: input, where the assumed hand does not settle on the device; it names settings that would do. Warns
/// where the sand is beyond what the device names. name: the scene's.
void check_felt_loop(const FeltLoop& loop, const Scene& scene, const std::string& name);

}  // namespace sandstroke
