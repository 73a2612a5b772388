#include "sand/cell_means.h"

#include <algorithm>
#include <cstdint>

namespace sandstroke {

std::vector<CellCover> cell_covers(int here, int there) {
  // In units of 1 / (here * there) of the length all borders are whole numbers: no volume is lost by
  // rounding.
  std::vector<CellCover> all(static_cast<std::size_t>(here));
  for (std::int64_t i = 0; i < here; ++i) {
    const std::int64_t from = i * there, to = from + there, first = from / here;
    CellCover& cover = all[static_cast<std::size_t>(i)];
    cover.begin = static_cast<int>(first);
    for (std::int64_t k = first; k * here < to; ++k)
      cover.fraction.push_back(static_cast<double>(std::min(to, (k + 1) * here) - std::max(from, k * here)) /
                               there);
  }
  return all;
}

CellMeans::CellMeans(const HeightField& bed, int rows, int cols)
    : bed_(bed), rows_(cell_covers(rows, bed.rows())), cols_(cell_covers(cols, bed.cols())) {}

double CellMeans::operator()(Eigen::Index row, Eigen::Index col) const {
  const CellCover &rows = rows_[row], &cols = cols_[col];
  double sum = 0.0;
  for (std::size_t i = 0; i < rows.fraction.size(); ++i)
    for (std::size_t j = 0; j < cols.fraction.size(); ++j)
      sum += rows.fraction[i] * cols.fraction[j] *
             bed_(rows.begin + static_cast<int>(i), cols.begin + static_cast<int>(j));
  return sum;
}

std::set<int> touched_tiles(const HeightField& other, const HeightField& bed) {
  std::set<int> tiles;
  for (int slot = 0; slot < bed.allocated_tiles(); ++slot) tiles.insert(bed.tile_of(slot));
  // The last cell of `bed` that begins before row or column `at` of the other bed, and the first that ends
  // after it.
  const auto last_before = [](std::int64_t at, int there, int here) {
    return (at * here + there - 1) / there - 1;
  };
  const auto first_after = [](std::int64_t at, int there, int here) { return at * here / there; };
  constexpr int side = BedGeometry::tile_side;
  for (int slot = 0; slot < other.allocated_tiles(); ++slot) {
    const CellRange cells = other.tile_cells(other.tile_of(slot));
    for (std::int64_t i = first_after(cells.row_begin, other.rows(), bed.rows()) / side;
         i <= last_before(cells.row_end, other.rows(), bed.rows()) / side; ++i)
      for (std::int64_t j = first_after(cells.col_begin, other.cols(), bed.cols()) / side;
           j <= last_before(cells.col_end, other.cols(), bed.cols()) / side; ++j)
        tiles.insert(bed.tile_index(static_cast<int>(i), static_cast<int>(j)));
  }
  return tiles;
}

void take_means(const HeightField& other, HeightField& bed, double times) {
  const CellMeans means(other, bed.rows(), bed.cols());
  for (const int tile : touched_tiles(other, bed)) {
    const CellRange cells = bed.tile_cells(tile);
    for (int row = cells.row_begin; row < cells.row_end; ++row)
      for (int col = cells.col_begin; col < cells.col_end; ++col) bed.set(row, col, times * means(row, col));
  }
}

HeightField coarsened(HeightField fine, int factor) {
  if (factor == 1) return fine;
  const int rows = fine.rows() / factor, cols = fine.cols() / factor;
  const double cell_size = factor * fine.cell_size();
  const std::optional<double> level = fine.untouched().level(fine, fine.cells());
  if (!level) return {HeightGrid::NullaryExpr(rows, cols, CellMeans(fine, rows, cols)), cell_size};
  HeightField coarse(rows, cols, cell_size, std::make_shared<LevelRule>(*level));
  take_means(fine, coarse);
  return coarse;
}

}  // namespace sandstroke
