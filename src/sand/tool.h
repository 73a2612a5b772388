#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>

#include "core/state_visitor.h"
#include "rules/displacement.h"
#include "sand/tool_footprint.h"
#include "sand/upper_side.h"
#include "tool/tool_settings.h"

namespace sandstroke {

/// A tool in a bed of sand. place() puts it somewhere; the other functions then act on the sand there, and do
/// nothing where the footprint lies outside the bed.
class Tool {
 public:
  virtual ~Tool() = default;
  virtual std::unique_ptr<Tool> copy() const = 0;

  /// Radius [m] of the sphere, or of the largest circle in any other tool's footprint. A tool that moves
  /// farther than this at once leaves no furrow.
  double radius() const { return radius_; }
  /// How far the footprint reaches from the axis [m]; rho1 = s sqrt(u1) of a sphere.
  double reach() const { return reach_; }
  /// Height of the tool's lowest point above its tip [m].
  virtual double lowest() const { return 0.0; }

  /// False for a sphere, and if no point of the tool would move by an eighth of the distance between samples.
  virtual bool would_turn(const Eigen::Matrix3d& /*rotation*/) const { return false; }
  /// Sets the rotation of the tool's frame in the bed, if would_turn(). It takes effect at the next place();
  /// until then the footprint is empty.
  virtual void turn(const Eigen::Matrix3d& /*rotation*/) {}

  /// Moves the tool's axis to (x, y) [m] and reads the sand there. Error: input, if a tool other than the
  /// sphere is too thin or too large for the cells.
  virtual void place(const HeightField& bed, double x, double y) = 0;
  const ToolFootprint& footprint() const { return footprint_; }
  /// Height [m] of the sand around the tool, from which depths count. NaN if the footprint lies outside the
  /// bed.
  double sand_level() const { return level_; }
  /// Depth [m] of the tool's lowest point below that level, with the tip at tip_height [m]; negative above
  /// it. Where the floor stands above that point there is no sand to be deep in: its mean height above it is
  /// left out, so that on a bare floor the depth is 0 or less.
  double depth(double tip_height) const {
    const double lowest_height = tip_height + lowest(), depth = level_ - lowest_height;
    return footprint_.highest_floor() > lowest_height ? depth - floor_above(lowest_height) : depth;
  }
  /// tip [m]: where it was placed last. When the state is put back, it is placed there.
  virtual void visit_state(StateVisitor& state, const HeightField& bed, const Eigen::Vector3d& tip) {
    if (state.restores()) place(bed, tip.x(), tip.y());
  }
  /// Reads the sand under the footprint again.
  void read_heights(const HeightField& bed) { footprint_.read_heights(bed); }

  /// Makes the paper's two passes (3.1), for a tip at tip_height [m]. The first carves the sand above the
  /// tool's underside out of the bowl. The second deposits it around the tool. A second call carves nothing
  /// more. Sand above a carrying tool's upper side is lifted() instead. The tool must have been placed on the
  /// bed as it is now. motion [m]: the tool's displacement
  /// during the tick (Deposit::ahead). Returns the volume moved [m^3]; volume is conserved to rounding. If no
  /// cell around the tool can take the sand, nothing is displaced.
  double displace(HeightField& bed, double tip_height, const Eigen::Vector3d& motion,
                  const DisplacementSettings& settings);
  /// Fills the footprint's underside() and takes() without displacing, for a law of one's own. The tool must
  /// have been placed on the bed as it is now.
  void meet(const HeightField& bed, double tip_height);
  /// The upper side of a tool that carries sand, as it is turned and placed; else null. It is there from the
  /// first place() on.
  virtual const UpperSide* upper_side() const { return nullptr; }
  /// The sand above it that the last displace() took out of the bed, to lie on the tool.
  const std::vector<LiftedSand>& lifted() const { return lifted_; }

  /// Whether the tool may touch sand although it is above the level around it.
  virtual bool may_touch_heaps() const { return false; }
  /// Whether the last displace() or meet() since place() found such sand, or any other, at its underside.
  virtual bool touches() const { return false; }
  /// Height [m] of the highest sand beside the tool's rim above that rim; infinite for a tool whose sides are
  /// always in its own heap.
  virtual double sand_above_rim(const HeightField& /*bed*/, double /*tip_height*/) {
    return std::numeric_limits<double>::infinity();
  }

  /// Finds the cells that the tool covers where it was placed, as if no sand touched it.
  virtual void stand(double /*tip_height*/) {}
  /// Makes the cells that the tool covered in its last displace(), meet() or stand(), and no others, walls of
  /// the bed (HeightField::set_tool_walls).
  void make_walls(HeightField& bed);
  /// Computes ahead what place() and displace() compute once for every orientation. distance:
  /// DisplacementSettings::distance.
  virtual void prepare(double /*distance*/) {}

 protected:
  Tool(double radius, double reach) : radius_(radius), reach_(reach) {}
  /// Carves and deposits in a footprint that is not empty. Returns the sum of heights moved [m], and 0 if it
  /// moved none.
  virtual double displace_in_footprint(const HeightField& bed, double tip_height,
                                       const Eigen::Vector3d& motion,
                                       const DisplacementSettings& settings) = 0;
  /// Carves only, as displace() does, and fills underside() and takes().
  virtual void carve_only(double tip_height) = 0;
  /// Mean height [m] by which the floor stands above `height` [m] under the tool. Some of it does.
  virtual double floor_above(double height) const = 0;
  /// Fills underside() with the cells that make_walls() makes walls.
  virtual void cover() = 0;

  double radius_, reach_;  // m
  double level_ = std::numeric_limits<double>::quiet_NaN();
  ToolFootprint footprint_;
  std::vector<LiftedSand> lifted_;
};

/// Makes the tool that the settings describe. Needs radius > 0, and a mesh that has been read.
std::unique_ptr<Tool> make_tool(const ToolSettings& settings);

}  // namespace sandstroke
