#pragma once

#include <string>

#include "record/felt_loop.h"

namespace sandstroke {

// What a FeltLoop says to people.

/// "506 N/m, 33 N s/m"
std::string felt_sand_text(const FeltSand& sand);
/// The same of what a device names; "unknown" where it does not.
std::string named_text(const FeltSand& named);
/// What theory takes for true of loop, device and hand.
std::string assumed_text(const DeviceSettings& device);
/// Whether the device can hold the sand, and if not, which settings of its scene would do.
std::string verdict_text(const FeltLoop& loop, const Scene& scene);

/// Error: input, with such settings, where no hand as assumed settles on the device. Warns beyond what it
/// names. name: the scene's.
void check_felt_loop(const FeltLoop& loop, const Scene& scene, const std::string& name);

}  // namespace sandstroke
