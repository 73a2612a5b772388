#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>

#include "rules/schedule.h"
#include "sand/displacement.h"
#include "sand/relaxation.h"

namespace sandstroke {

/// What sand and tool have to do with each other in one tick.
struct Interaction {
  double level =
      std::numeric_limits<double>::quiet_NaN();  ///< m, of the sand under the tool; NaN: none there
  double depth = 0.0;                            ///< m, of the tip below the level; negative = above
  double displaced_volume = 0.0;                 ///< m^3
  bool contact = false;                          ///< depth > 0
};

/// The sand's side of a tick: a tool that goes through a bed, from place to place.
class SandSide {
 public:
  /// relaxation: its ways (RelaxationByWay); without them no relaxation is due by way. own: replaces the
  /// displacement of the settings.
  SandSide(const ToolSettings& tool, const DisplacementSettings& displacement,
           const RelaxationSettings& relaxation = {}, std::unique_ptr<Displacer> own = nullptr);

  /// How the tool lies in the bed from the next move() on (ToolFootprint::turn): all of its way there it is
  /// turned like this.
  void turn(const Eigen::Matrix3d& rotation) { footprint_.turn(rotation); }
  /// Displaces along the way from the last tick's place and at this one [m]. read_tip: as the device's
  /// encoders read it; true_tip: where it is, for encoder steps are no motion. relax() is
  /// called with the tool at the places where a relaxation is due by its way; it calls hold() and relaxed().
  /// highest [m]: no sand is higher; none: it is looked up where it matters, which visits every tile.
  Interaction move(HeightField& bed, const Eigen::Vector3d& read_tip, const Eigen::Vector3d& true_tip,
                   const std::function<void()>& relax, std::optional<double> highest = {});
  /// The same place, without displacing anything.
  Interaction look(const HeightField& bed, const Eigen::Vector3d& read_tip);
  /// Takes all memory that a tool that does not turn needs on this bed: move() then takes none of its own.
  void take_memory(const HeightField& bed) {
    look(bed, Eigen::Vector3d::Zero());
    footprint_.make_ways_out(displacement_.distance);
  }
  /// The tool is here [m], in contact or not, by somebody else's account: nothing is displaced.
  void put(const HeightField& bed, const Eigen::Vector3d& read_tip, bool contact);
  /// The tool touches nothing until the next move(), which begins anew: nothing is displaced on the way to
  /// it.
  void lift() {
    last_tip_.reset();
    contact_ = false;
  }
  bool relaxation_is_due() const { return by_way_.is_due(tip_, contact_); }
  /// Marks the cells under a solid tool in contact as walls for the next relaxation; of any other, none.
  void hold(HeightField& bed);
  /// Sand has relaxed. How far the tool may go until the next time depends on how the sand lies now.
  void relaxed(const HeightField& bed);

  /// The footprint where it is, with the sand as it lies there now.
  const ToolFootprint& seen(const HeightField& bed) {
    footprint_.read_heights(bed);
    return footprint_;
  }
  const ToolFootprint& footprint() const { return footprint_; }
  /// To put another one in its place; seen at the next move().
  ToolFootprint& footprint() { return footprint_; }
  /// Where it was in the last tick [m]; none where it was lifted since.
  const std::optional<Eigen::Vector3d>& last_tip() const { return last_tip_; }

 private:
  /// m
  double way_to_next_relaxation(const HeightField& bed);
  Interaction dig(HeightField& bed, const Eigen::Vector3d& tip, const Eigen::Vector3d& motion);
  /// The volume moved [m^3].
  double displace_sand(HeightField& bed, const Eigen::Vector3d& tip, const Eigen::Vector3d& motion);

  ToolFootprint footprint_;
  DisplacementSettings displacement_;
  std::unique_ptr<Displacer> own_;
  bool solid_;
  double way_, way_at_rim_;  // radii
  RelaxationByWay by_way_;
  std::optional<Eigen::Vector3d> last_tip_;        // the true one
  Eigen::Vector3d tip_ = Eigen::Vector3d::Zero();  // as read, where it dug last
  bool contact_ = false;                           // there
};

}  // namespace sandstroke
