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

/// What a footprint is computed from.
struct FootprintShape {
  ToolProfile profile;
  double radius;         ///< m
  double filter_scale2;  ///< m^2, s^2: u = rho^2 / s^2
  double amplitude;      ///< m, a: the bowl has the sphere's curvature at the tip
  double reach;          ///< m, rho1 = s sqrt(u1)
};

/// Where a window of cells lies in a tool's envelope: the samples around its first cell, and how near they
/// are. Corners: lower left, lower right, upper left, upper right.
struct EnvelopePlace {
  const double* underside[4];
  const double* cover[4];
  double weight[4];
  int stride;
};
/// Where sand of a window's cells leaves the tool.
struct WayOutPlace {
  const double *x, *y;  ///< of its first cell [cells]
  int stride;
  /// Of a cell at (x, y) from the axis [cells]; not a number: nowhere.
  void aim(int row, int col, double at_x, double at_y, double& to_x, double& to_y) const {
    const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(row) * stride + col;
    const bool goes = x[i] != 0.0 || y[i] != 0.0;
    to_x = goes ? at_x + x[i] : std::numeric_limits<double>::quiet_NaN();
    to_y = at_y + y[i];
  }
};

/// The cells under and around a tool at a sub-cell position: the sand there, and what each cell means to the
/// tool. A window of rows x cols cells, kept row after row, `stride` doubles apart (whole groups; what
/// lies beyond cols has no weight). Placing it again reuses the memory.
class ToolFootprint {
 public:
  /// Needs radius > 0; a mesh that was read.
  explicit ToolFootprint(const ToolSettings& settings);

  /// Turns the tool [its frame in the bed], unless it would not turn. Seen at the next place(), before which
  /// the window is empty.
  void turn(const Eigen::Matrix3d& rotation);
  /// False of a sphere, and of what moves no point of the tool by an eighth of a sample's distance.
  bool would_turn(const Eigen::Matrix3d& rotation) const;
  /// m, of its points from the tip; of a sphere 0.
  double farthest() const { return farthest_; }
  bool is_sphere() const { return surface_.vertices.empty(); }

  /// Moves the tool's axis to (x, y) [m] and reads the sand there. Cells outside the bed, or beyond its wall,
  /// are left out. Error: input, where a tool other than the sphere is too thin or too large for the cells.
  void place(const HeightField& bed, double x, double y);

  /// The window, in cells of the bed; empty where the tool is outside it.
  const CellRange& cells() const { return cells_; }
  int stride() const { return stride_; }
  // In cells from the bed's centre, so that a tool means the same bits on a bed of any size: its axis, and
  // the window's first cell.
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

  /// Mean height [m] under the footprint (u <= u1 in full, fading out within a cell around it, so that it
  /// changes continuously as the tool moves). Displacement moves sand only where the weight is 1: it does not
  /// change the level. NaN where the footprint lies outside the bed. Of any tool but the sphere: of the plane
  /// around it, at its axis.
  double sand_level() const { return level_; }
  /// Of the cells that lie within one of a sphere's rim, beside it [m]; -infinity where there are none.
  double highest_at_rim() const;
  /// Its lowest point above its tip [m].
  double lowest() const { return envelope_ ? envelope_->lowest() : 0.0; }

  /// Reads the sand again, from the bed that it was placed on.
  void read_heights(const HeightField& bed);
  const FootprintShape& shape() const { return shape_; }

  // Row r of the window. What a cell means to the tool is found out by whoever needs it
  // (footprint_kernels.h).
  double* heights(int row) { return heights_.get() + at(row); }  ///< m, of the sand
  const double* heights(int row) const { return heights_.get() + at(row); }
  /// Tool's underside above its tip [m]; infinite outside the bowl (u <= u0).
  double* underside(int row) { return underside_.get() + at(row); }
  const double* underside(int row) const { return underside_.get() + at(row); }
  /// 1 where there is sand outside the bowl; elsewhere 0.
  double* takes(int row) { return takes_.get() + at(row); }
  const double* takes(int row) const { return takes_.get() + at(row); }
  /// Positive filter sin(u) - 0.53; 0 outside the ring (u0 < u <= u1).
  double* rampart(int row) { return rampart_.get() + at(row); }
  const double* rampart(int row) const { return rampart_.get() + at(row); }
  // Of one displacement (displace): the ring's share of each cell, and a flag for each cell whose height was
  // changed here (a group to a byte), which write_flagged then writes to the bed.
  double* weights(int row) { return weights_.get() + at(row); }
  unsigned char* flags(int row) { return flags_.get() + at(row) / cells_per_group; }
  void write_flagged(HeightField& bed);
  /// m, the sand that carve() took out of the flagged cells.
  double* excess(int row) { return excess_.get() + at(row); }

  /// Fills underside() and takes() without cutting, the tip at `tip_height` [m]; the window is not empty, and
  /// lies on the bed as it is now.
  void meet(const HeightField& bed, double tip_height);

  // --- any tool but the sphere (!is_sphere()), where the window is not empty ---
  /// Cuts the sand to its underside, the tip at `tip_height` [m]; what was taken out [m]. What of it counts
  /// as covered goes up from its lowest point to twice its depth, and wherever it touched sand: an overhang
  /// far above the sand holds none off.
  double carve(double tip_height);
  /// Sand reached its underside in the last carve().
  bool touches() const { return touches_; }
  /// The same, without cutting.
  void stand(double tip_height);
  /// Of the tool as it is turned and placed: makes all that way_out() may be asked for.
  void make_ways_out(double distance) {
    if (envelope_) envelope_->make_ways_out(distance);
  }
  /// Where sand goes from there, to (distance - 1) inradii beyond the edge.
  WayOutPlace way_out(double distance);

  /// The bed holds the cells of the bowl, and no others (HeightField::hold). Of any tool but
  /// the sphere: what it covered when it carved or stood last.
  void hold_bowl(HeightField& bed);

  /// m, of the sphere; of any other tool of the largest circle in its footprint: how far it may go before
  /// what it left is no furrow.
  double radius() const { return shape_.radius; }
  /// rho1 = s sqrt(u1) [m]: how far the footprint reaches.
  double reach() const { return shape_.reach; }

 private:
  std::size_t at(int row) const { return static_cast<std::size_t>(row) * stride_; }
  void make_room();
  void take_window();
  void place_envelope(const HeightField& bed);
  /// The sample at the window's first cell (row, column), from the envelope's first, and what is left to it.
  void find_first_sample();
  EnvelopePlace envelope_place() const;
  double covered_height(double tip_height, double touched) const;

  FootprintShape shape_;
  TriangleMesh surface_;  // of any tool but the sphere
  Eigen::Matrix3d rotation_;
  double farthest_ = 0.0;  // m, of its points from the tip
  std::optional<ToolEnvelope> envelope_;
  int sample_row_ = 0, sample_col_ = 0;
  double sample_y_ = 0.0, sample_x_ = 0.0;
  bool touches_ = false;
  double covered_ = 0.0;  // m above the tip: what of the tool is no higher covers cells
  BedGeometry bed_{1, 1, 1.0};
  CellRange cells_;
  int stride_ = 0;
  double axis_x_ = 0.0, axis_y_ = 0.0, first_x_ = 0.0, first_y_ = 0.0, level_;
  std::size_t room_ = 0;
  hwy::AlignedFreeUniquePtr<double[]> heights_, underside_, takes_, rampart_, weights_, excess_;
  std::vector<RowCells> bowl_;  // while it is handed over
  hwy::AlignedFreeUniquePtr<unsigned char[]> flags_;
};

}  // namespace sandstroke
