#include "cli/find_device.h"

#include <charconv>

#include "core/error.h"
#include "io/stroke_file.h"
#include "record/stroke_device.h"
#ifdef SANDSTROKE_CHAI3D
#include "chai3d/chai3d_device.h"
#endif

namespace sandstroke {
namespace {

#ifndef SANDSTROKE_CHAI3D
std::vector<DeviceSpecification> list_chai3d_devices() { return {}; }
std::unique_ptr<HapticDevice> make_chai3d_device(int) {
  throw_input_error(
      "--device chai3d: this program was built without CHAI3D; {}, or use a stand-in: scripted:FILE.toml or "
      "replay:FILE.h5",
      how_to_build_with_chai3d);
}
#endif

[[noreturn]] void throw_no_such_device(const std::string& name) {
  std::string known = "pointer, scripted:FILE.toml, replay:FILE.h5";
  for (const ConnectedDevice& device : connected_devices())
    known += fmt::format(", {} ({})", device.name, device.specification.model);
  throw_input_error("--device {}: unknown device; take one of: {}{}", name, known,
                    knows_chai3d ? "" : " (chai3d needs a build with CHAI3D)");
}

/// N of "chai3d:N".
int device_number(const std::string& name) {
  const char *begin = name.data() + name.find(':') + 1, *end = name.data() + name.size();
  int number = 0;
  const auto [stopped, failure] = std::from_chars(begin, end, number);
  if (failure != std::errc() || stopped != end || number < 0) throw_no_such_device(name);
  return number;
}

}  // namespace

std::filesystem::path file_played(const std::string& name) {
  for (const std::string kind : {"scripted:", "replay:"})
    if (name.starts_with(kind)) return name.substr(kind.size());
  return {};
}

std::unique_ptr<HapticDevice> find_device(const std::string& name, const ForceSettings& force) {
  if (name == "chai3d") return make_chai3d_device(0);
  if (name.starts_with("chai3d:")) return make_chai3d_device(device_number(name));
  const std::filesystem::path file = file_played(name);
  if (name == "scripted:" || name == "replay:")
    throw_input_error("--device {}: the stroke is missing; write scripted:FILE.toml or replay:FILE.h5", name);
  if (file.empty()) throw_no_such_device(name);
  Stroke stroke = load_stroke(file, force);
  if (stroke.follows_sand)
    throw_input_error(
        "--device {}: its heights are relative to the sand (as in scripts with a force), and a device does "
        "not know the sand; use depths, or play the stroke: sandstroke run SCENE --stroke {}",
        name, file.string());
  return std::make_unique<StrokeDevice>(std::move(stroke), name);
}

std::vector<ConnectedDevice> connected_devices() {
  std::vector<ConnectedDevice> devices;
  for (DeviceSpecification& specification : list_chai3d_devices())
    devices.push_back({fmt::format("chai3d:{}", devices.size()), std::move(specification)});
  return devices;
}

}  // namespace sandstroke
