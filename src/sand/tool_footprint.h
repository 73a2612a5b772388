#pragma once

#include <vector>

#include "sand/height_field.h"

namespace sandstroke {

/// Underside of the tool: the paper's filter a sin(rho^2/s^2), or the sphere itself.
enum class ToolProfile { paper, sphere };

struct ToolSettings {
  double radius = 0.01;  ///< m, of the sphere (paper 4.1)
  ToolProfile profile = ToolProfile::paper;
};

/// The paper's filter g(u) = sin(u) - 0.53, u = (rho/s)^2 (figure 2; read as in model.md): negative up to
/// u0 = asin(0.53), positive up to u1, where its plane integral vanishes: 1 - cos(u1) = 0.53 u1.
namespace filter {
inline constexpr double offset = 0.53;
double u0();
double u1();
}  // namespace filter

/// The cells under and around a tool at a sub-cell position, with what each means to it. Placing it again
/// reuses the memory.
class ToolFootprint {
 public:
  struct Cell {
    int row, col;
    double x, y;          ///< m, cell centre relative to the tool's axis
    double level_weight;  ///< share in the sand level, 0 to 1
    double underside;     ///< m, tool's underside above its tip; bowl cells only
    double rampart;       ///< positive filter, sin(u) - 0.53; ring cells only
    bool in_bowl, in_ring;
  };

  /// Needs radius > 0.
  explicit ToolFootprint(const ToolSettings& settings);

  /// Moves the tool's axis to (x, y) [m]. Cells outside the bed are left out.
  void place(const HeightField& bed, double x, double y);

  const std::vector<Cell>& cells() const { return cells_; }

  /// Mean height [m] under the footprint (u <= u1 in full, fading out within a cell around it, so that it
  /// changes continuously as the tool moves). Displacement moves sand only where the weight is 1: it does not
  /// change the level. NaN where the footprint lies outside the bed.
  double sand_level(const HeightField& bed) const;

  /// rho1 = s sqrt(u1) [m]: how far the footprint reaches.
  double reach() const { return reach_; }

 private:
  double radius_;
  ToolProfile profile_;
  double filter_scale_;  // s: u = (rho/s)^2
  double amplitude_;     // a: the bowl has the sphere's curvature at the tip
  double reach_;
  std::vector<Cell> cells_;
};

}  // namespace sandstroke
