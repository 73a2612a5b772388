#pragma once

#include <limits>
#include <vector>

#include "core/aligned_vector.h"
#include "core/copied.h"
#include "sand/height_field.h"

namespace sandstroke {

/// A window of cells under and around a tool at a sub-cell position: the sand there, and what each cell is to
/// the tool. The window has rows x cols cells, stored row after row, `stride` doubles apart (whole groups;
/// entries beyond cols have no weight). Moving it reuses the memory.
class ToolFootprint {
 public:
  /// Distances from the tool's axis [cells].
  struct Extent {
    double left, right, down, up;
  };
  /// Puts the tool's axis at (x, y) [m]. The window is empty until open().
  void set_axis(const BedGeometry& bed, double x, double y);
  /// Extends the window over the bed's cells within `extent`, and reads the sand there. Cells outside the
  /// bed, or beyond its wall, are left out. False if no cell is left.
  bool open(const HeightField& bed, const Extent& extent);
  /// Empties the window.
  void close() {
    cells_ = {};
    highest_floor_ = -std::numeric_limits<double>::infinity();
  }

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
  [[gnu::always_inline]] ColumnRange sand_cols(int row) const {  // each kernel asks it of each row
    const ColumnRange sand = bed_.sand_cols(cells_.row_begin + row);
    return {std::max(sand.begin - cells_.col_begin, 0),
            std::min(sand.end, cells_.col_end) - cells_.col_begin};
  }

  // Data of a row of the window. The functions in footprint_kernels.h fill in what each cell is to the tool.
  double* heights(int row) { return heights_.data() + at(row); }  ///< m, of the sand
  const double* heights(int row) const { return heights_.data() + at(row); }
  /// The floor under the sand [m]; only where highest_floor() is finite.
  const double* floors(int row) const { return floors_.data() + at(row); }
  /// The highest floor in the window [m]; -infinity: the sand is as deep as may be.
  double highest_floor() const { return highest_floor_; }
  /// The tool's underside above its tip [m]; infinite outside the bowl.
  double* underside(int row) { return underside_.data() + at(row); }
  const double* underside(int row) const { return underside_.data() + at(row); }
  /// 1 where there is sand outside the bowl; elsewhere 0.
  double* takes(int row) { return takes_.data() + at(row); }
  const double* takes(int row) const { return takes_.data() + at(row); }
  /// Positive filter sin(u) - 0.53; 0 outside the ring (u0 < u <= u1). Filled by a sphere's ring only.
  double* ring_weight(int row) { return ring_weight_.data() + at(row); }
  const double* ring_weight(int row) const { return ring_weight_.data() + at(row); }
  // Data of one displacement: the weight of each cell in the deposit, the sand that was carved out of each
  // flagged cell [m], and a flag for each cell whose height was changed here (a byte per group).
  double* weights(int row) { return weights_.data() + at(row); }
  double* excess(int row) { return excess_.data() + at(row); }
  unsigned char* flags(int row) { return flags_.data() + at(row) / cells_per_group; }

  /// Reads the sand again, from the bed that the window lies on.
  void read_heights(const HeightField& bed);
  /// Writes the heights of the flagged cells to the bed.
  void write_flagged(HeightField& bed);
  /// Makes the cells of the bowl (finite underside), and no others, walls of the bed
  /// (HeightField::set_tool_walls).
  void make_walls(HeightField& bed);

 private:
  std::size_t at(int row) const { return static_cast<std::size_t>(row) * stride_; }
  void make_room();
  void read_floors(const HeightField& bed);

  BedGeometry bed_{1, 1, 1.0};
  CellRange cells_;
  int stride_ = 0;
  double axis_x_ = 0.0, axis_y_ = 0.0, first_x_ = 0.0, first_y_ = 0.0;
  std::size_t room_ = 0;
  AlignedVector<double> heights_, underside_, takes_, excess_;
  Scratch<AlignedVector<double>> ring_weight_, weights_;             // from open() to the displacement there
  double highest_floor_ = -std::numeric_limits<double>::infinity();  // m
  AlignedVector<double> floors_;                                     // as large as others, where there is one
  AlignedVector<unsigned char> flags_;
  std::vector<RowCells> bowl_;  // buffer of make_walls()
};

}  // namespace sandstroke
