#pragma once

#include <filesystem>
#include <optional>

#include "bed_on_stones.h"
#include "io/run_writer.h"
#include "sim/simulation.h"

namespace sandstroke {

/// Writes a run on this bed, whose sand rises by 1 mm in cell (3, 4) in a frame at 0.5 s, and by 2 mm at the
/// end. An interrupted one stays a .part file.
inline void write_run_on(const HeightField& bed, const std::filesystem::path& path,
                         bool interrupted = false) {
  Scene scene;
  scene.bed.width = bed.cols() * bed.cell_size();
  scene.bed.depth = bed.rows() * bed.cell_size();
  scene.bed.rows = bed.rows();
  scene.bed.cols = bed.cols();
  const Simulation simulation(scene, bed, std::nullopt);
  RunWriter writer(path, simulation, ViewSettings{}, "");
  HeightField surface = bed;
  surface.set(3, 4, bed(3, 4) + 0.001);
  writer.on_frame(0.5, surface);
  surface.set(3, 4, bed(3, 4) + 0.002);
  RunResult result;
  result.interrupted = interrupted;
  writer.end(result, surface);
  if (!interrupted) writer.finish();
}

}  // namespace sandstroke
