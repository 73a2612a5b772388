#pragma once

#include "sand/displacement.h"

namespace sandstroke {

/// A tool at a place, and what it does to sand, as the paper writes it down (3.1), cell by cell: the oracle
/// for ToolFootprint and displace, which give the same bits. It shares no loop and no formula with them.
class DisplacementReference {
 public:
  /// The tool's axis stands at (x, y) [m].
  DisplacementReference(const ToolSettings& tool, const BedGeometry& bed, double x, double y);

  bool in_bowl(int row, int col) const;
  /// m; not-a-number where no sand is under the tool.
  double sand_level(const HeightField& sand) const;
  /// As sandstroke::displace; returns the volume moved [m^3].
  double displace(HeightField& sand, double tip_height, const Eigen::Vector3d& motion,
                  const DisplacementSettings& settings) const;

 private:
  double x_of(int col) const { return (bed_.cols_from_centre(col) - axis_x_) * bed_.cell_size(); }
  double y_of(int row) const { return (bed_.rows_from_centre(row) - axis_y_) * bed_.cell_size(); }
  double rho2(int row, int col) const;
  double u(int row, int col) const;
  double underside(int row, int col) const;
  double positive_filter(int row, int col) const;
  HeightGrid outward(const HeightGrid& excess, double pushed, double distance) const;

  ToolSettings tool_;
  BedGeometry bed_;
  double axis_x_, axis_y_;  // cells from the bed's centre
  CellRange cells_;         // those within rho1 + dx of the axis, along x and along y
};

}  // namespace sandstroke
