#include "sand/tile_pass.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace sandstroke {
namespace {

constexpr double wall = std::numeric_limits<double>::quiet_NaN();
constexpr double lowest = -std::numeric_limits<double>::infinity();

/// The larger one; a wall (NaN) as `a` loses.
double larger(double a, double b) { return a > b ? a : b; }

/// x where it exceeds the threshold, else 0; also for a wall.
double above(double x, double threshold) { return x > threshold ? x : 0.0; }

/// factor x drop where the drop exceeds the threshold, else 0; also for a wall.
double flow(double factor, double drop, double threshold) { return drop > threshold ? factor * drop : 0.0; }

}  // namespace

TilePass::TilePass() : heights_(stride * stride, wall), factors_(stride * stride, 0.0) {}

TilePass& TilePass::of_this_thread() {
  thread_local TilePass pass;
  return pass;
}

void TilePass::load(const HeightField& bed, int tile) {
  const CellRange own = bed.tile_cells(tile);
  const int first_col = own.col_begin - rim;
  for (int r = 0; r < stride; ++r) {
    double* out = heights_.data() + r * stride;
    const int row = own.row_begin - rim + r;
    if (row < 0 || row >= bed.rows()) {
      std::fill(out, out + stride, wall);
      continue;
    }
    const int tile_row = row / side;
    for (int tile_col = own.col_begin / side - 1; tile_col <= own.col_begin / side + 1; ++tile_col) {
      const int begin = std::max(tile_col * side, first_col);
      const int end = std::min((tile_col + 1) * side, first_col + stride);
      const int inside = tile_col < 0 || tile_col >= bed.tile_cols() ? begin : std::min(end, bed.cols());
      if (inside > begin) {
        const double* source = bed.tile_data(bed.tile_index(tile_row, tile_col)) + (row % side) * side;
        std::memcpy(out + (begin - first_col), source + (begin - tile_col * side),
                    sizeof(double) * (inside - begin));
      }
      std::fill(out + (inside - first_col), out + (end - first_col), wall);
    }
  }
}

bool TilePass::paper_factors(int row) {
  const double* m = heights_.data() + row * stride;
  const double *n = m - stride, *s = m + stride;
  const double axis_limit = law_->axis_limit, diagonal_limit = law_->diagonal_limit;
  unsigned moves = 0;
  for (int c = 1; c < stride - 1; ++c) {
    moves |= static_cast<unsigned>(m[c] - m[c - 1] > axis_limit) |
             static_cast<unsigned>(m[c] - m[c + 1] > axis_limit) |
             static_cast<unsigned>(m[c] - n[c] > axis_limit) |
             static_cast<unsigned>(m[c] - s[c] > axis_limit) |
             static_cast<unsigned>(m[c] - n[c - 1] > diagonal_limit) |
             static_cast<unsigned>(m[c] - s[c + 1] > diagonal_limit) |
             static_cast<unsigned>(m[c] - n[c + 1] > diagonal_limit) |
             static_cast<unsigned>(m[c] - s[c - 1] > diagonal_limit);
  }
  if (!moves) return false;

  double* factor = factors_.data() + row * stride;
  const double T = law_->axis_drop, D = law_->diagonal_drop;
  for (int c = 1; c < stride - 1; ++c) {
    const double west = m[c] - m[c - 1], east = m[c] - m[c + 1], north = m[c] - n[c], south = m[c] - s[c];
    const double nw = m[c] - n[c - 1], se = m[c] - s[c + 1], ne = m[c] - n[c + 1], sw = m[c] - s[c - 1];
    const double axis = larger(west, larger(east, larger(north, larger(south, lowest))));
    const double diagonal = larger(nw, larger(se, larger(ne, larger(sw, lowest))));
    if (!(axis > axis_limit || diagonal > diagonal_limit)) {
      factor[c] = 0.0;
      continue;
    }
    const double given = law_->share * std::max(axis - T, diagonal - D);
    const double axis_sum = (above(west, T) + above(east, T)) + (above(north, T) + above(south, T));
    const double diagonal_sum = (above(nw, D) + above(se, D)) + (above(ne, D) + above(sw, D));
    factor[c] = given / (axis_sum + diagonal_sum);
  }
  return true;
}

bool TilePass::isotropic_factors(int row) {
  const double* m = heights_.data() + row * stride;
  const double *n = m - stride, *s = m + stride;
  double* factor = factors_.data() + row * stride;
  bool moves = false;
  for (int c = 1; c < stride - 1; ++c) {
    const double gx = larger(m[c] - m[c - 1], larger(m[c] - m[c + 1], 0.0));
    const double gy = larger(m[c] - n[c], larger(m[c] - s[c], 0.0));
    const double steepest = std::sqrt(gx * gx + gy * gy);
    const bool steep = steepest > law_->axis_limit;
    factor[c] = steep ? law_->share * (1.0 - law_->axis_drop / steepest) : 0.0;
    moves |= steep;
  }
  return moves;
}

