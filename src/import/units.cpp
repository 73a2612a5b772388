#include "import/units.h"

#include <charconv>
#include <cmath>
#include <map>
#include <vector>

#include "core/error.h"

namespace sandstroke {
namespace {

using Units = std::map<std::string, Unit>;

const Units& units_of(Quantity quantity) {
  static const Units length{{"m", {1, 1}},         {"cm", {1, 100}},   {"mm", {1, 1e3}}, {"um", {1, 1e6}},
                            {"\u00b5m", {1, 1e6}}, {"in", {254, 1e4}}, {"px", {}}};
  static const Units time{{"s", {1, 1}},    {"sec", {1, 1}},       {"ms", {1, 1e3}}, {"msec", {1, 1e3}},
                          {"us", {1, 1e6}}, {"\u00b5s", {1, 1e6}}, {"ns", {1, 1e9}}};
  static const Units speed{
      {"m/s", {1, 1}}, {"cm/s", {1, 100}}, {"mm/s", {1, 1e3}}, {"mps", {1, 1}}, {"mmps", {1, 1e3}}};
  static const Units force{{"N", {1, 1}}, {"mN", {1, 1e3}}, {"kN", {1e3, 1}}};
  switch (quantity) {
    case Quantity::length:
      return length;
    case Quantity::time:
      return time;
    case Quantity::speed:
      return speed;
    default:
      return force;
  }
}

constexpr const char* quantity_names[] = {"length", "time", "speed", "force"};

}  // namespace

std::optional<Unit> known_unit(Quantity quantity, const std::string& name) {
  const Units& units = units_of(quantity);
  const auto found = units.find(name);
  return found == units.end() ? std::nullopt : std::optional(found->second);
}

Unit unit_of(Quantity quantity, const std::string& name, double pixel_size) {
  if (quantity == Quantity::length && name == "px") {
    if (!(pixel_size > 0.0))
      throw_input_error(
          "unit px needs the size of a pixel in m; give stroke.table.pixel_size (stroke convert: "
          "--pixel-size)");
    return {pixel_size, 1.0};
  }
  if (const auto unit = known_unit(quantity, name)) return *unit;
  double metres = 0.0;
  const auto [end, failure] = std::from_chars(name.data(), name.data() + name.size(), metres);
  if (quantity == Quantity::length && failure == std::errc() && end == name.data() + name.size() &&
      metres > 0.0 && std::isfinite(metres))
    return {metres, 1.0};
  std::vector<std::string> names;
  for (const auto& [known, ratio] : units_of(quantity)) names.push_back(known);
  throw_input_error("'{}' is not a unit of {}; take one of: {}{}", name,
                    quantity_names[static_cast<int>(quantity)], fmt::join(names, ", "),
                    quantity == Quantity::length ? ", or a number of metres" : "");
}

}  // namespace sandstroke
