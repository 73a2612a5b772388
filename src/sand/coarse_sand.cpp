#include "sand/coarse_sand.h"

#include <atomic>
#include <cmath>
#include <memory>
#include <vector>

#include "core/parallel.h"
#include "sand/active_sand.h"
#include "sand/slope_kernels.h"

namespace sandstroke {
namespace {

constexpr int row_length = BedGeometry::tile_side, half = row_length / 2;

// Found on piles, slopes and hills (tests/bench/levels.cpp).
constexpr double first_factor = 1.1;
/// How far a cell's talus slope may differ from the law's.
constexpr double widest = 0.1;
/// A fine slope below this part of the talus slope rests; there sand is never made to flow.
constexpr double sliding = 0.99;

/// The mean of 2 x 2 numbers, in an order that keeps symmetry.
double mean_of_four(const double* first, std::ptrdiff_t stride) {
  return 0.25 * ((first[0] + first[stride + 1]) + (first[1] + first[stride]));
}

/// Means of 2 x 2 cells of another bed, which must outlive this rule and stay as it is while tiles are
/// filled.
class MeansRule : public SurfaceRule {
 public:
  explicit MeansRule(const HeightField& fine) : fine_(fine) {}

  void fill(const BedGeometry&, const CellRange& cells, double* out, std::ptrdiff_t stride) const override {
    const std::ptrdiff_t width = 2 * cells.cols();
    std::vector<double> two_rows(2 * width);
    for (int row = cells.row_begin; row < cells.row_end; ++row, out += stride) {
      read({2 * row, 2 * row + 2, 2 * cells.col_begin, 2 * cells.col_end}, two_rows.data());
      for (int col = 0; col < cells.cols(); ++col) out[col] = mean_of_four(two_rows.data() + 2 * col, width);
    }
  }
  /// Of its untouched part; the tiles of the others are allocated.
  double steepest(const BedGeometry&, const CellRange& cells) const override {
    return fine_.untouched().steepest(
        fine_, {2 * cells.row_begin, 2 * cells.row_end, 2 * cells.col_begin, 2 * cells.col_end});
  }
  double highest() const override { return fine_.highest(); }

 private:
  /// Copies two rows, which lie in the same tiles, row after row.
  void read(const CellRange& cells, double* out) const {
    const std::ptrdiff_t width = cells.cols();
    for (int col = cells.col_begin; col < cells.col_end;) {
      const int tile = fine_.tile_index(cells.row_begin / row_length, col / row_length);
      const int end = std::min(cells.col_end, (col / row_length + 1) * row_length);
      if (const int slot = fine_.slot_of(tile); slot < 0) {
        fine_.untouched().fill(fine_, {cells.row_begin, cells.row_end, col, end}, out, width);
      } else {
        const double* in =
            fine_.tile_heights(slot) + cells.row_begin % row_length * row_length + col % row_length;
        for (int row = 0; row < 2; ++row) std::copy_n(in + row * row_length, end - col, out + row * width);
      }
      out += end - col;
      col = end;
    }
  }

