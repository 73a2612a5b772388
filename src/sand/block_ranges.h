#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "sand/height_field.h"

namespace sandstroke {

/// The range of a tile's heights [m], and of each of its blocks of 8 x 8 cells.
struct BlockRanges {
  static constexpr int block = 8, side = BedGeometry::tile_side / block;
  static constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();
  struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;  // of a block beyond the bed
  };

  Range whole;
  std::vector<Range> blocks;       ///< row by row; empty: the tile is level
  std::uint64_t revision = never;  ///< the bed's tile's, of which they are

  const Range& of(int block_of_tile) const { return blocks.empty() ? whole : blocks[block_of_tile]; }
  /// Looks at a tile (by index), if it is another revision.
  void know(const HeightField& bed, int tile);
};

/// For each cell x the level U [m] with h(y) <= U + mu |x - y| for all cells y: that of the lowest funnel of
/// slope mu over x that no sand reaches into. Bounded from above, by blocks.
class Funnels {
 public:
  /// Of these tiles, by tile rows and columns, and as if there were no others. slope: mu (rise over run).
  Funnels(const HeightField& bed, const std::vector<BlockRanges>& ranges, const CellRange& tiles,
          double slope);

  /// U [m] in a block, counted in rows and columns of blocks from the bed's first.
  double level(int block_row, int block_col) const {
    return levels_[static_cast<std::size_t>(block_row - row_begin_) * cols_ + (block_col - col_begin_)];
  }
  struct Below {
    std::uint64_t blocks = 0;  ///< bit 8 i + j
    double most = 0.0;         ///< m
  };
  /// The blocks of a tile (by index) that have cells more than `least` [m] below their funnel, and the most.
  Below below(const HeightField& bed, int tile, const BlockRanges& ranges, double least) const;

 private:
  int row_begin_, col_begin_, rows_, cols_;
  std::vector<double> levels_;
};

}  // namespace sandstroke
