#pragma once

#include <optional>
#include <string>

namespace sandstroke {

/// A unit as an exact ratio to the SI unit. value * factor / divisor rounds only once for whole numbers (66
/// ms is the double nearest to 0.066 s); value * 0.001 does not.
struct Unit {
  double factor = 1.0, divisor = 1.0;
  double to_si(double value) const { return value * factor / divisor; }
};

enum class Quantity { length, time, speed, force };

/// The unit with this name ("mm"; "[mm]" is none). None: the quantity has no such unit.
std::optional<Unit> known_unit(Quantity quantity, const std::string& name);

/// The unit with this name. A length may also be any number of metres ("1e-5"). pixel_size [m]: the meaning
/// of "px"; 0: not given. Error: input, listing the units there are.
Unit unit_of(Quantity quantity, const std::string& name, double pixel_size = 0.0);

}  // namespace sandstroke
