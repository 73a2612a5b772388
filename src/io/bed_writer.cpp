#include "io/bed_writer.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace sandstroke {
namespace {

constexpr int side = BedGeometry::tile_side;
// Chunks of 128 x 128 cells: a dense bed of 1000^2 or 4096^2 is written as fast as in one piece. With 64 the
// small one takes 1.5 times as long; with 256 a stroke's file grows.
constexpr int chunk_tiles = 2;  // along each side

/// The height of most of the sand that is level by the bed's rule; 0 if none is level.
double commonest_level(const HeightField& bed) {
  std::map<double, double> cells_at;
  visit_quarters({0, bed.tile_rows(), 0, bed.tile_cols()}, [&](const CellRange& tiles) {
    const CellRange cells = bed.cells_of_tiles(tiles);
    const std::optional<double> level = bed.untouched().level(bed, cells);
    if (!level) return true;
    cells_at[*level] += static_cast<double>(cells.rows()) * cells.cols();
    return false;
  });
  const auto most = std::max_element(cells_at.begin(), cells_at.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == cells_at.end() ? 0.0 : most->first;
}

/// A height as it is in a file.
double stored(double height) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  return height == -infinite ? std::numeric_limits<double>::quiet_NaN() : height;
}

/// Marks, row by row, the chunks that hold anything but the fill value. It does not look at untouched cells.
std::vector<bool> chunks_to_write(const HeightField& bed, int chunk_rows, int chunk_cols, double fill) {
  std::vector<bool> wanted(static_cast<std::size_t>(chunk_rows) * chunk_cols);
  const auto want = [&](int row, int col) {
    wanted[static_cast<std::size_t>(row) * chunk_cols + col] = true;
  };
  visit_quarters({0, chunk_rows, 0, chunk_cols}, [&](const CellRange& chunks) {
    const CellRange cells =
        bed.cells_of_tiles({chunks.row_begin * chunk_tiles, chunks.row_end * chunk_tiles,
                            chunks.col_begin * chunk_tiles, chunks.col_end * chunk_tiles});
    const std::optional<double> level = bed.untouched().level(bed, cells);
    if (level == fill) return false;
    if (level || (chunks.rows() == 1 && chunks.cols() == 1))
      for (int row = chunks.row_begin; row < chunks.row_end; ++row)
        for (int col = chunks.col_begin; col < chunks.col_end; ++col) want(row, col);
    return !level;
  });
  for (int slot = 0; slot < bed.allocated_tiles(); ++slot)
    want(bed.tile_of(slot) / bed.tile_cols() / chunk_tiles,
         bed.tile_of(slot) % bed.tile_cols() / chunk_tiles);
  return wanted;
}

}  // namespace

void write_bed(Hdf5Writer& file, const std::string& dataset, const HeightField& bed) {
  const double fill = commonest_level(bed);
  Hdf5Chunks chunks =
      file.chunks(dataset, {bed.rows(), bed.cols()}, {chunk_tiles * side, chunk_tiles * side}, stored(fill));
  const int chunk_rows = (bed.tile_rows() + chunk_tiles - 1) / chunk_tiles,
            chunk_cols = (bed.tile_cols() + chunk_tiles - 1) / chunk_tiles;
  const std::vector<bool> wanted = chunks_to_write(bed, chunk_rows, chunk_cols, fill);
  std::vector<double> chunk(chunks.size(), fill);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!wanted[i]) continue;
    const int tile_row = static_cast<int>(i) / chunk_cols * chunk_tiles,
              tile_col = static_cast<int>(i) % chunk_cols * chunk_tiles;
    for (int row = tile_row; row < std::min(tile_row + chunk_tiles, bed.tile_rows()); ++row)
      for (int col = tile_col; col < std::min(tile_col + chunk_tiles, bed.tile_cols()); ++col)
        bed.read_tile(bed.tile_index(row, col),
                      chunk.data() + (row - tile_row) * side * chunks.cols() + (col - tile_col) * side,
                      static_cast<std::ptrdiff_t>(chunks.cols()));
    std::transform(chunk.begin(), chunk.end(), chunk.begin(), stored);
    chunks.write(tile_row * side, tile_col * side, chunk.data());
  }
}

void write_bed_axes(Hdf5GridWriter& file, const std::string& group, const BedGeometry& bed) {
  std::vector<double> centres;
  for (int row = 0; row < bed.rows(); ++row) centres.push_back(bed.y_of(row));
  file.write_scale(group + "/y", centres, "m", "centre of a row of cells");
  centres.clear();
  for (int col = 0; col < bed.cols(); ++col) centres.push_back(bed.x_of(col));
  file.write_scale(group + "/x", centres, "m", "centre of a column of cells");
}

}  // namespace sandstroke
