#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sandstroke {

/// How a file stores a number: IEEE 754 of 2, 4 or 8 bytes; or a whole number of 1, 2, 4 or 8 bytes, negative
/// ones in two's complement.
struct StoredType {
  enum class Kind { real, whole, natural };  ///< natural: a whole number without a sign
  Kind kind = Kind::real;
  std::size_t bytes = 8;
  bool big_endian = false;
};

/// Numbers in the bytes of a file, sample by sample. Column k of sample i begins at byte
/// i * sample_step + k * column_step; all of them are within `bytes`.
struct StoredNumbers {
  StoredType type;
  std::string_view bytes;
  std::size_t samples = 0, width = 1;
  std::size_t sample_step = 0, column_step = 0;

  double real(std::size_t sample, std::size_t column) const;
  /// A number that is not real; its bits as a number without a sign.
  std::uint64_t bits(std::size_t sample, std::size_t column) const;
};

}  // namespace sandstroke
