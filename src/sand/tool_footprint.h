#pragma once

#include <hwy/aligned_allocator.h>

#include <optional>
#include <vector>

#include "rules/filter.h"
#include "sand/height_field.h"
#include "sand/sand_plane.h"
#include "sand/tool_envelope.h"
#include "tool/tool_settings.h"

namespace sandstroke {

/// The parameters of a footprint.
struct FootprintShape {
  ToolProfile profile;
  double radius;         ///< m
  double filter_scale2;  ///< m^2, s^2: u = rho^2 / s^2
  double amplitude;      ///< m, a: the bowl has the sphere's curvature at the tip
  double reach;          ///< m, rho1 = s sqrt(u1)
};

/// The place of a window of cells in a tool's envelope: the four samples around the window's first cell, and
/// their weights. Corners: lower left, lower right, upper left, upper right.
struct EnvelopePlace {
  const double* underside[4];
  const double* cover[4];
  double weight[4];
  int stride;
};
/// The ways on which the sand of a window's cells leaves the tool.
struct WayOutPlace {
  const double *x, *y;  ///< of the window's first cell [cells]
  int stride;
  /// Computes where the sand of a cell at (at_x, at_y) goes, from the axis [cells]; NaN: nowhere.
  void aim(int row, int col, double at_x, double at_y, double& to_x, double& to_y) const {
    const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(row) * stride + col;
    const bool goes = x[i] != 0.0 || y[i] != 0.0;
    to_x = goes ? at_x + x[i] : std::numeric_limits<double>::quiet_NaN();
    to_y = at_y + y[i];
  }
};

/// The cells under and around a tool at a sub-cell position: the sand there, and what each cell is to the
/// tool. They form a window of rows x cols cells, stored row after row, `stride` doubles apart (whole groups;
/// entries beyond cols have no weight). Placing it again reuses the memory.
class ToolFootprint {
 public:
  /// Needs radius > 0, and a mesh that has been read.
  explicit ToolFootprint(const ToolSettings& settings);

  /// Sets the rotation of the tool's frame in the bed, if would_turn(). It takes effect at the next place();
  /// until then the window is empty.
  void turn(const Eigen::Matrix3d& rotation);
  /// False for a sphere, and if no point of the tool would move by an eighth of the distance between samples.
  bool would_turn(const Eigen::Matrix3d& rotation) const;
  /// Distance of the farthest point from the tip [m]; 0 for a sphere.
  double farthest() const { return farthest_; }
  bool is_sphere() const { return surface_.vertices.empty(); }

  /// Moves the tool's axis to (x, y) [m] and reads the sand there. Cells outside the bed, or beyond its wall,
  /// are left out. Error: input, if a tool other than the sphere is too thin or too large for the cells.
  void place(const HeightField& bed, double x, double y);

  /// The window, in cells of the bed; empty where the tool is outside it.
  const CellRange& cells() const { return cells_; }
  int stride() const { return stride_; }
  // The tool's axis and the window's first cell, in cells from the bed's centre, so that a tool has the same
  // bits on a bed of any size.
  double axis_x() const { return axis_x_; }
  double axis_y() const { return axis_y_; }
  double first_x() const { return first_x_; }
  double first_y() const { return first_y_; }
  double cell_size() const { return bed_.cell_size(); }
  /// The columns of a row of the window that have sand.
  ColumnRange sand_cols(int row) const {
    const ColumnRange sand = bed_.sand_cols(cells_.row_begin + row);
    return {std::max(sand.begin - cells_.col_begin, 0),
            std::min(sand.end, cells_.col_end) - cells_.col_begin};
  }

  /// Mean height [m] of the sand under the footprint. Cells with u <= u1 count in full; the weight fades out
  /// within a cell around them, so that the level changes continuously as the tool moves. Displacement moves
  /// sand only where the weight is 1, so it does not change the level. NaN if the footprint lies outside the
  /// bed. For any tool but the sphere: height, at the axis, of the plane around the tool.
  double sand_level() const { return level_; }
  /// The highest sand in the cells within one cell outside a sphere's rim [m]; -infinity if there are none.
  double highest_at_rim() const;
  /// Height of the tool's lowest point above its tip [m].
  double lowest() const { return envelope_ ? envelope_->lowest() : 0.0; }

  /// Reads the sand again, from the bed that it was placed on.
  void read_heights(const HeightField& bed);
  const FootprintShape& shape() const { return shape_; }

