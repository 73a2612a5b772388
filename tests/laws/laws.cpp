// Laws of your own, one of each kind: relaxation in plain passes, sand that goes ahead of the tool, and a
// spring with friction. model.parameters = [share of a pass, stiffness in N/m, friction, 0]; 0: as below.
#include <algorithm>
#include <cmath>
#include <vector>

#include "sand/whole_bed_relaxer.h"
#include "sim/plugin.h"

using namespace sandstroke;

namespace {

double or_else(double parameter, double usual) { return parameter > 0.0 ? parameter : usual; }

/// The slope of a cell towards its lower neighbours; where it is too steep, each gets its share of the
/// excess.
class PlainPasses : public WholeBedRelaxer {
 public:
  PlainPasses(const Scene& scene, double cell_size)
      : WholeBedRelaxer(scene.relaxation.max_passes),
        drop_(talus_slope(scene.relaxation.talus_angle) * cell_size),
        tolerance_(scene.relaxation.tolerance),
        share_(or_else(scene.plugin_laws.parameters[0], 0.25)) {}

 protected:
  TalusPass pass(const HeightGrid& heights, const WallGrid& walls, CompensatedSum& moved) const override {
    TalusPass pass{heights, false, 0.0};
    for (int row = 0; row < heights.rows(); ++row)
      for (int col = 0; col < heights.cols(); ++col)
        if (!walls(row, col)) relax(heights, walls, row, col, pass, moved);
    return pass;
  }

 private:
  void relax(const HeightGrid& heights, const WallGrid& walls, int row, int col, TalusPass& pass,
             CompensatedSum& moved) const {
    double drops[4], steepest[2] = {0.0, 0.0};
    for (int side = 0; side < 4; ++side) {
      const int i = row + (side == 2) - (side == 3), j = col + (side == 0) - (side == 1);
      const bool wall = i < 0 || j < 0 || i >= heights.rows() || j >= heights.cols() || walls(i, j);
      drops[side] = wall ? 0.0 : heights(row, col) - heights(i, j);
      steepest[side / 2] = std::max(steepest[side / 2], drops[side]);
    }
    const double slope = std::hypot(steepest[0], steepest[1]);
    pass.residual = std::max(pass.residual, slope / drop_ - 1.0);
    if (slope <= drop_ * (1.0 + tolerance_)) return;
    pass.flows = true;
    for (int side = 0; side < 4; ++side) {
      if (drops[side] <= 0.0) continue;
      const double amount = share_ * (1.0 - drop_ / slope) * drops[side];
      pass.heights(row, col) -= amount;
      pass.heights(row + (side == 2) - (side == 3), col + (side == 0) - (side == 1)) += amount;
      moved.add(amount);
    }
  }

  double drop_, tolerance_, share_;
};

/// All sand in the tool's way goes onto the cells beside it that lie ahead of its motion, each as much.
class AllAhead : public Displacer {
 public:
  double displace(HeightField& bed, const Tool& tool, double tip_height,
                  const Eigen::Vector3d& motion) override {
    struct Cell {
      int row, col;
    };
    std::vector<Cell> under, ahead;
    const ToolFootprint& footprint = tool.footprint();
    const CellRange& window = footprint.cells();
    const double reach = tool.reach() / footprint.cell_size();  // in cells, as all positions here
    for (int row = 0; row < window.rows(); ++row) {
      const ColumnRange sand = footprint.sand_cols(row);
      for (int col = sand.begin; col < sand.end; ++col) {
        const double x = footprint.first_x() + col - footprint.axis_x(),
                     y = footprint.first_y() + row - footprint.axis_y();
        const Cell cell{window.row_begin + row, window.col_begin + col};
        if (footprint.heights(row)[col] > tip_height + footprint.underside(row)[col])
          under.push_back(cell);
        else if (footprint.takes(row)[col] > 0.0 && std::hypot(x, y) <= reach &&
                 x * motion.x() + y * motion.y() >= 0.0)
          ahead.push_back(cell);
      }
    }
    if (under.empty() || ahead.empty()) return 0.0;
    double taken = 0.0;
    for (const Cell& cell : under) {
      const double left =
          tip_height + footprint.underside(cell.row - window.row_begin)[cell.col - window.col_begin];
      taken += bed(cell.row, cell.col) - left;
      bed.set(cell.row, cell.col, left);
    }
    for (const Cell& cell : ahead)
      bed.set(cell.row, cell.col, bed(cell.row, cell.col) + taken / static_cast<double>(ahead.size()));
    return taken * bed.cell_area();
  }
};

/// A spring that the depth compresses, and Coulomb friction across it, which is all there after a yield way.
class SpringAndFriction : public ToolForce {
 public:
  explicit SpringAndFriction(const Scene& scene)
      : stiffness_(or_else(scene.plugin_laws.parameters[1], 500.0)),
        friction_(or_else(scene.plugin_laws.parameters[2], scene.strength.tool_friction)),
        yield_(scene.strength.yield_way) {}

  Wrench feel(const ToolInSand& touch) override {
    way_ += touch.motion.head<2>() / yield_;
    if (way_.norm() > 1.0) way_.normalize();
    Wrench wrench;
    const double normal = stiffness_ * std::max(touch.depth, 0.0);
    wrench.force << -friction_ * normal * way_, normal;
    wrench.stiffness = stiffness_ + friction_ * normal / yield_;
    wrench.stored = 0.5 * (normal * touch.depth + friction_ * normal * yield_);
    return wrench;
  }
  void lift() override { way_.setZero(); }

 private:
  double stiffness_, friction_, yield_;
  Eigen::Vector2d way_ = Eigen::Vector2d::Zero();  // of the tool through the sand, in yield ways
};

}  // namespace

SANDSTROKE_LAWS(laws) {
  laws.relaxations["plain"] = [](const Scene& scene, double cell_size) {
    return std::make_unique<PlainPasses>(scene, cell_size);
  };
  laws.displacements["ahead"] = [](const Scene&, double) { return std::make_unique<AllAhead>(); };
  laws.forces["spring"] = [](const Scene& scene, double) {
    return std::make_unique<SpringAndFriction>(scene);
  };
}
