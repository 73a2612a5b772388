#include "sand/relaxation.h"

#include "sand/active_sand.h"
#include "sand/steep_tiles.h"

namespace sandstroke {

void RelaxationOutcome::add(const RelaxationOutcome& next) {
  passes += next.passes;
  super_steps += next.super_steps;
  rejected_stages += next.rejected_stages;
  residual = next.residual;
  moved_volume += next.moved_volume;
  failed_volume += next.failed_volume;
  cells_visited += next.cells_visited;
  tiles_active_max = std::max(tiles_active_max, next.tiles_active_max);
  wake_ups += next.wake_ups;
  converged = next.converged;
}

double flow_share(const RelaxationSettings& settings) {
  if (settings.share > 0.0) return settings.share;
  return settings.law == RelaxationLaw::paper ? 0.5 : 0.25;
}

TalusLaw talus_law(const RelaxationSettings& settings, double cell_size) {
  return talus_law(settings.law, flow_share(settings), settings.talus_angle, settings.tolerance, cell_size);
}

std::int64_t tiles_to_relax(const HeightField& bed, const RelaxationSettings& settings) {
  if (settings.method == RelaxationMethod::plain) return bed.tile_count();
  std::int64_t tiles = bed.allocated_tiles();
  visit_steep_tiles(bed, stable_slope(talus_law(settings, bed.cell_size()), bed.cell_size()),
                    [&](int tile) { tiles += bed.slot_of(tile) < 0; });
  return tiles;
}

std::size_t bytes_per_relaxed_tile(const RelaxationSettings& settings, bool on_floor) {
  // plain: the old heights and the new ones, and the rule's own two fields.
  if (settings.method == RelaxationMethod::plain)
    return HeightField::bytes_per_tile() + 4 * sizeof(double) * BedGeometry::tile_area;
  const bool super_steps = takes_super_steps(settings.method);
  const std::size_t relaxed =
      HeightField::bytes_per_tile() + ActiveSand::bytes_per_tile() +
      (super_steps ? rkl_bytes_per_tile() : 0) +
      (on_floor ? sizeof(GroundPatch) + (super_steps ? 4 * sizeof(PatchHeights) : 0) : 0);
  // multilevel: on each coarser bed a quarter of the tiles, each with its talus slopes, what they make of
  // |g|^2, and what changed.
  if (settings.method == RelaxationMethod::multilevel)
    return relaxed + (relaxed + 2 * HeightField::bytes_per_tile() + sizeof(PatchHeights)) / 3;
  return relaxed;
}

std::unique_ptr<Relaxer> make_relaxer(const RelaxationSettings& settings, double cell_size) {
  switch (settings.method) {
    case RelaxationMethod::rkl:
      return make_super_stepper(settings, cell_size);
    case RelaxationMethod::multilevel:
      return make_multilevel_relaxer(settings, cell_size);
    case RelaxationMethod::plain:
      return make_plain_relaxer(settings, cell_size);
    case RelaxationMethod::passes:
      break;
  }
  return make_tile_relaxer(settings, cell_size);
}

}  // namespace sandstroke
