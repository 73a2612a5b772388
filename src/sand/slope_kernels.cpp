#include "sand/slope_kernels.h"

#include <bit>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sand/slope_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sand/face_flow-inl.h"
#include "sand/face_flow_on_ground-inl.h"
#include "sand/law_on_ground-inl.h"
#include "sand/slopes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sandstroke {
namespace HWY_NAMESPACE {

constexpr int groups = side / group;

/// The largest drops of a group's cells on a ground, as if T were the law's; by `paper`, as parts of T.
Drops drops_on_ground(const TalusLaw& law, const TilePatch& patch, const GroundPatch& patch_ground, int row,
                      int begin) {
  const LawOnGround<false> ground(law, patch_ground);
  Drops drops;
  for (int c = begin; c < begin + group; c += lanes) {
    if (law.law == RelaxationLaw::faces) {
      drops.axis = higher(FaceOnGround<false>(ground, patch, row, c, 0).square, drops.axis);
      drops.axis = higher(FaceOnGround<false>(ground, patch, row, c, 1).square, drops.axis);
      continue;
    }
    const Around a(patch.heights(row), c);
    const Mask has_sand = ground.has_sand(ground.sand(row, c, a.m));
    const V slope = law.law == RelaxationLaw::paper
                        ? PaperOnGround(law, patch_ground).steepest(patch.heights(row), row, c)
                        : squared_slope_on(ground, a, row, c);
    drops.axis = higher(where(has_sand, slope), drops.axis);
  }
  return drops;
}

void ComputeResiduals(const TalusLaw& law, const TilePatch& patch, const GroundPatch* ground,
                      const CellFlags& cells, double* steepest) {
  const bool paper = law.law == RelaxationLaw::paper, faces = law.law == RelaxationLaw::faces;
  const RowSpan span = row_span(cells);
  for (int row = span.begin; row < span.end; ++row) {
    for (unsigned wanted = groups_of(cells[row]); wanted; wanted &= wanted - 1) {
      const int g = std::countr_zero(wanted);
      Drops drops;
      if (ground) drops = drops_on_ground(law, patch, *ground, row, g * group);
      for (int c = g * group; !ground && c < (g + 1) * group; c += lanes) {
        const double* heights = patch.heights(row);
        if (faces) {  // each face counts for one cell
          drops.axis = higher(FaceSlope(heights + c, 1, TilePatch::stride).square, drops.axis);
          drops.axis = higher(FaceSlope(heights + c, TilePatch::stride, 1).square, drops.axis);
          continue;
        }
        const Around a(heights, c);
        drops.axis = higher(paper ? axis_drop(a) : squared_slope(a), drops.axis);
        if (paper) drops.diagonal = higher(diagonal_drop(a.m, Corners(heights, c)), drops.diagonal);
      }
      const double axis = largest(drops.axis), diagonal = largest(drops.diagonal);
      double& part = steepest[row * groups + g];
      if (paper)
        part = (ground ? axis : std::max(axis / law.axis_drop, diagonal / law.diagonal_drop)) - 1.0;
      else
        part = std::sqrt(axis) / law.axis_drop - 1.0;
    }
  }
}

/// The slope of a tile's cells by `faces`: the steepest face through which a cell would give.
void slopes_by_faces(const TilePatch& patch, V inverse, TileSlopes& slopes) {
  FlowScratch& scratch = FlowScratch::of_this_thread();
  // Squares, negative where sand would flow to the west or the north.
  const auto right = [&](int row) { return scratch.factors.data() + TilePatch::start(row); };
  const auto below = [&](int row) { return scratch.below.data() + TilePatch::start(row); };
  const auto keep = [&](double* out, const double* cells, bool down) {
    const FaceSlope face(cells, down ? TilePatch::stride : 1, down ? 1 : TilePatch::stride);
    hn::Store(hn::CopySign(face.square, face.drop), d, out);
  };
  for (int row = -1; row < side; ++row)
    for (int c = -group; c < side; c += lanes) {
      if (row >= 0) keep(right(row) + c, patch.heights(row) + c, false);
      if (c >= 0) keep(below(row) + c, patch.heights(row) + c, true);
    }
  for (int row = 0; row < side; ++row)
    for (int c = 0; c < side; c += lanes) {
      const V out = Max(hn::Load(d, right(row) + c), hn::Load(d, below(row) + c));
      const V back = Min(hn::LoadU(d, right(row) + c - 1), hn::Load(d, below(row - 1) + c));
      const V square = Max(hn::Zero(d), Max(out, hn::Neg(back)));
      hn::Store(Sqrt(square) * inverse, d, slopes.data() + row * side + c);
    }
}

void ComputeSlopes(const TalusLaw& law, const TilePatch& patch, TileSlopes& slopes) {
  const V inverse = all(1.0 / law.axis_drop);
  if (law.law == RelaxationLaw::faces) return slopes_by_faces(patch, inverse, slopes);
  for (int row = 0; row < side; ++row)
    for (int c = 0; c < side; c += lanes) {
      const V square = squared_slope(Around(patch.heights(row), c));
      hn::Store(where(square > hn::Zero(d), Sqrt(square)) * inverse, d, slopes.data() + row * side + c);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace sandstroke
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sandstroke {

HWY_EXPORT(ComputeResiduals);
HWY_EXPORT(ComputeSlopes);

void compute_residuals(const TalusLaw& law, const TilePatch& patch, const GroundPatch* ground,
                       const CellFlags& cells, double* steepest) {
  HWY_DYNAMIC_DISPATCH(ComputeResiduals)(law, patch, ground, cells, steepest);
}
void compute_slopes(const TalusLaw& law, const TilePatch& patch, TileSlopes& slopes) {
  HWY_DYNAMIC_DISPATCH(ComputeSlopes)(law, patch, slopes);
}

}  // namespace sandstroke
#endif
