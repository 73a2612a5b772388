#pragma once

#include <set>
#include <vector>

#include "sand/height_field.h"

namespace sandstroke {

/// The cells of one grid, along an axis, that one cell of another grid covers, and the fraction of it that
/// each fills.
struct CellCover {
  int begin = 0;
  std::vector<double> fraction;
};
/// The cover of each of `here` cells by `there` cells of the same length in all.
std::vector<CellCover> cell_covers(int here, int there);

/// A bed's mean heights [m] in the cells of another grid over the same rectangle, of any size.
class CellMeans {
 public:
  CellMeans(const HeightField& bed, int rows, int cols);
  double operator()(Eigen::Index row, Eigen::Index col) const;

 private:
  const HeightField& bed_;
  std::vector<CellCover> rows_, cols_;
};

/// The tiles of `bed` that are allocated, or that overlap an allocated tile of another bed over the same
/// rectangle.
std::set<int> touched_tiles(const HeightField& other, const HeightField& bed);

/// Sets the cells of those tiles to the other bed's means over them, times a factor.
void take_means(const HeightField& other, HeightField& bed, double times = 1.0);

/// A bed whose cells are means of factor x factor cells of `fine`. The factor must divide rows and cols; with
/// 1 it is the bed itself. Where a level bed has no tile, the result has none either.
HeightField coarsened(HeightField fine, int factor);

}  // namespace sandstroke
