#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "haptics/force_model.h"
#include "haptics/haptic_device.h"

namespace sandstroke {

/// The device of a name: "chai3d" (the first) or "chai3d:N" (the N-th, from 0), "scripted:FILE.toml" or
/// "replay:FILE.h5" (a stand-in that plays this stroke; `force` says how deep a scripted force presses). It
/// is not open yet. Error: input, listing what there is; io where a file cannot be read.
std::unique_ptr<HapticDevice> find_device(const std::string& name, const ForceSettings& force);

/// The device that a page of `record --view` is; it is made with the view, not by find_device().
inline constexpr const char* pointer_name = "pointer";

/// The file that the device of a name plays; empty: none.
std::filesystem::path file_played(const std::string& name);

/// A device that is connected, and how to name it.
struct ConnectedDevice {
  std::string name;
  DeviceSpecification specification;
};
std::vector<ConnectedDevice> connected_devices();

/// Whether this program can talk to real devices; where not, how to get one that can.
#ifdef SANDSTROKE_CHAI3D
inline constexpr bool knows_chai3d = true;
#else
inline constexpr bool knows_chai3d = false;
#endif
inline constexpr const char* how_to_build_with_chai3d =
    "build it with cmake -DSANDSTROKE_CHAI3D=ON -Dchai3d_DIR=CHAI3D's build folder "
    "(src/record/README.md says how)";

}  // namespace sandstroke
