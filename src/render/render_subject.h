#pragma once

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "picture/view.h"
#include "render/colour_map.h"
#include "sand/height_field.h"
#include "tool/triangle_mesh.h"

namespace sandstroke {

/// The tool as it is drawn: a sphere whose lowest point is the tip, or a mesh.
struct ToolBody {
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();       ///< m
  double radius = 0.01;                                ///< m
  std::shared_ptr<const TriangleMesh> mesh = nullptr;  ///< turned, with the tip at the origin; null: a sphere
  std::shared_ptr<const TriangleMesh> load = nullptr;  ///< the sand on it, likewise; null: none
  Eigen::Vector3d centre() const { return tip + radius * Eigen::Vector3d::UnitZ(); }
  Eigen::AlignedBox3d box() const;  ///< m
  bool operator==(const ToolBody&) const = default;
};

/// Ends of a colour scale [m].
struct ValueRange {
  double low = 0.0, high = 1.0;
};

/// Heights of the surface that a bed started from [m]. Box and camera follow from these, and not from what
/// the sand did since, so that pictures of one scene can be laid over one another.
struct StartHeights {
  double lowest = 0.0, highest = 0.0;
  double border = 0.0;  ///< the highest along the bed's border
  bool operator==(const StartHeights&) const = default;
};
StartHeights start_heights(const HeightField& surface);

/// Everything that a picture shows besides the surface.
struct RenderSubject {
  ViewSettings view;
  CellRange focus;  ///< what the view `stroke` frames; empty = the whole bed
  std::optional<ToolBody> tool;
  const HeightGrid* difference = nullptr;  ///< m, the colours of style difference; of the bed's shape
  std::optional<ValueRange> range;         ///< of the colours; else that of the values shown
  std::optional<StartHeights> start;       ///< else those of the surface itself
  std::optional<BedShape> shape;           ///< else that of the surface itself
  double contour_interval = 0.0;           ///< m; 0 = a round one that gives about a dozen lines
  bool box = true;                         ///< the wall around the bed
  double crumbs = 0.0;  ///< the slope (rise over run) at which moist sand lies in crumbs; 0: it is dry
  std::optional<std::array<double, 3>> background;  ///< sRGB in [0, 1], instead of the sky
  std::vector<int> tile_levels;  ///< level of detail of each tile; empty = by its size in the picture
};

/// The cells that a close-up of a stroke frames: those of `focus` (of the whole bed where it is empty), grown
/// by a twentieth and at least by `margin` [m], cut to the bed.
CellRange framed_cells(const CellRange& focus, int rows, int cols, double cell_size, double margin);

/// The cells under a tool [radius, m] at those of the positions `tips` that are below `highest` [m]; empty
/// where there is none. A stroke covers these cells, whatever the sand then does.
CellRange cells_under(const std::vector<Eigen::Vector3d>& tips, double radius, const BedGeometry& bed,
                      double highest);

/// The box [m] over the centres of cells, between two heights.
Eigen::AlignedBox3d box_over(const BedGeometry& bed, const CellRange& cells, double lowest, double highest);

/// The colour scale of values without a given range. It goes from the least to the greatest. It is symmetric
/// about zero if it is diverging, and one millimetre wide where all values are equal.
ValueRange value_range(double least, double greatest, ColourScale scale);

}  // namespace sandstroke
