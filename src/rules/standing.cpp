#include "rules/standing.h"

namespace sandstroke {
namespace {

/// The fields of a bed as the rule asks for them.
struct GridSand {
  const HeightGrid &heights, &levels, &floors, &cohesions;
  double size, top_floor;
  bool uniform;

  int rows() const { return static_cast<int>(heights.rows()); }
  int cols() const { return static_cast<int>(heights.cols()); }
  double cell_size() const { return size; }
  bool is_rectangle() const { return true; }
  double highest_floor() const { return top_floor; }
  bool is_uniform() const { return uniform; }
  bool has_sand(int row, int col) const { return row >= 0 && row < rows() && col >= 0 && col < cols(); }
  double height(int row, int col) const { return heights(row, col); }
  double intact(int row, int col) const { return levels(row, col); }
  double floor(int row, int col) const { return floors(row, col); }
  double cohesion(int row, int col) const { return cohesions(row, col); }
};

/// Calls visit(row, col) for the cells of a grid within a disc around one.
template <class Visit>
void visit_disc(const HeightGrid& grid, int row, int col, int radius, const Visit& visit) {
  for (int r = std::max(0, row - radius); r <= std::min<int>(static_cast<int>(grid.rows()) - 1, row + radius);
       ++r)
    for (int c = std::max(0, col - radius);
         c <= std::min<int>(static_cast<int>(grid.cols()) - 1, col + radius); ++c)
      if (standing::in_disc(r - row, c - col, radius)) visit(r, c);
}

}  // namespace

void open_level(const HeightGrid& before, HeightGrid& level) {
  HeightGrid least = level;
  for (int row = 0; row < level.rows(); ++row)
    for (int col = 0; col < level.cols(); ++col)
      visit_disc(level, row, col, standing::opening,
                 [&](int r, int c) { least(row, col) = std::min(least(row, col), level(r, c)); });
  const HeightGrid lowered = level;
  for (int row = 0; row < level.rows(); ++row)
    for (int col = 0; col < level.cols(); ++col) {
      bool near = false;
      visit_disc(level, row, col, 2 * standing::opening,
                 [&](int r, int c) { near |= lowered(r, c) < before(r, c); });
      if (!near) continue;
      double opened = least(row, col);
      visit_disc(level, row, col, standing::opening,
                 [&](int r, int c) { opened = std::max(opened, least(r, c)); });
      level(row, col) = std::min(level(row, col), opened);
    }
}

CutsLook look_at_cuts(const HeightGrid& heights, const HeightGrid& intact, const HeightGrid& floor,
                      const HeightGrid& cohesion, const WallGrid& walls, const CohesionFactor& factor,
                      double cell_size) {
  CutsLook look;
  look.intact = intact;
  const GridSand sand{heights,
                      intact,
                      floor,
                      cohesion,
                      cell_size,
                      floor.maxCoeff(),
                      cohesion.minCoeff() == cohesion.maxCoeff()};
  const double top = heights.maxCoeff(), safe = factor.safe_height() * cohesion.minCoeff();
  for (int row = 0; row < sand.rows(); ++row)
    for (int col = 0; col < sand.cols(); ++col) {
      const double toe = heights(row, col);
      if (walls(row, col) || top - toe <= safe || !is_toe(sand, row, col, factor.friction())) continue;
      ++look.toes;
      const Uphill uphill = uphill_of(sand, row, col, factor.friction());
      const Wedge wedge = worst_wedge(sand, row, col, uphill, factor, (top - toe) / factor.friction());
      look.need = std::max(look.need, wedge.need);
      if (!(wedge.need > 1.0)) continue;
      ++look.failed;
      visit_wedge(row, col, toe, uphill, wedge, cell_size, sand.rows(), sand.cols(),
                  [&](int r, int c, double level) {
                    look.intact(r, c) = std::min(look.intact(r, c), std::max(level, floor(r, c)));
                  });
    }
  if (look.failed > 0) open_level(intact, look.intact);
  look.intact = look.intact.max(floor);
  return look;
}

}  // namespace sandstroke
