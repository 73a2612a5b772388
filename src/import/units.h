#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sandstroke {

/// A unit as an exact ratio to the SI unit. value * factor / divisor rounds only once for whole numbers (66
/// ms is the double nearest to 0.066 s); value * 0.001 does not.
struct Unit {
  double factor = 1.0, divisor = 1.0;
  double to_si(double value) const { return value * factor / divisor; }
};

enum class Quantity { length, time, speed, force };

/// The unit with this name: a symbol ("mm") or a word ("Millimetres"), in large or small letters. Only mN has
/// to be written exactly, because MN is a million of newtons. A speed is any "length/time". None: the
/// quantity has no such unit ("[mm]" is none).
std::optional<Unit> known_unit(Quantity quantity, std::string_view name);

/// The symbol of a unit: "mm" of "Millimetres". Other texts stay as they are.
std::string unit_symbol(std::string_view name);

/// True if it is a unit of some quantity.
bool is_unit(std::string_view name);

/// True for px and its other names, whose length somebody has to give.
bool is_pixel(std::string_view name);

/// The unit with this name. A length may also be any number of metres ("1e-5"), a force any number of
/// newtons. pixel_size [m]: the meaning of "px"; 0: not given. Error: input, listing the units there are.
Unit unit_of(Quantity quantity, const std::string& name, double pixel_size = 0.0);

/// The symbols of a quantity, for people: "s, ms, us, ns, min, h, day".
std::string unit_symbols(Quantity quantity);

}  // namespace sandstroke
