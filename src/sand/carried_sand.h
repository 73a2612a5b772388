#pragma once

#include <memory>
#include <vector>

#include "core/copied.h"
#include "sand/relaxation.h"
#include "sand/upper_side.h"

namespace sandstroke {

/// The surface of the sand on a tool, over the cells of its upper side.
struct LoadSurface {
  /// m above the tip; where no sand is, the tool's own beside sand, and elsewhere not a number.
  HeightGrid height;
  double cell_size;       ///< m
  Eigen::Vector2d along;  ///< the grid's x axis, on the bed's
};

/// The sand that lies on a tool and goes with it. It rests on the tool's upper side as on a floor,
/// by the law of relaxation of the bed; what runs over the rim falls, and what stands beside the tool and
/// higher runs onto it. Sand at rest keeps its bits as the tool goes, turns about the vertical or stays.
class CarriedSand {
 public:
  CarriedSand(const RelaxationSettings& relaxation, const UpperSide& upper);

  bool empty() const { return volume_ == 0.0; }
  /// m^3, and the sum of volume times place, from the tip along the axes of the tool as the hand has not
  /// turned it [m^4].
  double volume() const { return volume_; }
  const Eigen::Vector3d& moment() const { return moment_; }
  /// The tool may have been turned: the sand goes with it. Call it whenever the tool was placed.
  void lie_on(const UpperSide& upper);
  /// Over each cell of the upper side [m].
  const HeightGrid& thickness() const { return thickness_; }

  /// What is seen of it.
  LoadSurface surface(const UpperSide& upper) const;

  /// Takes up what the tool lifted.
  void take(const UpperSide& upper, const std::vector<LiftedSand>& lifted);

  /// Sand that left the tool, over one cell of the bed.
  struct Spill {
    int row, col;
    double volume;  ///< m^3
    double from;    ///< m, the height from which it falls
  };
  struct Outcome {
    std::vector<Spill> spills = {};  ///< with what only moved beside the tool
    double spilled = 0.0;            ///< m^3, that the tool lost
    double ran_on = 0.0;             ///< m^3, that it gained
  };
  /// Brings it to rest on the tool with its tip here [m]. Takes what runs on from the bed, which must
  /// not be a wall there; does not give it the spills.
  Outcome relax(const UpperSide& upper, HeightField& bed, const Eigen::Vector3d& tip);

  void visit_state(StateVisitor& state);
  /// After a state was put back: the upper side is as it was then.
  void go_on(const UpperSide& upper);

 private:
  /// A cell beside the tool: the cells of the bed around its middle.
  struct Beside {
    int row, col;  // of the grid
    struct {
      int row, col;
      double part;
    } bed[4];
    int count;
    double start;  // m above the tip, of the sand there
    double rim;    // m above the tip, of the tool beside it
  };
  using Cells = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  void lay_out(const UpperSide& upper);
  void look_beside(const UpperSide& upper, const HeightField& bed, const Eigen::Vector3d& tip);
  bool sand_may_run_on() const;
  void set_walls(const UpperSide& upper);
  void change_columns();
  std::size_t nearest_of(const std::vector<double>& parts, std::size_t cell) const;
  void know_sums(const UpperSide& upper);
  void know_shares(const UpperSide& upper);
  double take_from_bed(HeightField& bed, const Beside& one, double height) const;

  RelaxationSettings relaxation_;
  // By cell as the tool is turned; by column, and over which cells these are, since it was turned so. What
  // changed on the tool in between goes to the columns only when it is turned on: sand that lies still on a
  // tool that tilts is never averaged.
  HeightGrid thickness_, columns_, from_columns_;
  std::vector<UpperSide::Share> shares_;  // empty: the tool is not tilted, or carries nothing
  double volume_ = 0.0;
  Eigen::Vector3d moment_ = Eigen::Vector3d::Zero();
  // As the tool is turned now:
  int lies_on_ = -1;  // the revision of the upper side
  bool is_laid_out_ = false;
  HeightField tray_;  // m above the tip: the sand on the tool, and beside it
  Copied<Relaxer> relaxer_;
  std::vector<Beside> beside_;
  double deep_ = 0.0;  // m above the tip: there is all sand beside the tool that is far below its rim
  Cells free_;         // all others are walls
};

}  // namespace sandstroke
