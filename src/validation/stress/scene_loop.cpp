#include "validation/stress/scene_loop.h"

#include "core/error.h"
#include "validation/stress/device_parts.h"
#include "validation/stress/loop_margins.h"

namespace sandstroke {

StiffestContact::StiffestContact(const Scene& scene) : scene_(scene), force_(make_device_force(scene)) {}

void StiffestContact::on_tick(const TickRecord& tick) {
  if (!tick.contact) return;
  touched_ = true;
  if (tick.saturated) return;  // a force at its limit does not change with the way
  const double stiffness = force_->felt_sand(tick, scene_.device).stiffness;
  if (!(stiffness > stiffness_)) return;
  stiffness_ = stiffness;
  depth_ = tick.depth;
}

LoopSettings StiffestContact::loop() const {
  if (scene_.device.delay > latest_judged)
    throw_input_error("device.delay is {} ticks; forces up to {} ticks late are judged", scene_.device.delay,
                      latest_judged);
  if (stiffness_ == 0.0 && touched_)
    throw_input_error(
        "the force is at the device's limit, device.max_force, wherever the tool is in the sand, so "
        "it does not change with the way; raise the limit, or press less");
  if (stiffness_ == 0.0)
    throw_input_error(
        "the scene's stroke feels no sand, so there is no loop to judge; give it a stroke that "
        "goes into the sand");
  DeviceSettings device = scene_.device;
  device.model = DeviceModel::dynamic;
  device.resolution = device.dropped_ticks = 0.0;
  if (!is_contact_law(scene_)) return pressed_to(depth_, device, scene_.force);
  LoopSettings loop;
  loop.device = device;
  const double yield = scene_.strength.yield_way;
  loop.against = scene_.plugin_laws.force.empty()
                     ? decltype(loop.against)(YieldingSand{stiffness_ / device.scale * yield, yield})
                     : Wall{stiffness_, 0.0};
  loop.disturbance = 0.01 * yield;
  return loop;
}

}  // namespace sandstroke
