#include "sand/cell_means.h"

#include <algorithm>
#include <cstdint>

namespace sandstroke {

std::vector<CellMeans::Cover> CellMeans::covers(int here, int there) {
  std::vector<Cover> all(here);
  const double ratio = static_cast<double>(there) / here;
  for (int i = 0; i < here; ++i) {
    const double from = i * ratio, to = (i + 1) * ratio;
    all[i].begin = std::min(static_cast<int>(from + 1e-9), there - 1);
    for (int k = all[i].begin; k < there && (k == all[i].begin || k < to - 1e-9); ++k)
      all[i].share.push_back((std::min(to, k + 1.0) - std::max<double>(from, k)) / ratio);
  }
  return all;
}

CellMeans::CellMeans(const HeightField& bed, int rows, int cols)
    : bed_(bed), rows_(covers(rows, bed.rows())), cols_(covers(cols, bed.cols())) {}

double CellMeans::operator()(Eigen::Index row, Eigen::Index col) const {
  const Cover &rows = rows_[row], &cols = cols_[col];
  double sum = 0.0;
  for (std::size_t i = 0; i < rows.share.size(); ++i)
    for (std::size_t j = 0; j < cols.share.size(); ++j)
      sum += rows.share[i] * cols.share[j] *
             bed_(rows.begin + static_cast<int>(i), cols.begin + static_cast<int>(j));
  return sum;
}

std::set<int> touched_tiles(const HeightField& fine, const HeightField& coarse) {
  std::set<int> tiles;
  for (int slot = 0; slot < coarse.allocated_tiles(); ++slot) tiles.insert(coarse.tile_of(slot));
  const auto tile_of = [&](int fine_cell, int fine_cells, int cells) {
    return static_cast<int>(static_cast<std::int64_t>(fine_cell) * cells / fine_cells) /
           BedGeometry::tile_side;
  };
  for (int slot = 0; slot < fine.allocated_tiles(); ++slot) {
    const CellRange cells = fine.tile_cells(fine.tile_of(slot));
    for (int i = tile_of(cells.row_begin, fine.rows(), coarse.rows());
         i <= tile_of(cells.row_end - 1, fine.rows(), coarse.rows()); ++i)
      for (int j = tile_of(cells.col_begin, fine.cols(), coarse.cols());
           j <= tile_of(cells.col_end - 1, fine.cols(), coarse.cols()); ++j)
        tiles.insert(coarse.tile_index(i, j));
  }
  return tiles;
}

HeightField coarsened(const HeightField& fine, int factor) {
  const int rows = fine.rows() / factor, cols = fine.cols() / factor;
  const double cell_size = factor * fine.cell_size();
  const CellMeans means(fine, rows, cols);
  const std::optional<double> level = fine.untouched().level(fine, fine.cells());
  if (!level) return {HeightGrid::NullaryExpr(rows, cols, means), cell_size};
  HeightField coarse(rows, cols, cell_size, std::make_shared<LevelRule>(*level));
  for (const int tile : touched_tiles(fine, coarse)) {
    const CellRange cells = coarse.tile_cells(tile);
    for (int row = cells.row_begin; row < cells.row_end; ++row)
      for (int col = cells.col_begin; col < cells.col_end; ++col) coarse.set(row, col, means(row, col));
  }
  return coarse;
}

}  // namespace sandstroke
