#include <spdlog/fmt/fmt.h>

#include <limits>

#include "cli/find_device.h"
#include "cli/record_parts.h"
#include "cli/standard_output.h"
#include "io/table.h"

namespace sandstroke {
namespace {

struct StandIn {
  const char *name, *help;
};
constexpr StandIn stand_ins[] = {
    {"pointer",
     "mouse, pen or finger in a page that shows the sand of --feel, and the force that a device would give"},
    {"scripted:FILE.toml", "plays a scripted stroke in real time; forces do not move it"},
    {"replay:FILE.h5", "plays a recorded stroke in real time; forces do not move it"},
};

/// A device's number. A zero means that the device does not know it.
double known(double value) { return value > 0.0 ? value : std::numeric_limits<double>::quiet_NaN(); }

Table device_table(const std::vector<ConnectedDevice>& devices) {
  std::vector<std::string> names, models, manufacturers;
  std::vector<double> forces, stiffnesses, dampings, radii, switches;
  for (const auto& [name, device] : devices) {
    names.push_back(name);
    models.push_back(device.model);
    manufacturers.push_back(device.manufacturer);
    forces.push_back(device.max_force);
    stiffnesses.push_back(known(device.max_stiffness));
    dampings.push_back(known(device.max_damping));
    radii.push_back(known(device.workspace_radius));
    switches.push_back(known(device.switches));
  }
  return {{{"name", "device", "", names},
           {"model", "model", "", models},
           {"manufacturer", "manufacturer", "", manufacturers},
           {"max_force", "force", "N", forces},
           {"max_stiffness", "stiffness", "N/m", stiffnesses},
           {"max_damping", "damping", "N s/m", dampings},
           {"workspace_radius", "workspace radius", "m", radii},
           {"switches", "switches", "", switches}}};
}

void print_json_list(const Table& devices) {
  nlohmann::ordered_json object = {{"chai3d", knows_chai3d},
                                   {"devices", nlohmann::ordered_json::array()},
                                   {"stand_ins", nlohmann::ordered_json::array()}};
  for (std::size_t row = 0; row < devices.rows(); ++row) object["devices"].push_back(row_json(devices, row));
  for (const auto& [name, help] : stand_ins) object["stand_ins"].push_back({{"name", name}, {"help", help}});
  print_json(object);
}

}  // namespace

int list_devices(bool json) {
  const Table devices = device_table(connected_devices());
  if (json) {
    print_json_list(devices);
    return 0;
  }
  if (!knows_chai3d) {
    print_text("no devices: this program was built without CHAI3D; {}\n", how_to_build_with_chai3d);
  } else if (devices.rows() == 0) {
    print_text(
        "no devices: CHAI3D finds none; check the cable, the power, the driver and your permissions\n");
  } else {
    print_text("{}", aligned_text(devices));
  }
  print_text("\nstand-ins for a device:\n");
  for (const auto& [name, help] : stand_ins) print_text("{:<20}{}\n", name, help);
  return 0;
}

}  // namespace sandstroke
