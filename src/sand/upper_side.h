#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

#include "rules/talus.h"
#include "sand/bed_geometry.h"
#include "tool/triangle_mesh.h"

namespace sandstroke {

/// Sand that a tool lifts out of the bed: a height of sand over a place, from the tip on the bed's axes.
struct LiftedSand {
  Eigen::Vector2d from_tip;  ///< m
  double height;             ///< m, over a cell of the bed
};

/// The upper side of a tool, on which sand lies: its highest point over each cell of a grid whose middle is
/// the tip, and which turns about the vertical with the hand. Sand goes with the tool in upright columns, one
/// over each cell that the tool covers before the hand tilts it. A tilted tool's columns lie over other
/// cells, and over fewer of them.
class UpperSide {
 public:
  static constexpr double nowhere = -std::numeric_limits<double>::infinity();
  /// Cells of the grid beside the tool, at least.
  static constexpr int margin = 2;

  /// surface: turned by the tool's own orientation, its tip at the origin [m]. Error: input, where a part of
  /// it hangs over another part, or where it covers too many cells.
  UpperSide(const TriangleMesh& surface, double cell_size);

  /// The hand has turned the tool so, from its own orientation.
  void turn(const Eigen::Matrix3d& hand);
  const BedGeometry& grid() const { return grid_; }
  bool is_tilted() const { return tilted_; }
  /// Changes whenever top() does.
  int revision() const { return tilted_ ? tilts_ : 0; }
  /// The highest points [m above the tip]; nowhere beside the tool.
  const HeightGrid& top() const { return tilted_ ? tilted_top_ : own_top_; }
  bool covers(int row, int col) const { return top()(row, col) != nowhere; }

  /// From the tip, along the bed's axes or the grid's [m].
  Eigen::Vector2d in_grid(const Eigen::Vector2d& in_bed) const {
    return {cos_ * in_bed.x() + sin_ * in_bed.y(), cos_ * in_bed.y() - sin_ * in_bed.x()};
  }
  Eigen::Vector2d in_bed(const Eigen::Vector2d& in_grid) const {
    return {cos_ * in_grid.x() - sin_ * in_grid.y(), sin_ * in_grid.x() + cos_ * in_grid.y()};
  }
  /// From the tip, along the axes of the tool as the hand has not turned it, and along the bed's [m].
  Eigen::Vector3d turned(const Eigen::Vector3d& own) const;
  /// From the tip along the axes of the grid [m], along those of the tool as the hand has not turned it.
  Eigen::Vector3d untilted(const Eigen::Vector3d& in_grid) const {
    return tilted_ ? Eigen::Vector3d(tilt_.transpose() * in_grid) : in_grid;
  }

  /// The covered cell that is nearest to a place of the grid [m]. Both -1: there is none within two cells.
  struct Cell {
    int row, col;
  };
  Cell cell_at(const Eigen::Vector2d& in_grid) const;
  /// The cells, as row * cols + col, onto which sand at a place of the grid goes that lies on the tool at
  /// this height above the tip [m], and the part of it that each gets: of the four around it those of that
  /// height, so that none goes onto a wall beside it or from there; or else one near by.
  struct Part {
    int cell;
    double part;
  };
  struct Parts {
    std::array<Part, 4> of;
    int count = 0;
  };
  Parts parts_at(const Eigen::Vector2d& in_grid, double height) const;

  /// A part of a column that lies over a cell; both as row * cols + col.
  struct Share {
    int column, cell;
    double part;
  };
  /// The parts of all columns of a tilted tool, each of which adds up to 1, in the order of the columns.
  std::vector<Share> shares() const;

 private:
  HeightGrid highest_points(const TriangleMesh& surface) const;
  Cell nearest(const Eigen::Vector2d& place, double height) const;
  Cell nearest_within(int reach, int at_row, int at_col, const Eigen::Vector2d& place, double height) const;

  TriangleMesh surface_;
  BedGeometry grid_;
  double cos_ = 1.0, sin_ = 0.0;                        // of the hand's turn about the vertical
  Eigen::Matrix3d tilt_ = Eigen::Matrix3d::Identity();  // the rest of its turn
  bool tilted_ = false;
  int tilts_ = 0;  // so far
  HeightGrid own_top_, tilted_top_;
};

}  // namespace sandstroke
