#include "sand/relaxation.h"

#include "core/angle.h"
#include "core/elementary.h"
#include "sand/active_sand.h"
#include "sand/steep_tiles.h"

namespace sandstroke {

void RelaxationOutcome::add(const RelaxationOutcome& next) {
  passes += next.passes;
  super_steps += next.super_steps;
  rejected_stages += next.rejected_stages;
  residual = next.residual;
  moved_volume += next.moved_volume;
  cells_visited += next.cells_visited;
  tiles_active_max = std::max(tiles_active_max, next.tiles_active_max);
  wake_ups += next.wake_ups;
  converged = next.converged;
}

double talus_slope(double talus_angle) { return elementary::tan(to_radians(talus_angle)); }

double flow_share(const RelaxationSettings& settings) {
  if (settings.share > 0.0) return settings.share;
  return settings.law == RelaxationLaw::paper ? 0.5 : 0.25;
}

std::int64_t tiles_to_relax(const HeightField& bed, const RelaxationSettings& settings) {
  std::int64_t tiles = bed.allocated_tiles();
  visit_steep_tiles(bed, stable_slope(TalusLaw(settings, bed.cell_size()), bed.cell_size()),
                    [&](int tile) { tiles += bed.slot_of(tile) < 0; });
  return tiles;
}

std::size_t bytes_per_relaxed_tile(const RelaxationSettings& settings) {
  return HeightField::bytes_per_tile() + ActiveSand::bytes_per_tile() +
         (settings.method == RelaxationMethod::rkl ? rkl_bytes_per_tile() : 0);
}

std::unique_ptr<Relaxer> make_relaxer(const RelaxationSettings& settings, double cell_size) {
  return settings.method == RelaxationMethod::rkl ? make_rkl_relaxer(settings, cell_size)
                                                  : make_tile_relaxer(settings, cell_size);
}

}  // namespace sandstroke
