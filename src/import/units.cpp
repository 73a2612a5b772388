#include "import/units.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/small_letters.h"

namespace sandstroke {
namespace {

/// The names are parted by blanks; the first is the symbol.
struct ListedUnit {
  Quantity quantity;
  std::string_view names;
  Unit unit;
  bool exact_symbol = false;  ///< large letters mean another unit
};

constexpr double standard_gravity = 9.80665;  // m/s^2, standard

constexpr ListedUnit named_units[] = {
    {Quantity::length, "m meter meters metre metres", {1, 1}},
    {Quantity::length, "cm centimeter centimeters centimetre centimetres", {1, 100}},
    {Quantity::length, "mm millimeter millimeters millimetre millimetres", {1, 1e3}},
    {Quantity::length,
     "um \u00b5m \u03bcm micron microns micrometer micrometers micrometre micrometres",
     {1, 1e6}},
    {Quantity::length, "nm nanometer nanometers nanometre nanometres", {1, 1e9}, true},
    {Quantity::length, "dm decimeter decimeters decimetre decimetres", {1, 10}},
    {Quantity::length, "km kilometer kilometers kilometre kilometres", {1e3, 1}},
    {Quantity::length, "in inch inches", {254, 1e4}},
    {Quantity::length, "ft feet", {3048, 1e4}},
    {Quantity::length, "px pixel pixels", {}},
    {Quantity::time, "s sec secs second seconds", {1, 1}},
    {Quantity::time, "ms msec msecs millis millisec millisecs millisecond milliseconds", {1, 1e3}},
    {Quantity::time,
     "us \u00b5s \u03bcs usec usecs micros microsec microsecs microsecond microseconds",
     {1, 1e6}},
    {Quantity::time, "ns nsec nsecs nanos nanosec nanosecs nanosecond nanoseconds", {1, 1e9}},
    {Quantity::time, "min mins minute minutes", {60, 1}},
    {Quantity::time, "h hr hrs hour hours", {3600, 1}},
    {Quantity::time, "day days", {86400, 1}},
    {Quantity::speed, "m/s mps", {1, 1}},
    {Quantity::speed, "cm/s", {1, 100}},
    {Quantity::speed, "mm/s mmps", {1, 1e3}},
    {Quantity::force, "N newton newtons", {1, 1}},
    {Quantity::force, "mN millinewton millinewtons", {1, 1e3}, true},
    {Quantity::force, "kN kilonewton kilonewtons", {1e3, 1}},
    {Quantity::force, "gf gram-force grams-force", {standard_gravity, 1e3}},
    {Quantity::force, "kgf kilogram-force kilograms-force", {standard_gravity, 1}},
    {Quantity::force, "lbf pound-force pounds-force", {4.4482216152605, 1}},
};

constexpr const char* quantity_names[] = {"length", "time", "speed", "force"};

bool same_letters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char one, char other) { return small_letter(one) == small_letter(other); });
}

bool has_name(const ListedUnit& named, std::string_view name) {
  std::string_view rest = named.names;
  while (!rest.empty()) {
    const std::string_view one = rest.substr(0, rest.find(' '));
    const bool exact = named.exact_symbol && rest.size() == named.names.size();
    if (exact ? one == name : same_letters(one, name)) return true;
    rest.remove_prefix(std::min(one.size() + 1, rest.size()));
  }
  return false;
}

std::optional<Unit> listed_unit(Quantity quantity, std::string_view name) {
  for (const ListedUnit& named : named_units)
    if (named.quantity == quantity && has_name(named, name)) return named.unit;
  return std::nullopt;
}

/// The positive number that is the whole text.
std::optional<double> positive_number(const std::string& text) {
  double number = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure != std::errc() || end != text.data() + text.size() || !(number > 0.0) || !std::isfinite(number))
    return std::nullopt;
  return number;
}

}  // namespace

std::optional<Unit> known_unit(Quantity quantity, std::string_view name) {
  if (const auto listed = listed_unit(quantity, name)) return listed;
  const std::size_t slash = name.find('/');
  if (quantity != Quantity::speed || slash == std::string_view::npos) return std::nullopt;
  const auto way = listed_unit(Quantity::length, name.substr(0, slash)),
             time = listed_unit(Quantity::time, name.substr(slash + 1));
  if (!way || !time || is_pixel(name.substr(0, slash))) return std::nullopt;
  return Unit{way->factor * time->divisor, way->divisor * time->factor};
}

std::string unit_symbol(std::string_view name) {
  for (const ListedUnit& named : named_units)
    if (has_name(named, name)) return std::string(named.names.substr(0, named.names.find(' ')));
  return std::string(name);
}

bool is_unit(std::string_view name) {
  using enum Quantity;
  return known_unit(length, name) || known_unit(time, name) || known_unit(speed, name) ||
         known_unit(force, name);
}

bool is_pixel(std::string_view name) {
  return same_letters(name, "px") || same_letters(name, "pixel") || same_letters(name, "pixels");
}

std::string unit_symbols(Quantity quantity) {
  std::vector<std::string_view> symbols;
  for (const ListedUnit& named : named_units)
    if (named.quantity == quantity) symbols.push_back(named.names.substr(0, named.names.find(' ')));
  return fmt::format("{}{}", fmt::join(symbols, ", "),
                     quantity == Quantity::length  ? ", or a number of metres"
                     : quantity == Quantity::force ? ", or a number of newtons"
                                                   : "");
}

Unit unit_of(Quantity quantity, const std::string& name, double pixel_size) {
  if (quantity == Quantity::length && is_pixel(name)) {
    if (!(pixel_size > 0.0))
      throw_input_error(
          "unit px needs the size of a pixel in m; give stroke.table.pixel_size (stroke convert: "
          "--pixel-size)");
    return {pixel_size, 1.0};
  }
  if (const auto unit = known_unit(quantity, name)) return *unit;
  if (quantity == Quantity::length || quantity == Quantity::force)
    if (const auto number = positive_number(name)) return {*number, 1.0};
  throw_input_error("'{}' is not a unit of {}; take one of: {}", name,
                    quantity_names[static_cast<int>(quantity)], unit_symbols(quantity));
}

}  // namespace sandstroke
