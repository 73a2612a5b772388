#include <algorithm>
#include <bit>
#include <limits>

#include "sand/flux_tile.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sand/flux_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sand/slopes-inl.h"
#include "sand/stage-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sandstroke {
namespace HWY_NAMESPACE {

constexpr int side = BedGeometry::tile_side;

void AdvanceFluxes(double momentum, double step, FluxTile& tile) {
  const RowSpan rows = tile.stage.rows = joined(tile.stage.rows, tile.flow.rows),
                cols = tile.stage.cols = joined(tile.stage.cols, tile.flow.cols);
  const auto advance = [&](PatchHeights& stage, const PatchHeights& flow) {
    for (int row = rows.begin; row < rows.end; ++row)
      for (int c = cols.begin; c < cols.end; c += lanes) {
        double* D = stage.row(row) + c;
        hn::Store(all(momentum) * hn::Load(d, D) + all(step) * hn::Load(d, flow.row(row) + c), d, D);
      }
  };
  advance(*tile.stage.right, *tile.flow.right);
  advance(*tile.stage.below, *tile.flow.below);
}

/// By what the fluxes out of the cells of a vector are multiplied.
HWY_INLINE V scale_of(const TileFluxes& D, const GroundPatch& ground, const TilePatch& patch, int row,
                      int c) {
  const V out = CellFaces(D.right->row(row) + c, D.below->row(row) + c).given();
  const V sand = hn::LoadU(d, patch.heights(row) + c) - hn::LoadU(d, ground.floor.row(row) + c);
  const Mask emptied = hn::And(out > sand, out > hn::Zero(d));
  return hn::AllFalse(d, emptied) ? all(1.0) : hn::IfThenElse(emptied, sand / out, all(1.0));
}

/// The fluxes of one direction, each limited by its giver's scale.
HWY_INLINE V limited(const double* D, const double* scale, std::ptrdiff_t to_next) {
  const V flux = hn::LoadU(d, D);
  return flux * hn::IfThenElse(flux > hn::Zero(d), hn::LoadU(d, scale), hn::LoadU(d, scale + to_next));
}

HeightRange FluxStage(const GroundPatch& ground, const CellFlags& active, RowSpan rows, FluxTile& tile,
                      TilePatch& patch, SuperStepTile& kept, CellFlags& changed) {
  thread_local PatchHeights scales;
  const TileFluxes& D = tile.stage;
  // Elsewhere nothing flows, and all D are 0.
  const RowSpan face_rows = tile.flow.rows = D.rows, face_cols = tile.flow.cols = D.cols;
  for (int row = face_rows.begin; row <= face_rows.end; ++row)
    for (int c = face_cols.begin; c < face_cols.end + group; c += lanes)
      hn::Store(scale_of(D, ground, patch, row, c), d, scales.row(row) + c);
  for (int row = face_rows.begin; row < face_rows.end; ++row)
    for (int c = face_cols.begin; c < face_cols.end; c += lanes) {
      const double* scale = scales.row(row) + c;
      hn::Store(limited(D.right->row(row) + c, scale, 1), d, tile.flow.right->row(row) + c);
      hn::Store(limited(D.below->row(row) + c, scale, PatchLayout::stride), d, tile.flow.below->row(row) + c);
    }
  Range range;
  for (int row = rows.begin; row < rows.end; ++row) {
    const unsigned wanted = groups_of(active[row]);
    std::uint64_t flags = 0;
    for_vectors(wanted, [&](int c) {
      const CellFaces faces(tile.flow.right->row(row) + c, tile.flow.below->row(row) + c);
      double* cells = patch.heights(row) + c;
      const V now = hn::Load(d, cells), zero = hn::Zero(d);
      const V gained = now + faces.gained();
      const V floor = hn::Load(d, ground.floor.row(row) + c);
      const V next = hn::IfThenElse(gained < floor, floor, gained);
      hn::Store(now, d, kept.before->row(row) + c);
      hn::Store(next, d, cells);
      range.add(next, lanes_of(active[row] >> c));
      // Sand that passes through takes its momentum on.
      const Mask passes = hn::Or(hn::Or(faces.east != zero, faces.west != zero),
                                 hn::Or(faces.south != zero, faces.north != zero));
      flags |= static_cast<std::uint64_t>(bits(hn::Or(next != now, passes))) << c;
    });
    changed[row] = flags & active[row];
    kept.stepped[row] |= static_cast<std::uint8_t>(wanted);
    kept.same[row] &= static_cast<std::uint8_t>(~wanted);
  }
  kept.rows = joined(kept.rows, rows);
  return range.over_lanes();
}

}  // namespace HWY_NAMESPACE
}  // namespace sandstroke
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sandstroke {

HWY_EXPORT(AdvanceFluxes);
HWY_EXPORT(FluxStage);

void advance_fluxes(double momentum, double step, FluxTile& tile) {
  HWY_DYNAMIC_DISPATCH(AdvanceFluxes)(momentum, step, tile);
}

namespace {

/// Copies to the rim of a tile's D the faces around its neighbours' cells.
void load_rim_fluxes(const FluxesAround& around) {
  constexpr int side = PatchLayout::side;
  TileFluxes& own = *around[4];
  const auto copy = [&](PatchHeights& to, int row, int col, const TileFluxes* tile, bool right, int from_row,
                        int from_col, int count) {
    double* out = to.row(row) + col;
    if (!tile) return void(std::fill_n(out, count, 0.0));
    const PatchHeights& from = right ? *tile->right : *tile->below;
    std::copy_n(from.row(from_row) + from_col, count, out);
  };
  const TileFluxes *north = around[1], *west = around[3], *east = around[5], *south = around[7];
  copy(*own.right, -1, -1, north, true, side - 1, -1, side + 1);
  copy(*own.below, -2, 0, north, false, side - 2, 0, side);
  copy(*own.right, side, -1, south, true, 0, -1, side + 1);
  copy(*own.below, side, 0, south, false, 0, 0, side);
  for (int row = -1; row < side; ++row) {
    copy(*own.below, row, -1, west, false, row, side - 1, 1);
    copy(*own.below, row, side, east, false, row, 0, 1);
    if (row < 0) continue;
    copy(*own.right, row, -2, west, true, row, side - 2, 1);
    copy(*own.right, row, side, east, true, row, 0, 1);
  }
}

}  // namespace

HeightRange flux_stage(const FluxesAround& around, const GroundPatch& ground, const CellFlags& active,
                       RowSpan rows, FluxTile& tile, TilePatch& patch, SuperStepTile& kept,
                       CellFlags& changed) {
  load_rim_fluxes(around);
  return HWY_DYNAMIC_DISPATCH(FluxStage)(ground, active, rows, tile, patch, kept, changed);
}

}  // namespace sandstroke
#endif
