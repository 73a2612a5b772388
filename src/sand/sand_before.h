#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sand/tool_footprint.h"
#include "tool/tool_elements.h"

namespace sandstroke {

/// The height of the sand that each side of a tool pushes: where the wedge that slides before the side comes
/// out, at `wedge` times the tool's depth below that same height from the tool's edge. It leaves along the
/// tool's way, and beside the tool along the side's horizontal normal. So a heap counts, and so does a furrow
/// that the tool goes along, but not what it has just put down at its edge. Sand in the tool's own columns
/// does not count: a height field is cut away there. No height is above the sand at the edge: what is higher
/// touches nothing.
///
/// With wedge = tan(45 deg + phi / 2), face height H and stress in proportion to depth, this is Rankine's
/// wedge under level sand, and under sand that falls away at phi it has (1 - sin phi)^2 times the force: as
/// Coulomb's passive coefficients have, (1 + sin phi) / (1 - sin phi) and cos^2 phi.
///
/// Heights follow the sand over a yield way, as the force does. So relaxation makes the force no jump. At the
/// bed's wall the last height stays.
class SandBefore {
 public:
  /// Divides the surface (in its own frame, tip at the origin [m]) into some dozens of sides, whatever the
  /// elements, and finds the side of each element.
  SandBefore(const TriangleMesh& surface, const ToolElements& elements);

  void turn(const Eigen::Matrix3d& rotation) { sides_.turn(rotation); }
  /// Forgets the heights: the tool touches nothing.
  void lift();

  struct Motion {
    Eigen::Vector3d tip;  ///< yield ways that the tip went
    Eigen::Matrix3d
        spin;  ///< 1/m; times a position from the tip: the motion there relative to the tip, in yield ways
  };
  /// Looks at the sand after the tool has moved to `tip` [m], where the footprint has the cells that it
  /// covers (Tool::meet, displace). foot [m]: height of the tool's lowest point. False: no side has sand
  /// before it.
  bool look(const HeightField& bed, const ToolFootprint& footprint, const Eigen::Vector3d& tip, double foot,
            const Motion& motion, double wedge);

  /// The side of each element, elements.size() numbers.
  const std::int64_t* side_of() const { return side_of_.get(); }
  /// m, of the sand before each side.
  const double* heights() const { return heights_.data(); }
  /// The height for a surface that looks straight down or up, and moves in direction u: the sides' mean, in
  /// which a side that looks along g counts by 1 + g . u. That is (height + height_ahead . u) / (weight +
  /// weight_ahead . u).
  struct Mean {
    double height = 0.0, weight = 0.0;  // m^3, m^2
    Eigen::Vector2d height_ahead = Eigen::Vector2d::Zero(), weight_ahead = Eigen::Vector2d::Zero();
  };
  const Mean& mean() const { return mean_; }
  /// m: none of these heights is higher.
  double highest() const;

 private:
  /// False: no side is in sand.
  bool average_sides(double tip_height, double foot);

  double size_;  // m, of a side
  ToolElements sides_;
  hwy::AlignedFreeUniquePtr<std::int64_t[]> side_of_;
  std::vector<Eigen::Vector3d> ways_;  // of each side through the sand, in yield ways, at most 1
  std::vector<double> known_;          // m; NaN: not yet, or the side looks nowhere
  std::vector<double> heights_;        // the same for all sides
  std::vector<bool> looks_at_tool_;    // a side before which the tool itself lies, not sand: a cup's inside
  Mean mean_;
};

}  // namespace sandstroke