  const HeightField& fine_;
};

/// The fine tiles of a coarse one: visit(fine tile, its first row and column in the coarse tile).
template <class Visit>
void visit_fine_tiles(const BedGeometry& coarse, const BedGeometry& fine, int tile, const Visit& visit) {
  const int row = 2 * (tile / coarse.tile_cols()), col = 2 * (tile % coarse.tile_cols());
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      if (row + i < fine.tile_rows() && col + j < fine.tile_cols())
        visit(fine.tile_index(row + i, col + j), i * half, j * half);
}

/// Calls visit(row, col) for the cells of a coarse tile that a fine tile fills.
template <class Visit>
void visit_cells(const BedGeometry& fine, int fine_tile, int first_row, int first_col, const Visit& visit) {
  const CellRange cells = fine.tile_cells(fine_tile);
  for (int row = 0; row < cells.rows() / 2; ++row)
    for (int col = 0; col < cells.cols() / 2; ++col) visit(first_row + row, first_col + col);
}

constexpr bool worth_threads(std::size_t tiles) { return tiles > 4; }

}  // namespace

RelaxationSettings on_coarse_bed(const RelaxationSettings& settings) {
  RelaxationSettings coarse = settings;
  coarse.law = RelaxationLaw::isotropic;
  return coarse;
}

CoarseSand::CoarseSand(const HeightField& fine, const RelaxationSettings& settings,
                       const std::vector<int>& awake, const HeightField* fine_factors, bool first)
    : bed_(fine.rows() / 2, fine.cols() / 2, 2.0 * fine.cell_size(), std::make_shared<MeansRule>(fine)),
      talus_factors_(bed_.rows(), bed_.cols(), bed_.cell_size(),
                     std::make_shared<LevelRule>(first ? first_factor : 1.0)) {
  take_tiles(fine, awake);
  allow_slopes(fine, settings, fine_factors, first);
}

void CoarseSand::take_tiles(const HeightField& fine, const std::vector<int>& awake) {
  for (const int fine_slot : awake) {
    const int fine_tile = fine.tile_of(fine_slot);
    const int row = fine_tile / fine.tile_cols() / 2, col = fine_tile % fine.tile_cols() / 2;
    if (row >= bed_.tile_rows() || col >= bed_.tile_cols()) continue;
    const int tile = bed_.tile_index(row, col);
    const int slot = bed_.allocate(tile);
    for (int r = 0; r < row_length; ++r) bed_.mark_disturbed(slot, r, ~std::uint64_t{0});
    bed_.allocate_around(tile);
  }
  // Sand may flow on to the tiles beside: there, too, it must know how steep it may be, and what lies beyond.
  known_tiles_ = bed_.allocated_tiles();
  for (int slot = 0; slot < known_tiles_; ++slot) bed_.allocate_around(bed_.tile_of(slot));
}

void CoarseSand::allow_slopes(const HeightField& fine, const RelaxationSettings& settings,
                              const HeightField* fine_factors, bool first) {
  const TalusLaw fine_law = talus_law(settings, fine.cell_size());
  const TalusLaw law = talus_law(on_coarse_bed(settings), bed_.cell_size());
  const auto tiles = static_cast<std::size_t>(known_tiles_);
  for (std::size_t slot = 0; slot < tiles; ++slot)
    talus_factors_.allocate(bed_.tile_of(static_cast<int>(slot)));
  std::atomic<bool> flows = false;
  parallel_for(tiles, worth_threads(tiles), [&](std::size_t at) {
    const int slot = static_cast<int>(at), tile = bed_.tile_of(slot);
    thread_local TilePatch patch;
    thread_local TileSlopes slopes, fine_slopes;
    thread_local std::array<double, BedGeometry::tile_area> factors;
    patch.load_whole(bed_, slot);
    compute_slopes(law, patch, slopes);
    double* out = talus_factors_.tile_heights(talus_factors_.slot_of(tile));
    bool too_steep = false;
    visit_fine_tiles(bed_, fine, tile, [&](int fine_tile, int first_row, int first_col) {
      if (fine_factors) fine_factors->read_tile(fine_tile, factors.data());
      const int fine_slot = fine.slot_of(fine_tile);
      if (fine_slot >= 0 && !first) {
        patch.load_whole(fine, fine_slot);
        compute_slopes(fine_law, patch, fine_slopes);
      }
      visit_cells(fine, fine_tile, first_row, first_col, [&](int row, int col) {
        const int here = row * row_length + col,
                  there = 2 * (row - first_row) * row_length + 2 * (col - first_col);
        const double factor = fine_factors ? mean_of_four(factors.data() + there, row_length) : 1.0;
        double allowed = 1.0;
        if (first) {
          allowed = first_factor;
        } else if (fine_slot >= 0) {
          const double slope = mean_of_four(fine_slopes.data() + there, row_length);
          allowed = std::clamp(1.0 + (slopes[here] - slope) / factor, 1.0 - widest, 1.0 + widest);
          if (slope < sliding * factor) allowed = std::max(1.0, allowed);
        }
        out[here] = factor * allowed;
        too_steep |= slopes[here] > out[here] * (1.0 + settings.tolerance);
      });
    });
    if (too_steep) flows = true;
  });
  flows_ = flows;
}

void CoarseSand::bring_back(HeightField& fine) const {
  HeightField change(bed_.rows(), bed_.cols(), bed_.cell_size());
  for (int slot = 0; slot < bed_.allocated_tiles(); ++slot) {
    const int tile = bed_.tile_of(slot);
    double* out = change.tile_heights(change.allocate(tile));
    std::array<double, BedGeometry::tile_area> before;
    const CellRange cells = bed_.tile_cells(tile);
    bed_.untouched().fill(bed_, cells, before.data(), row_length);
    bool changed = false;
    for (int row = 0; row < cells.rows(); ++row)
      for (int col = 0; col < cells.cols(); ++col) {
        const int at = row * row_length + col;
        out[at] = bed_.tile_heights(slot)[at] - before[at];
        changed |= out[at] != 0.0;
      }
    if (changed)
      visit_fine_tiles(bed_, fine, tile, [&](int fine_tile, int, int) { fine.allocate(fine_tile); });
  }

  const std::size_t tiles = change.allocated_tiles();
  std::vector<CellFlags> changed(4 * tiles);
  parallel_for(tiles, worth_threads(tiles), [&](std::size_t slot) {
    thread_local TilePatch patch;
    patch.load_whole(change, static_cast<int>(slot));
    std::size_t quarter = 4 * slot;
    visit_fine_tiles(
        bed_, fine, change.tile_of(static_cast<int>(slot)), [&](int tile, int first_row, int first_col) {
          CellFlags& flags = changed[quarter++];
          if (fine.slot_of(tile) < 0) return;
          double* out = fine.tile_heights(fine.slot_of(tile));
          visit_cells(fine, tile, first_row, first_col, [&](int row, int col) {
            const double here = patch.heights(row)[col];
            if (here == 0.0) return;
            // What a fine cell takes of the difference to a neighbour, its mirror image there gives.
            const auto beside = [&](int row_step, int col_step) {
              const double there = patch.heights(row + row_step)[col + col_step];
              return there != 0.0 && !std::isnan(there) ? there - here : 0.0;
            };
            for (int i = 0; i < 2; ++i)
              for (int j = 0; j < 2; ++j) {
                const int up = i ? 1 : -1, left = j ? 1 : -1;
                const double gain =
                    here + ((3.0 * beside(up, 0) + 3.0 * beside(0, left)) + beside(up, left)) / 16.0;
                const int r = 2 * (row - first_row) + i, c = 2 * (col - first_col) + j;
                out[r * row_length + c] += gain;
                flags[r] |= std::uint64_t{1} << c;
              }
          });
        });
  });
  for (std::size_t slot = 0; slot < tiles; ++slot) {
    std::size_t quarter = 4 * slot;
    visit_fine_tiles(bed_, fine, change.tile_of(static_cast<int>(slot)), [&](int tile, int, int) {
      const CellFlags& flags = changed[quarter++];
      for (int row = 0; row < row_length; ++row)
        if (flags[row]) fine.mark_disturbed(fine.slot_of(tile), row, flags[row]);
    });
  }
}

}  // namespace sandstroke
