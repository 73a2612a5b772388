#pragma once

#include <set>
#include <vector>

#include "sand/height_field.h"

namespace sandstroke {

/// A bed's mean heights [m] in the cells of another grid over the same rectangle, of any size.
class CellMeans {
 public:
  CellMeans(const HeightField& bed, int rows, int cols);
  double operator()(Eigen::Index row, Eigen::Index col) const;

 private:
  /// Which cells of the bed, along an axis, one of the grid covers, and what share of it each does.
  struct Cover {
    int begin = 0;
    std::vector<double> share;
  };
  static std::vector<Cover> covers(int here, int there);

  const HeightField& bed_;
  std::vector<Cover> rows_, cols_;
};

/// Tiles of a bed in which it, or another one over the same rectangle, is no longer as its rule says.
std::set<int> touched_tiles(const HeightField& other, const HeightField& bed);

/// Sets the cells of those tiles to the means of the other one over them, times a factor.
void take_means(const HeightField& other, HeightField& bed, double times = 1.0);

/// The means of factor x factor cells, where that divides rows and cols; with 1 the bed itself. Where a level
/// bed has no tile, this one has none either.
HeightField coarsened(HeightField fine, int factor);

}  // namespace sandstroke
