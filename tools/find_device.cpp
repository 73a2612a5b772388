#include "find_device.h"

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
      "--device chai3d: this program was built without CHAI3D; {}, or play a stroke: scripted:FILE.toml or "
      "replay:FILE.h5",
      how_to_build_with_chai3d);
}
#endif

[[noreturn]] void throw_no_such_device(const std::string& name) {
  std::string there_is = "scripted:FILE.toml and replay:FILE.h5, which play a stroke";
  for (const ConnectedDevice& device : connected_devices())
    there_is += fmt::format(", {} ({})", device.name, device.specification.model);
  throw_input_error("--device {}: there is no such device; there is {}{}", name, there_is,
                    knows_chai3d ? "" : ", and chai3d where this program is built with it");
}

std::unique_ptr<HapticDevice> find_chai3d_device(const std::string& name, const std::string& number) {
  int index = 0;
  const auto [end, failure] = std::from_chars(number.data(), number.data() + number.size(), index);
  if (failure != std::errc() || end != number.data() + number.size() || index < 0) throw_no_such_device(name);
  return make_chai3d_device(index);
}

}  // namespace

std::unique_ptr<HapticDevice> find_device(const std::string& name, const ForceSettings& force) {
  const std::size_t colon = name.find(':');
  const std::string kind = name.substr(0, colon);
  const std::string which = colon == std::string::npos ? "" : name.substr(colon + 1);
  if (name == "chai3d") return find_chai3d_device(name, "0");
  if (kind == "chai3d") return find_chai3d_device(name, which);
  if ((kind == "scripted" || kind == "replay") && !which.empty())
    return std::make_unique<StrokeDevice>(load_stroke(which, force), name);
  throw_no_such_device(name);
}

std::vector<ConnectedDevice> connected_devices() {
  std::vector<ConnectedDevice> devices;
  for (DeviceSpecification& specification : list_chai3d_devices())
    devices.push_back({fmt::format("chai3d:{}", devices.size()), std::move(specification)});
  return devices;
}

}  // namespace sandstroke
