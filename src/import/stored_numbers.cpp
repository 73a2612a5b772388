#include "import/stored_numbers.h"

#include <bit>
#include <cmath>
#include <limits>

namespace sandstroke {
namespace {

/// IEEE 754 of 2 bytes.
double half(std::uint64_t bits) {
  const int exponent = static_cast<int>(bits >> 10 & 31);
  const double fraction = static_cast<double>(bits & 1023);
  double value = exponent == 0    ? std::ldexp(fraction, -24)
                 : exponent != 31 ? std::ldexp(1024.0 + fraction, exponent - 25)
                 : fraction != 0  ? std::numeric_limits<double>::quiet_NaN()
                                  : std::numeric_limits<double>::infinity();
  return bits >> 15 & 1 ? -value : value;
}

}  // namespace

std::uint64_t StoredNumbers::bits(std::size_t sample, std::size_t column) const {
  const auto* const first =
      reinterpret_cast<const unsigned char*>(bytes.data()) + sample * sample_step + column * column_step;
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < type.bytes; ++i)
    value |= std::uint64_t{first[i]} << 8 * (type.big_endian ? type.bytes - 1 - i : i);
  const bool negative = type.kind == StoredType::Kind::whole && value >> (8 * type.bytes - 1) & 1;
  return negative && type.bytes < 8 ? value | ~std::uint64_t{0} << 8 * type.bytes : value;
}

double StoredNumbers::real(std::size_t sample, std::size_t column) const {
  const std::uint64_t value = bits(sample, column);
  switch (type.kind) {
    case StoredType::Kind::whole:
      return static_cast<double>(static_cast<std::int64_t>(value));
    case StoredType::Kind::natural:
      return static_cast<double>(value);
    default:
      if (type.bytes == 2) return half(value);
      return type.bytes == 4 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(value)))
                             : std::bit_cast<double>(value);
  }
}

}  // namespace sandstroke