  // Data of a row of the window. The functions in footprint_kernels.h fill in what each cell is to the tool.
  double* heights(int row) { return heights_.get() + at(row); }  ///< m, of the sand
  const double* heights(int row) const { return heights_.get() + at(row); }
  /// The tool's underside above its tip [m]; infinite outside the bowl (u <= u0).
  double* underside(int row) { return underside_.get() + at(row); }
  const double* underside(int row) const { return underside_.get() + at(row); }
  /// 1 where there is sand outside the bowl; elsewhere 0.
  double* takes(int row) { return takes_.get() + at(row); }
  const double* takes(int row) const { return takes_.get() + at(row); }
  /// Positive filter sin(u) - 0.53; 0 outside the ring (u0 < u <= u1).
  double* ring_weight(int row) { return ring_weight_.get() + at(row); }
  const double* ring_weight(int row) const { return ring_weight_.get() + at(row); }
  // Data of one displacement (displace): the weight of each cell in the deposit, and a flag for each cell
  // whose height was changed here (a byte per group). write_flagged writes the flagged cells to the bed.
  double* weights(int row) { return weights_.get() + at(row); }
  unsigned char* flags(int row) { return flags_.get() + at(row) / cells_per_group; }
  void write_flagged(HeightField& bed);
  /// Sand that carve() took out of each flagged cell [m].
  double* excess(int row) { return excess_.get() + at(row); }

  /// Fills underside() and takes() without carving, for a tip at `tip_height` [m]. The window must not be
  /// empty, and must lie on the bed as it is now.
  void meet(const HeightField& bed, double tip_height);

  // --- for any tool but the sphere (!is_sphere()), if the window is not empty ---
  /// Carves the sand to the tool's underside, for a tip at `tip_height` [m]. Returns the sum of heights taken
  /// out [m]. The tool covers cells only from its lowest point up to twice its depth, or up to its highest
  /// contact if that is higher. A high overhang covers none.
  double carve(double tip_height);
  /// Whether sand reached the underside in the last carve().
  bool touches() const { return touches_; }
  /// Finds the covered part without carving, as if no sand touched the tool.
  void stand(double tip_height);
  /// Computes all ways out of the tool as it is turned and placed, so that way_out() need not.
  void make_ways_out(double distance) {
    if (envelope_) envelope_->make_ways_out(distance);
  }
  /// The ways of the sand from the covered cells, to (distance - 1) inradii beyond the edge.
  WayOutPlace way_out(double distance);

  /// Makes the cells of the bowl, and no others, walls of the bed (HeightField::hold). For any tool but the
  /// sphere: the cells that it covered when it last carved or stood.
  void hold_bowl(HeightField& bed);

  /// Radius [m] of the sphere, or of the largest circle in any other tool's footprint. A tool that moves
  /// farther than this at once leaves no furrow.
  double radius() const { return shape_.radius; }
  /// rho1 = s sqrt(u1) [m]: how far the footprint reaches.
  double reach() const { return shape_.reach; }

 private:
  std::size_t at(int row) const { return static_cast<std::size_t>(row) * stride_; }
  void make_room();
  void take_window();
  void place_envelope(const HeightField& bed);
  /// Finds the sample at the window's first cell (row, column), counted from the envelope's first, and the
  /// remaining distance to it.
  void find_first_sample();
  EnvelopePlace envelope_place() const;
  double covered_height(double tip_height, double touched) const;

  FootprintShape shape_;
  TriangleMesh surface_;  // of any tool but the sphere
  Eigen::Matrix3d rotation_;
  double farthest_ = 0.0;  // m, of the farthest point from the tip
  std::optional<ToolEnvelope> envelope_;
  int sample_row_ = 0, sample_col_ = 0;
  double sample_y_ = 0.0, sample_x_ = 0.0;
  bool touches_ = false;
  double covered_ = 0.0;  // m above the tip: parts of the tool up to here cover cells
  BedGeometry bed_{1, 1, 1.0};
  CellRange cells_;
  int stride_ = 0;
  double axis_x_ = 0.0, axis_y_ = 0.0, first_x_ = 0.0, first_y_ = 0.0, level_;
  std::size_t room_ = 0;
  hwy::AlignedFreeUniquePtr<double[]> heights_, underside_, takes_, ring_weight_, weights_, excess_;
  std::vector<RowCells> bowl_;  // buffer of hold_bowl()
  hwy::AlignedFreeUniquePtr<unsigned char[]> flags_;
};

}  // namespace sandstroke
