#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/aligned_vector.h"
#include "core/state_visitor.h"
#include "sand/tool_footprint.h"
#include "tool/tool_elements.h"

namespace sandstroke {

/// The height of the sand that each side of a tool pushes: where the wedge that slides before the side comes
/// out, at `wedge` times the tool's depth below that same height from the tool's edge, or from the middle of
/// a side that is not all in the sand. It leaves along the tool's way, and beside the tool along the side's
/// horizontal normal. So a heap counts, and so does a furrow that the tool goes along, but not what it has
/// just put down at its edge. Sand in the tool's own columns does not count: a height field is cut away
/// there. No height is above the sand at the edge: what is higher touches nothing.
///
/// With wedge = tan(45 deg + phi / 2), face height H and stress in proportion to depth, this is Rankine's
/// wedge under level sand, and under sand that falls away at phi it has (1 - sin phi)^2 times the force: as
/// Coulomb's passive coefficients have, (1 + sin phi) / (1 - sin phi) and cos^2 phi.
///
/// A side looks at the sand again after an eighth of a cell of way, and its height follows what it saw over a
/// yield way, as the force does. So relaxation makes the force no jump. At the bed's wall the last height
/// stays.
class SandBefore {
 public:
  /// Divides the surface (in its own frame, tip at the origin [m]) into some dozens of sides, whatever the
  /// elements, and finds the side of each element.
  SandBefore(const TriangleMesh& surface, const ToolElements& elements);

  void turn(const Eigen::Matrix3d& rotation);
  /// Forgets the heights: the tool touches nothing.
  void lift();

  struct Motion {
    Eigen::Vector3d tip;  ///< yield ways that the tip went
    Eigen::Matrix3d
        spin;  ///< 1/m; times a position from the tip: the motion there relative to the tip, in yield ways
    double yield_way;  ///< m
  };
  /// Looks at the sand after the tool has moved to `tip` [m], where the footprint has the cells that it
  /// covers (Tool::meet, displace). foot [m]: height of the tool's lowest element. False: no side has sand
  /// before it.
  bool look(const HeightField& bed, const ToolFootprint& footprint, const Eigen::Vector3d& tip, double foot,
            const Motion& motion, double wedge);

  void visit_state(StateVisitor& state) {
    state.row("force.side.ways", ways_);
    state.row("force.side.cells_out", cells_out_);
    state.row("force.side.since", since_);
    state.row("force.side.seen", seen_);
    state.row("force.side.places", places_);
    state.row("force.side.known", known_);
    state.row("force.side.heights", heights_);
    state.value("force.slope_since", slope_since_);
    state.value("force.slope_seen", slope_seen_);
    state.value("force.slope", slope_);
    state.value("force.mean", mean_);
    state.value("force.level", level_);
  }

  /// The side of each element, elements.size() numbers.
  const std::int64_t* side_of() const { return side_of_.data(); }
  /// m, of the sand before each side. -infinity: no sand gets there.
  const double* heights() const { return heights_.data(); }
  /// The height for a surface that looks straight down or up, and moves in direction u: the sides' mean, in
  /// which a side that looks along g counts by 1 + g . u. That is (height + height_ahead . u) / (weight +
  /// weight_ahead . u) at the tip, and elsewhere by the slope of the sand around the tool.
  struct Mean {
    double height = 0.0, weight = 0.0;  // m^3, m^2
    Eigen::Vector2d height_ahead = Eigen::Vector2d::Zero(), weight_ahead = Eigen::Vector2d::Zero();

    template <class State>
    void visit_state(State& state) {
      state.value("height", height);
      state.value("weight", weight);
      state.value("height_ahead", height_ahead);
      state.value("weight_ahead", weight_ahead);
    }
  };
  const Mean& mean() const { return mean_; }
  const Eigen::Vector2d& slope() const { return slope_; }
  /// m: none of these heights is higher.
  double highest() const;

 private:
  bool is_enclosed(int side, const TriangleMesh& surface) const;
  void find_outward();
  void follow_slope(const HeightField& bed, const Eigen::Vector3d& tip, double moved_by,
                    const Motion& motion);
  /// False: no side is in sand.
  bool average_sides(double tip_height);

  double size_;  // m, of a side
  ToolElements sides_;
  AlignedVector<std::int64_t> side_of_;
  std::vector<Eigen::Vector2d> outward_;  // of each side, a horizontal unit vector; 0: it looks nowhere
  std::vector<double> weights_;           // m^2, its area by how much it looks sideways
  std::vector<Eigen::Vector3d> ways_;     // of each side through the sand, in yield ways, at most 1
  std::vector<int> cells_out_;            // from each side to the tool's edge
  std::vector<double> since_;             // m, that the side went since it looked at the sand
  std::vector<double> seen_;              // m, the height that it saw there
  std::vector<Eigen::Vector2d> places_;   // m from the tip, where it saw that
  std::vector<double> known_;             // m; NaN: not yet, or the side looks nowhere
  std::vector<double> heights_;           // the same for all sides
  std::vector<bool> enclosed_;            // no sand gets there: a cup's inside
  double reach_ = 0.0;                    // m, of the sides from the tip's axis
  double slope_since_ = 0.0;              // m, that the tip went since it looked at the slope
  Eigen::Vector2d slope_seen_ = Eigen::Vector2d::Zero(), slope_ = Eigen::Vector2d::Zero();
  Mean mean_;
  /// m: the sides' mean in the last tick, if there was one.
  double level_ = -std::numeric_limits<double>::infinity();
};

}  // namespace sandstroke
