#pragma once

#include <bit>
#include <cstdint>

#include "sand/height_field.h"

namespace sandstroke {

inline bool any(const CellFlags& flags) {
  std::uint64_t all = 0;
  for (const std::uint64_t row : flags) all |= row;
  return all != 0;
}

inline int count(const CellFlags& flags) {
  int count = 0;
  for (const std::uint64_t row : flags) count += std::popcount(row);
  return count;
}

/// Rows of a tile from the first to the last with a flag, half-open; empty where there is none.
struct RowSpan {
  int begin = 0, end = 0;
};
inline RowSpan row_span(const CellFlags& flags) {
  RowSpan span{0, BedGeometry::tile_side};
  while (span.end > 0 && !flags[span.end - 1]) --span.end;
  while (span.begin < span.end && !flags[span.begin]) ++span.begin;
  return span;
}

/// Cells are computed in groups of 8 neighbours in a row, whatever the width of the machine's vectors. Bit g
/// of the result: one of the flags 8 g ... 8 g + 7 is set.
inline unsigned groups_of(std::uint64_t row) {
  row |= row >> 4;
  row |= row >> 2;
  row |= row >> 1;
  return static_cast<unsigned>(((row & 0x0101010101010101u) * 0x0102040810204080u) >> 56);
}

}  // namespace sandstroke
