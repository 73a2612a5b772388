#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "tool/triangle_mesh.h"

namespace sandstroke {

/// Where sand leaves a tool: how far [cells] and where to, for the samples of a phase that a part of the tool
/// covers.
struct WayOut {
  std::vector<double> x, y;  ///< laid out like a phase of samples; both 0 if no edge is nearest
};

/// The underside of a tool that does not turn: the lowest height of its surface above every point, on a grid
/// of `phases` samples per cell and direction. Samples are stored phase by phase, so that the cells of a bed,
/// wherever the tool is, read neighbouring numbers. A tool counts as solid from its underside up: it also
/// displaces sand on top of an overhang.
class ToolEnvelope {
 public:
  /// surface: already turned, tip at the origin [m]. Error: input, if it covers no sample, or too many.
  ToolEnvelope(const TriangleMesh& surface, double cell_size);

  double cell_size() const { return cell_size_; }
  int phases() const { return phases_; }
  /// The grid of the samples, in cells of the bed from the tip's: first and number. It reaches beyond the
  /// footprint by three cells and by the way that displaced sand goes.
  int first_col() const { return first_col_; }
  int first_row() const { return first_row_; }
  int cols() const { return cols_; }
  int rows() const { return rows_; }
  /// Distance from a row to the next in the samples of a phase. Whole groups may be read from any of cols().
  int stride() const { return stride_; }
  /// Index of the sample that lies `phase_x` samples right of and `phase_y` above the lower left corner of a
  /// grid cell.
  std::size_t at(int row, int col, int phase_y, int phase_x) const {
    return (static_cast<std::size_t>(phase_y * phases_ + phase_x) * static_cast<std::size_t>(rows_) +
            static_cast<std::size_t>(row)) *
               static_cast<std::size_t>(stride_) +
           static_cast<std::size_t>(col);
  }
  /// m above the tip; beside the footprint the same as at its edge.
  const double* underside() const { return underside_.data(); }
  /// 1 under the tool, else 0. The tool's edge is where the value interpolated between samples is 1/2.
  const double* cover() const { return cover_.data(); }
  double lowest() const { return lowest_; }      ///< m above the tip, of the underside
  double highest() const { return highest_; }    ///< m
  double reach() const { return reach_; }        ///< m, from the axis, of the footprint
  double inradius() const { return inradius_; }  ///< m, of the largest circle in the footprint

  /// The ways from the samples of one phase to the nearest edge of the part of the footprint that is no
  /// higher than `height` [m above the tip], and beyond the edge by (distance - 1) times that part's
  /// inradius, at least half a cell. A position of the tool needs only one phase. Computed when first asked
  /// for.
  const WayOut& way_out(double height, double distance, int phase_y, int phase_x);
  /// Computes all ways out for that distance, so that way_out() then takes neither time nor memory.
  void make_ways_out(double distance);
  /// Rounds a height up to one of a few levels. Only for these are ways out computed.
  double covered_height(double height) const;

 private:
  void rasterise(const TriangleMesh& surface);
  void draw_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
  void continue_beyond_edge();
  int sample_cols() const { return cols_ * phases_; }
  int sample_rows() const { return rows_ * phases_; }
  std::size_t at_sample(int row, int col) const {
    return rows_at_[static_cast<std::size_t>(row)] + cols_at_[static_cast<std::size_t>(col)];
  }
  /// Flags the covered samples that are no higher than `height`, row after row.
  std::vector<unsigned char> covered_up_to(double height) const;
  /// How far each sample lies inside a part of the footprint, and the deepest [samples].
  struct Part {
    std::vector<double> inside;
    double deepest;
  };
  WayOut make_way_out(const Part& part, double distance, int phase_y, int phase_x) const;

  double cell_size_;
  int phases_ = 4;
  int first_col_ = 0, first_row_ = 0, cols_ = 0, rows_ = 0, stride_ = 0;
  double lowest_ = 0.0, highest_ = 0.0, reach_ = 0.0, inradius_ = 0.0;
  std::vector<std::size_t> rows_at_, cols_at_;  // at() of a sample's row, and what its column adds
  std::vector<double> underside_, cover_;
  std::map<double, Part> parts_;                             // by covered height
  std::map<std::tuple<double, int, int>, WayOut> ways_out_;  // by covered height and phase
};

}  // namespace sandstroke
