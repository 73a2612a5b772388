#pragma once

#include <Eigen/Core>

#include "rules/filter.h"
#include "rules/talus.h"

namespace sandstroke {

/// Where the sand goes that the tool takes out: onto the whole ring around it (as published), onto the ring's
/// part ahead of the motion, or straight outward, whatever the motion, so that noise in the motion turns
/// nothing.
enum class Deposit { ring, ahead, outward };

struct DisplacementSettings {
  Deposit deposit = Deposit::ring;
  /// outward: how far from the axis, in tool radii. The distance hardly matters: with small cells 1.05
  /// and 1.15 come within 0.7 % of the moved sand of each other, 1.25 within 3 % (bench: stroke-accurate).
  double distance = 1.2;
};

/// The paper's two passes (section 3.1) of a sphere at one position, cell by cell. The first takes out the
/// sand that stands above the tool's underside; its volume is V. The second deposits V: on the ring, each
/// cell getting its part in proportion to the positive filter, or outward.
class PlainDisplacement {
 public:
  /// The tool's axis stands at (x, y) [m] from the middle of the bed; its cells are cell_size [m] large. Sand
  /// neither leaves nor gets into walls.
  PlainDisplacement(ToolProfile profile, double radius, const WallGrid& walls, double cell_size, double x,
                    double y);

  /// Mean height [m] of the sand under the tool and its ring, whose weight fades out within a cell; not a
  /// number where there is none. The tip's depth counts from here.
  double sand_level(const HeightGrid& heights) const;
  /// Mean height [m], over the same cells, by which the floor stands above the tip: there is no sand there
  /// for the tip to be deep in.
  double floor_above(const HeightGrid& floor, double tip_height) const;
  /// Displaces with the tip at tip_height [m], reached by `motion` [m]. Returns V [m^3]. floor [m], if there
  /// is one: no sand is below it, and it stays where it is. None is put where it is above the tool's rim.
  double displace(HeightGrid& heights, double tip_height, const Eigen::Vector3d& motion,
                  const DisplacementSettings& settings, const HeightGrid* floor = nullptr) const;
  /// The tool is above the cell.
  bool covers(int row, int col) const { return filter::is_negative(u(row, col)); }

 private:
  template <class Visit>
  void for_cells(const Visit& visit) const;
  template <class Height>
  double mean_under(const Height& height_of) const;
  double x_of(int col) const { return (col - col_origin_ - axis_x_) * cell_size_; }
  double y_of(int row) const { return (row - row_origin_ - axis_y_) * cell_size_; }
  double rho2(int row, int col) const;
  double u(int row, int col) const { return filter::u_of(rho2(row, col), radius_); }
  double fraction_ahead(int row, int col, const Eigen::Vector3d& motion) const;
  template <class IsOpen>
  HeightGrid spread_outward(const HeightGrid& excess, double taken, double distance,
                            const IsOpen& is_open) const;

  ToolProfile profile_;
  double radius_;  // m
  const WallGrid& walls_;
  double cell_size_;
  double row_origin_, col_origin_;  // the bed's middle, in cells
  double axis_x_, axis_y_;          // cells from there
  // The cells within the ring's reach, and one around.
  int row_begin_ = 0, row_end_, col_begin_ = 0, col_end_;
};

}  // namespace sandstroke