template <bool diagonals>
double TilePass::exchange_row(int row, double* next) const {
  const double* m = heights_.data() + row * stride;
  const double *n = m - stride, *s = m + stride;
  const double* f = factors_.data() + row * stride;
  const double *fn = f - stride, *fs = f + stride;
  const double T = diagonals ? law_->axis_drop : 0.0, D = law_->diagonal_drop;
  double moved = 0.0;
  for (int c = rim; c < rim + side; ++c) {
    double out = (flow(f[c], m[c] - m[c - 1], T) + flow(f[c], m[c] - m[c + 1], T)) +
                 (flow(f[c], m[c] - n[c], T) + flow(f[c], m[c] - s[c], T));
    double in = (flow(f[c - 1], m[c - 1] - m[c], T) + flow(f[c + 1], m[c + 1] - m[c], T)) +
                (flow(fn[c], n[c] - m[c], T) + flow(fs[c], s[c] - m[c], T));
    if constexpr (diagonals) {
      out += (flow(f[c], m[c] - n[c - 1], D) + flow(f[c], m[c] - s[c + 1], D)) +
             (flow(f[c], m[c] - n[c + 1], D) + flow(f[c], m[c] - s[c - 1], D));
      in += (flow(fn[c - 1], n[c - 1] - m[c], D) + flow(fs[c + 1], s[c + 1] - m[c], D)) +
            (flow(fn[c + 1], n[c + 1] - m[c], D) + flow(fs[c - 1], s[c - 1] - m[c], D));
    }
    next[c - rim] = m[c] + (in - out);
    moved += out;
  }
  return moved;
}

TilePass::Result TilePass::run(const TalusLaw& law, const HeightField& bed, int tile,
                               std::vector<double>& next) {
  law_ = &law;
  load(bed, tile);
  Result result;
  bool moving = false;
  const bool paper = law_->law == RelaxationLaw::paper;
  for (int row = 1; row < stride - 1; ++row) {
    row_moves_[row] = paper ? paper_factors(row) : isotropic_factors(row);
    if (!row_moves_[row]) std::fill_n(factors_.begin() + row * stride, stride, 0.0);
    moving |= row_moves_[row];
  }
  if (!moving) return result;

  const CellRange own = bed.tile_cells(tile);
  const int rows = own.row_end - own.row_begin, cols = own.col_end - own.col_begin;
  next.resize(HeightField::tile_area);
  for (int r = 0; r < rows; ++r) {
    const int row = r + rim;
    const double* old = heights_.data() + row * stride + rim;
    double* out = next.data() + r * side;
    if (!row_moves_[row - 1] && !row_moves_[row] && !row_moves_[row + 1]) {
      std::memcpy(out, old, sizeof(double) * side);
      continue;
    }
    result.moved += paper ? exchange_row<true>(row, out) : exchange_row<false>(row, out);
    int first = 0, last = cols - 1;
    while (first < cols && out[first] == old[first]) ++first;
    if (first == cols) continue;
    while (out[last] == old[last]) --last;
    result.changed = true;
    result.top |= r < rim;
    result.bottom |= r >= side - rim;
    result.left |= first < rim;
    result.right |= last >= side - rim;
  }
  return result;
}

double TilePass::residual(const TalusLaw& law, const HeightField& bed, int tile) {
  law_ = &law;
  load(bed, tile);
  const CellRange own = bed.tile_cells(tile);
  const bool paper = law_->law == RelaxationLaw::paper;
  double residual = 0.0;
  for (int r = 0; r < own.row_end - own.row_begin; ++r) {
    const double* m = heights_.data() + (r + rim) * stride;
    const double *n = m - stride, *s = m + stride;
    for (int c = rim; c < rim + own.col_end - own.col_begin; ++c) {
      const double gx = larger(m[c] - m[c - 1], larger(m[c] - m[c + 1], 0.0));
      const double gy = larger(m[c] - n[c], larger(m[c] - s[c], 0.0));
      if (paper) {
        const double diagonal = larger(m[c] - n[c - 1], larger(m[c] - s[c + 1], 0.0));
        const double other = larger(m[c] - n[c + 1], larger(m[c] - s[c - 1], 0.0));
        residual = std::max({residual, std::max(gx, gy) / law_->axis_drop - 1.0,
                             std::max(diagonal, other) / law_->diagonal_drop - 1.0});
      } else {
        residual = std::max(residual, std::sqrt(gx * gx + gy * gy) / law_->axis_drop - 1.0);
      }
    }
  }
  return residual;
}

}  // namespace sandstroke
