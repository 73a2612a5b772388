#include "sim/sand_watch.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <utility>

#include "core/error.h"

namespace sandstroke {
namespace {

constexpr double rounding = 1e-9;  // share: a law of plain sums stays far below it, however long it runs

/// visit(row, col, height) for every cell of the tiles that something touched.
template <class Visit>
void visit_touched(const HeightField& bed, const Visit& visit) {
  for (int slot = 0; slot < bed.allocated_tiles(); ++slot) {
    const CellRange cells = bed.tile_cells(bed.tile_of(slot));
    for (int row = cells.row_begin; row < cells.row_end; ++row)
      for (int col = cells.col_begin; col < cells.col_end; ++col) visit(row, col, bed(row, col));
  }
}

std::string no_number(const HeightField& bed, const std::string& law) {
  std::string sentence = fmt::format("{} left heights that are too large for a number; correct the law", law);
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

void SandWatch::check(const HeightField& bed, const std::string& law) const {
  const double volume = bed.volume();
  if (!std::isfinite(volume_)) return;  // as it was given
  if (!std::isfinite(volume)) throw Error(ErrorKind::unstable, no_number(bed, law));
  const double gained = volume - volume_;
  if (gained == 0.0) return;
  double sand = 0.0;
  visit_touched(bed, [&](int, int, double height) { sand += std::abs(height); });
  sand *= bed.cell_area();
  if (std::abs(gained) <= rounding * sand) return;
  throw Error(ErrorKind::unstable,
              fmt::format("{} {} {:.3g} m^3 of sand, {:.2g} of what lies above and below z = 0; correct the "
                          "law: what it takes from a cell it has to give to others",
                          law, gained < 0.0 ? "lost" : "made", std::abs(gained), std::abs(gained) / sand));
}

}  // namespace sandstroke
