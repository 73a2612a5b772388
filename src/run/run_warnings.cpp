#include "run/run_warnings.h"

#include <spdlog/spdlog.h>

#include "core/log.h"
#include "measure/furrow.h"
#include "measure/stroke_depth.h"
#include "sim/simulation.h"

namespace sandstroke {
namespace {

void warn_of_limited_drag(const DeviceResult& result, const Scene& scene) {
  const double most = SimulatedDevice(scene.device, {}).strongest_drag();
  spdlog::warn(
      "device.drag = implicit limited the drag in {} ticks: it would have been up to {:.4g} N s/m, but "
      "{:.4g} N s/m (2 m / T) already stop the device within a tick; raise device.servo_rate, or lower "
      "force.k_f to {:.3g} s/m",
      result.limited_drag_ticks, result.limited_drag, most, scene.force.k_f * most / result.limited_drag);
}

}  // namespace

void warn_of_run(const RunResult& result, const Scene& scene) {
  if (result.ticks > 0 && result.contact_ticks == 0) spdlog::warn("{}", untouched_text(scene, result));
  if (result.furrow) warn_if_any(furrow_warning(scene, *result.furrow));
  if (scene.device.model == DeviceModel::dynamic && loop_returned_energy(result.device, scene.device))
    spdlog::warn("the loop was not passive: the sand returned up to {:.3g} J more than it had taken; {}",
                 -result.device.least_absorbed_energy, loop_remedies(scene, result.device.max_drag_force));
  if (result.device.limited_drag_ticks > 0) warn_of_limited_drag(result.device, scene);
  if (result.device.swings_from)
    spdlog::error(
        "the loop is unstable: from {:.3f} s on the device swings by itself, with energy that the sand "
        "returns in each swing; {}",
        *result.device.swings_from, loop_remedies(scene, result.device.max_drag_force));
  if (!result.relaxation.converged)
    spdlog::warn(
        "the sand is not at rest (residual {:.2e}, tolerance {:.2e}); raise relaxation.max_passes or "
        "relaxation.tolerance",
        result.relaxation.residual, scene.relaxation.tolerance);
}

}  // namespace sandstroke
