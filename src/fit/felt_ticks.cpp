#include "fit/felt_ticks.h"

#include <cmath>

#include "core/error.h"
#include "core/interrupt.h"
#include "import/import_stroke.h"
#include "io/mesh_file.h"
#include "io/scene_toml.h"
#include "io/surface_file.h"
#include "run/run_progress.h"
#include "run/run_scene.h"
#include "sim/simulation.h"

namespace sandstroke {
namespace {

class Gatherer : public SimulationObserver {
 public:
  explicit Gatherer(double scale) : scale_(scale) {}
  void on_tick(const TickRecord& tick) override {
    if (tick.contact && !std::isnan(tick.recorded_force.x()))
      ticks.push_back({tick.depth, scale_ * tick.hand.velocity, tick.recorded_force});
  }
  std::vector<FeltTick> ticks;

 private:
  double scale_;
};

}  // namespace

std::vector<FeltTick> felt_ticks(const Scene& asked, const std::filesystem::path& scene_folder) {
  if (!asked.stroke)
    throw_input_error("the scene has no stroke; name one that was recorded with forces: --stroke FILE");
  if (asked.force.law != ForceLaw::paper)
    throw_input_error("the constants of force.law = \"paper\" are fitted; set it (--set force.law=paper)");
  Scene scene = asked;
  scene.tool = with_mesh(scene.tool, scene_folder);
  scene.device.model = DeviceModel::kinematic;
  const std::filesystem::path path = stroke_path(scene, scene_folder);
  std::string hash;
  const Stroke stroke = placed_stroke(scene, path, hash);
  if (stroke.force.empty())
    throw_input_error(
        "{}: has no forces, so there is nothing to fit; name their columns and unit (stroke.table.force, "
        "force_unit), or another --stroke",
        samples_name(path));
  Simulation simulation(scene, load_surface(scene.bed, scene_folder), stroke);
  Gatherer felt(scene.device.scale);
  RunProgress bar;
  simulation.run({&felt, &bar});
  if (interrupted()) return {};
  return std::move(felt.ticks);
}

}  // namespace sandstroke
