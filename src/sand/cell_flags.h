#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/cells_per_group.h"
#include "sand/bed_geometry.h"

namespace sandstroke {

/// A flag per cell of a tile: bit c of word r is cell (r, c).
using CellFlags = std::array<std::uint64_t, BedGeometry::tile_side>;

/// The columns [begin, end) as flags.
inline std::uint64_t columns_between(int begin, int end) {
  if (begin >= end) return 0;
  const std::uint64_t all = ~std::uint64_t{0};
  return all >> (BedGeometry::tile_side - end) & all << begin;
}

/// Rows of a tile, half-open.
struct RowSpan {
  int begin = 0, end = 0;
  bool empty() const { return begin >= end; }
};
/// The least span that holds both.
inline RowSpan joined(RowSpan a, RowSpan b) {
  if (a.empty()) return b;
  return b.empty() ? a : RowSpan{std::min(a.begin, b.begin), std::max(a.end, b.end)};
}
inline constexpr RowSpan all_rows{0, BedGeometry::tile_side};

/// The rows from the first to the last with a flag; empty where there is none. `within` holds all of them.
inline RowSpan row_span(const CellFlags& flags, RowSpan within = all_rows) {
  RowSpan span = within;
  while (span.begin < span.end && !flags[span.end - 1]) --span.end;
  while (span.begin < span.end && !flags[span.begin]) ++span.begin;
  return span;
}

/// The columns that have a flag in any of these rows.
inline std::uint64_t columns_of(const CellFlags& flags, RowSpan rows = all_rows) {
  std::uint64_t all = 0;
  for (int row = rows.begin; row < rows.end; ++row) all |= flags[row];
  return all;
}

/// The number of flags. std::popcount would be a call per word where the compiler may not assume the
/// instruction.
inline int count(const CellFlags& flags, RowSpan rows = all_rows) {
  constexpr std::uint64_t twos = 0x3333333333333333u, fours = 0x0f0f0f0f0f0f0f0fu,
                          bytes = 0x00ff00ff00ff00ffu;
  std::uint64_t sums = 0;  // four of 16 bits each
  for (int i = rows.begin; i < rows.end; ++i) {
    std::uint64_t row = flags[i];
    row -= row >> 1 & 0x5555555555555555u;
    row = (row & twos) + (row >> 2 & twos);
    row = (row + (row >> 4)) & fours;
    sums += (row & bytes) + (row >> 8 & bytes);
  }
  return static_cast<int>((sums * 0x0001000100010001u) >> 48);
}

/// Bit g of the result: one of the flags 8 g ... 8 g + 7 is set.
inline unsigned groups_of(std::uint64_t row) {
  row |= row >> 4;
  row |= row >> 2;
  row |= row >> 1;
  return static_cast<unsigned>(((row & 0x0101010101010101u) * 0x0102040810204080u) >> 56);
}

}  // namespace sandstroke
