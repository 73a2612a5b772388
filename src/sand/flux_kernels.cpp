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

/// Calls body(column of a vector's first lane) for the vectors of a row's flagged groups (TileFluxes).
template <class Body>
HWY_INLINE void for_wide_vectors(unsigned groups, const Body& body) {
  for_vectors(groups, [&](int c) { body(c - group); });
}

void AdvanceFluxes(double momentum, double step, FluxTile& tile) {
  TileFluxes &stage = tile.stage, &flow = tile.flow;
  stage.rows = joined(stage.rows, flow.rows);
  for (int row = stage.rows.begin; row < stage.rows.end; ++row) {
    stage.groups[row + 1] |= flow.groups[row + 1];
    const auto advance = [&](double* D, const double* F) {
      for_wide_vectors(stage.groups[row + 1], [&](int c) {
        hn::Store(all(momentum) * hn::Load(d, D + c) + all(step) * hn::Load(d, F + c), d, D + c);
      });
    };
    advance(stage.right->row(row), flow.right->row(row));
    advance(stage.below->row(row), flow.below->row(row));
  }
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
  for (int row = D.rows.begin; row <= D.rows.end; ++row) {
    const unsigned givers = D.groups_in(row) | D.groups_in(row) << 1 | D.groups_in(row - 1);
    for_wide_vectors(givers,
                     [&](int c) { hn::Store(scale_of(D, ground, patch, row, c), d, scales.row(row) + c); });
  }
  tile.flow.rows = D.rows;
  tile.flow.groups = D.groups;
  for (int row = D.rows.begin; row < D.rows.end; ++row)
    for_wide_vectors(D.groups_in(row), [&](int c) {
      const double* scale = scales.row(row) + c;
      hn::Store(limited(D.right->row(row) + c, scale, 1), d, tile.flow.right->row(row) + c);
      hn::Store(limited(D.below->row(row) + c, scale, PatchLayout::stride), d, tile.flow.below->row(row) + c);
    });
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

/// Copies to the rim of a tile's D the faces around its neighbours' cells, where these may give through
/// faces of the tile.
void load_rim_fluxes(const FluxesAround& around) {
  constexpr int side = PatchLayout::side;
  TileFluxes& own = *around[4];
  const auto copy_row = [](PatchHeights& to, int row, int col, const PatchHeights* from, int from_row,
                           int count) {
    double* out = to.row(row) + col;
    if (from)
      std::copy_n(from->row(from_row) + col, count, out);
    else
      std::fill_n(out, count, 0.0);
  };
  const auto right_of = [&](int at) { return around[at] ? around[at]->right.get() : nullptr; };
  const auto below_of = [&](int at) { return around[at] ? around[at]->below.get() : nullptr; };
  constexpr int north = 1, west = 3, east = 5, south = 7;
  if (own.groups_in(-1) != 0) {
    copy_row(*own.right, -1, -1, right_of(north), side - 1, side + 1);
    copy_row(*own.below, -2, 0, below_of(north), side - 2, side);
  }
  if (own.groups_in(side - 1) != 0) {
    copy_row(*own.right, side, -1, right_of(south), 0, side + 1);
    copy_row(*own.below, side, 0, below_of(south), 0, side);
  }
  const auto copy_cell = [](PatchHeights& to, int row, int col, const PatchHeights* from, int from_col) {
    to.row(row)[col] = from ? from->row(row)[from_col] : 0.0;
  };
  for (int row = std::max(own.rows.begin, 0); row < own.rows.end; ++row) {
    const unsigned groups = own.groups_in(row);
    if (groups & 1) {
      copy_cell(*own.right, row, -2, right_of(west), side - 2);
      copy_cell(*own.below, row, -1, below_of(west), side - 1);
      copy_cell(*own.below, row - 1, -1, below_of(west), side - 1);
    }
    if (groups >> (side / cells_per_group) & 1) {
      copy_cell(*own.right, row, side, right_of(east), 0);
      copy_cell(*own.below, row, side, below_of(east), 0);
      copy_cell(*own.below, row - 1, side, below_of(east), 0);
    }
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
