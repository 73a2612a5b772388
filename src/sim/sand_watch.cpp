#include "sim/sand_watch.h"

#include <spdlog/fmt/fmt.h>

#include <array>
#include <cmath>
#include <utility>

#include "core/compensated_sum.h"
#include "core/error.h"

namespace sandstroke {
namespace {

constexpr double rounding = 1e-9;  // fraction: a law of plain sums stays far below it, however long it runs

/// Calls visit(row, col, height) for every cell of the allocated tiles.
template <class Visit>
void visit_touched(const HeightField& bed, const Visit& visit) {
  for (int slot = 0; slot < bed.allocated_tiles(); ++slot) {
    const CellRange cells = bed.tile_cells(bed.tile_of(slot));
    for (int row = cells.row_begin; row < cells.row_end; ++row)
      for (int col = cells.col_begin; col < cells.col_end; ++col) visit(row, col, bed(row, col));
  }
}

std::string no_number(const HeightField& bed, const std::string& law) {
  std::string sentence =
      fmt::format("{} left heights whose sum is too large for a number; correct the law", law);
  bool found = false;
  visit_touched(bed, [&](int row, int col, double height) {
    if (std::isfinite(height) || std::exchange(found, true)) return;
    sentence =
        fmt::format("{} left a height that is not a number, at x = {:.4g} m, y = {:.4g} m; correct the law",
                    law, bed.x_of(col), bed.y_of(row));
  });
  return sentence;
}

}  // namespace

SandWatch::SandWatch(const HeightField& bed) : untouched_(bed.untouched_bed()), at_first_(gained(bed)) {}

double SandWatch::gained(const HeightField& bed) {
  const bool replaced = &bed.untouched() != &untouched_.untouched();  // by another bed, with other revisions
  if (replaced || replaced_) sums_.clear();
  replaced_ = replaced;
  sums_.resize(static_cast<std::size_t>(bed.allocated_tiles()));
  std::array<double, HeightField::tile_area> heights, rule;
  CompensatedSum all;
  for (int slot = 0; slot < bed.allocated_tiles(); ++slot) {
    const int tile = bed.tile_of(slot);
    TileSum& sum = sums_[static_cast<std::size_t>(slot)];
    if (sum.tile != tile || sum.revision != bed.tile_revision(tile)) {
      const CellRange cells = bed.tile_cells(tile);
      bed.read_tile(tile, heights.data());
      untouched_.untouched().fill(bed, cells, rule.data(), HeightField::tile_side);
      CompensatedSum more;
      sum = {tile, bed.tile_revision(tile), 0.0, 0.0};
      for (int row = 0; row < cells.rows(); ++row)
        for (int col = 0; col < cells.cols(); ++col) {
          const auto at = static_cast<std::size_t>(row * HeightField::tile_side + col);
          more.add(heights[at]);
          more.add(-rule[at]);
          sum.sand += std::abs(heights[at]);
        }
      sum.gained = more.value();
    }
    all.add(sum.gained);
  }
  return all.value();
}

void SandWatch::check(const HeightField& bed, const std::string& law, double given) {
  const double given_heights = given / bed.cell_area(), more = gained(bed) - at_first_ - given_heights;
  if (more == 0.0 || !std::isfinite(at_first_)) return;  // or the given bed was not finite
  if (!std::isfinite(more)) throw Error(ErrorKind::unstable, no_number(bed, law));
  double sand = std::abs(given_heights);
  for (const TileSum& sum : sums_) sand += sum.sand;
  const double fraction = std::abs(more) / sand;
  if (fraction <= rounding) return;
  throw Error(ErrorKind::unstable,
              fmt::format("{} {} {:.3g} m^3 of sand, a fraction of {:.2g} of the sand above and below z = 0; "
                          "correct the law: it must give to other cells what it takes from a cell",
                          law, more < 0.0 ? "lost" : "made", std::abs(more) * bed.cell_area(), fraction));
}

}  // namespace sandstroke
