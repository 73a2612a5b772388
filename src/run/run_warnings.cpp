#include "run/run_warnings.h"

#include <spdlog/fmt/fmt.h>

#include "measure/furrow.h"
#include "measure/stroke_depth.h"
#include "sim/simulation.h"

namespace sandstroke {
namespace {

std::string limited_drag_text(const DeviceResult& result, const Scene& scene) {
  const double most = SimulatedDevice(scene.device, {}).strongest_drag();
  return fmt::format(
      "device.drag = implicit limited the drag in {} ticks: it would have been up to {:.4g} N s/m, but "
      "{:.4g} N s/m (2 m / T) already stop the device within a tick; raise device.servo_rate, or lower "
      "force.k_f to {:.3g} s/m",
      result.limited_drag_ticks, result.limited_drag, most, scene.force.k_f * most / result.limited_drag);
}

/// A kinematic device goes where the hand goes, whatever is there. Up to a tenth of a cell is what a surface
/// through cells is worth.
std::string in_floor_text(const DeviceResult& result, const Scene& scene) {
  if (scene.device.model != DeviceModel::kinematic) return "";
  if (!(result.most_floor_depth > 0.1 * scene.bed.cell_size())) return "";
  return fmt::format(
      "the stroke goes {:.2g} mm into a stone or the floor, from {:.3f} s on; a kinematic device is not "
      "stopped, "
      "the hand is told by the force only; raise the stroke, or set device.model = \"dynamic\"",
      1e3 * result.most_floor_depth, *result.in_floor_from);
}

std::string slide_text(const RunResult& result, const Scene& scene) {
  if (result.most_slide <= 1.0) return "";
  return fmt::format(
      "at {:.3f} s the tool accelerates so hard that the sand on it would slide off ({:.2g} times what holds "
      "sand at a talus of {:g} deg), but here it stays; move the tool more gently there",
      result.slides_at, result.most_slide, scene.relaxation.talus_angle);
}

}  // namespace

std::vector<Warning> warnings_of_run(const RunResult& result, const Scene& scene) {
  using enum WarningCode;
  std::vector<Warning> warnings;
  if (scene.stroke && result.ticks > 0 && result.contact_ticks == 0)
    warnings.push_back({nothing_touched, untouched_text(scene, result)});
  if (result.furrow)
    if (const std::string shallow = furrow_warning(scene, *result.furrow); !shallow.empty())
      warnings.push_back({furrow_shallow, shallow});
  if (const std::string in_floor = in_floor_text(result.device, scene); !in_floor.empty())
    warnings.push_back({stroke_in_floor, in_floor});
  if (const std::string slides = slide_text(result, scene); !slides.empty())
    warnings.push_back({load_slides, slides});
  if (scene.device.model == DeviceModel::dynamic && loop_returned_energy(result.device, scene.device))
    warnings.push_back(
        {loop_active,
         fmt::format("the loop was not passive: the sand returned up to {:.3g} J more than it had "
                     "taken; {}",
                     -result.device.least_absorbed_energy, loop_remedies(scene, result.device))});
  if (result.device.limited_drag_ticks > 0)
    warnings.push_back({drag_limited, limited_drag_text(result.device, scene)});
  if (result.device.swings_from)
    warnings.push_back(
        {loop_swings, fmt::format("the loop is unstable: from {:.3f} s on the device swings by itself, with "
                                  "energy that the sand returns in each swing; {}",
                                  *result.device.swings_from, loop_remedies(scene, result.device))});
  if (!result.relaxation.converged)
    warnings.push_back(
        {not_at_rest, fmt::format("the sand is not at rest (residual {:.2e}, tolerance {:.2e}); raise "
                                  "relaxation.max_passes or relaxation.tolerance",
                                  result.relaxation.residual, scene.relaxation.tolerance)});
  return warnings;
}

}  // namespace sandstroke
