#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "haptics/haptic_device.h"
#include "rules/force.h"

namespace sandstroke {

/// Makes the device of a name and does not open it: "chai3d" (the first) or "chai3d:N" (the N-th, from 0),
/// "scripted:FILE.toml" or "replay:FILE.h5" (a stand-in that plays this stroke; `force` says how deep a
/// scripted force presses). Error: input, listing the devices; io, if a file cannot be read.
std::unique_ptr<HapticDevice> find_device(const std::string& name, const ForceSettings& force);

/// The name of the device that is a page of `record --view`. The view makes it, not find_device().
inline constexpr const char* pointer_name = "pointer";

/// The file that a device plays, from its name. Empty: none.
std::filesystem::path file_played(const std::string& name);

/// A connected device and its name for --device.
struct ConnectedDevice {
  std::string name;
  DeviceSpecification specification;
};
std::vector<ConnectedDevice> connected_devices();

/// True if this program can talk to real devices. The sentence says how to build one that can.
#ifdef SANDSTROKE_CHAI3D
inline constexpr bool knows_chai3d = true;
#else
inline constexpr bool knows_chai3d = false;
#endif
inline constexpr const char* how_to_build_with_chai3d =
    "build it with cmake -DSANDSTROKE_CHAI3D=ON -Dchai3d_DIR=CHAI3D's build folder "
    "(src/record/README.md says how)";

}  // namespace sandstroke
