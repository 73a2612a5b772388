#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>

#include "core/copied.h"
#include "rules/schedule.h"
#include "sand/displacer.h"
#include "sand/relaxation.h"
#include "sim/tool_load.h"

namespace sandstroke {

/// How sand and tool interact in one tick.
struct Interaction {
  double level =
      std::numeric_limits<double>::quiet_NaN();  ///< m, of the sand under the tool; NaN: none there
  double depth = 0.0;                            ///< m, of the tip below the level (Tool::depth)
  double displaced_volume = 0.0;                 ///< m^3
  bool contact = false;                          ///< depth > 0
};

/// The sand's side of a tick: moves a tool through a bed, from position to position.
class SandSide {
 public:
  /// relaxation: its ways (RelaxationByWay); without them no relaxation is due by way. plugin_law: replaces
  /// the displacement of the settings.
  SandSide(const ToolSettings& tool, const DisplacementSettings& displacement,
           const RelaxationSettings& relaxation = {}, std::unique_ptr<Displacer> plugin_law = nullptr);

  /// The tool, which is the constructor's, carries sand from now on. density [kg/m^3]: of the sand in bulk.
  /// Without this call no tool does, whatever its settings say.
  void carry(const ToolSettings& tool, double density);
  /// The sand on the tool, from the first move() on; null: the tool carries none.
  ToolLoad* load() { return load_ ? &*load_ : nullptr; }
  const ToolLoad* load() const { return load_ ? &*load_ : nullptr; }
  /// What is seen of the sand on the tool; none: there is none.
  std::optional<LoadSurface> load_surface() const;
  /// The height at which sand that falls at a place comes down on a tool that carries [m]; -infinity: beside
  /// it.
  double top_at(const Eigen::Vector2d& place) const;
  /// Takes a height of sand over a cell of the bed at such a place [m].
  void catch_sand(const Eigen::Vector2d& place, double height);
  /// Brings the sand on the tool to rest, at this time [s].
  void relax_load(HeightField& bed, double time) {
    if (load_) load_->relax(*tool_, bed, tip_, time);
  }
  /// What the sand on the tool does to it.
  LoadOnTool load_on_tool() const;

  /// Sets the tool's orientation from the next move() on (Tool::turn). The tool keeps it during the
  /// whole move.
  void turn(const Eigen::Matrix3d& rotation) { tool_->turn(rotation); }
  /// Displaces sand along the way from the last tick's position to this one [m], and there. read_tip: as the
  /// device's encoders read it; true_tip: where it is, since encoder steps are no motion. Calls relax() with
  /// the tool at the positions where a relaxation is due by its way; relax() must call make_walls() and
  /// relaxed(). highest [m]: an upper bound of the sand; none: it is looked up if needed, which visits every
  /// tile.
  Interaction move(HeightField& bed, const Eigen::Vector3d& read_tip, const Eigen::Vector3d& true_tip,
                   const std::function<void()>& relax, std::optional<double> highest = {});
  /// Places the tool there, without displacing anything.
  Interaction look(const HeightField& bed, const Eigen::Vector3d& read_tip);
  /// The same, and finds the cells that the tool covers, as move() does: a law of force looks at them.
  Interaction meet(const HeightField& bed, const Eigen::Vector3d& read_tip);
  /// Allocates all memory that a tool that does not turn needs on this bed, so that move() allocates none of
  /// its own.
  void take_memory(const HeightField& bed) {
    look(bed, Eigen::Vector3d::Zero());
    tool_->prepare(displacement_.distance);
  }
  /// Puts the tool here [m], in contact or not as the caller says. Displaces nothing.
  void put(const HeightField& bed, const Eigen::Vector3d& read_tip, bool contact);
  /// Lifts the tool: it touches nothing until the next move(), which begins anew and displaces nothing on the
  /// way there.
  void lift() {
    last_tip_.reset();
    contact_ = false;
  }
  bool relaxation_is_due() const { return by_way_.is_due(tip_, contact_); }
  /// Marks the cells under a solid tool in contact as walls for the next relaxation. Any other tool makes no
  /// walls.
  void make_walls(HeightField& bed);
  /// Call it when sand has relaxed. The sand as it lies now decides how far the tool may go until the
  /// next time.
  void relaxed(const HeightField& bed);

  /// The tool where it was placed last. Its footprint has the sand as it was then.
  const Tool& tool() const { return *tool_; }
  /// The same, with the sand as it lies now.
  const Tool& tool_on(const HeightField& bed) {
    tool_->read_heights(bed);
    return *tool_;
  }
  /// bed: as the state has it. Error: input, if a plugin law displaces sand.
  void visit_state(StateVisitor& state, const HeightField& bed);
  /// Swaps the tool for another one, which is used from the next move() on.
  void exchange(std::unique_ptr<Tool>& other) { std::swap(tool_.pointer(), other); }
  /// Position of the tool in the last tick [m]; none if it was lifted since.
  const std::optional<Eigen::Vector3d>& last_tip() const { return last_tip_; }

 private:
  /// How far the sand at the tool's rim calls for the short way: from 0, none stands at it, to 1.
  double buried(const HeightField& bed);
  /// The way [m] that the tool may go until the next relaxation.
  double way_to_next_relaxation(const HeightField& bed);
  Interaction displace_at(HeightField& bed, const Eigen::Vector3d& tip, const Eigen::Vector3d& motion);
  /// The volume moved [m^3].
  double displace_sand(HeightField& bed, const Eigen::Vector3d& tip, const Eigen::Vector3d& motion);

  Copied<Tool> tool_;
  DisplacementSettings displacement_;
  Copied<Displacer> plugin_law_;
  bool solid_;
  RelaxationSettings relaxation_;
  double density_ = 0.0;  // kg/m^3; 0: the tool carries nothing
  std::optional<ToolLoad> load_;
  double way_, way_at_rim_;  // radii
  RelaxationByWay by_way_;
  std::optional<Eigen::Vector3d> last_tip_;        // the true one
  Eigen::Vector3d tip_ = Eigen::Vector3d::Zero();  // as read, where it displaced last
  bool contact_ = false;                           // at tip_
};

}  // namespace sandstroke
