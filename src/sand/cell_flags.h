#pragma once

#include <array>
#include <cstdint>

#include "sand/bed_geometry.h"

namespace sandstroke {

/// A flag per cell of a tile: bit c of word r is cell (r, c).
using CellFlags = std::array<std::uint64_t, BedGeometry::tile_side>;

/// Which columns have a flag.
inline std::uint64_t columns_of(const CellFlags& flags) {
  std::uint64_t all = 0;
  for (const std::uint64_t row : flags) all |= row;
  return all;
}

inline bool any(const CellFlags& flags) { return columns_of(flags) != 0; }

/// Not with std::popcount, which is a call per word where the compiler may not assume the instruction.
inline int count(const CellFlags& flags) {
  constexpr std::uint64_t twos = 0x3333333333333333u, fours = 0x0f0f0f0f0f0f0f0fu,
                          bytes = 0x00ff00ff00ff00ffu;
  std::uint64_t sums = 0;  // four of 16 bits each
  for (std::uint64_t row : flags) {
    row -= row >> 1 & 0x5555555555555555u;
    row = (row & twos) + (row >> 2 & twos);
    row = (row + (row >> 4)) & fours;
    sums += (row & bytes) + (row >> 8 & bytes);
  }
  return static_cast<int>((sums * 0x0001000100010001u) >> 48);
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

/// Cells are computed in groups of so many neighbours in a row, whatever the width of the machine's vectors.
inline constexpr int cells_per_group = 8;

/// Bit g: one of the flags 8 g ... 8 g + 7 is set.
inline unsigned groups_of(std::uint64_t row) {
  row |= row >> 4;
  row |= row >> 2;
  row |= row >> 1;
  return static_cast<unsigned>(((row & 0x0101010101010101u) * 0x0102040810204080u) >> 56);
}

}  // namespace sandstroke
