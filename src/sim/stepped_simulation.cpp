#include "sim/stepped_simulation.h"

#include <utility>

#include "core/error.h"

namespace sandstroke {

SteppedSimulation::SteppedSimulation(const Scene& scene, HeightField bed, bool relaxes)
    : loop_(scene, std::move(bed), true), relaxes_(relaxes) {
  if (scene.device.model == DeviceModel::dynamic && scene.device.drag == DragVelocity::implicit)
    throw_input_error(
        "device.drag = \"implicit\" needs the hand's motion in a tick before the tick begins; a simulation "
        "that is stepped does not know it; set \"sampled\"");
}

double SteppedSimulation::time() const { return static_cast<double>(ticks_) / scene().device.servo_rate; }

const TickRecord& SteppedSimulation::tick(Hand hand, const ToldMotion& told) {
  if (!hand.position.allFinite() || !hand.velocity.allFinite() || !hand.orientation.coeffs().allFinite())
    throw_input_error("at {:.4f} s the hand's position, velocity or orientation is not a number", time());
  if (!((hand.position.array().abs() <= most_in_stroke).all() &&
        (hand.velocity.array().abs() <= most_in_stroke).all()))
    throw_input_error("at {:.4f} s the hand's position or velocity is beyond {} m or m/s; check its unit",
                      time(), most_in_stroke);
  if (!told.velocity)
    hand.velocity = last_
                        ? Eigen::Vector3d(scene().device.servo_rate * (hand.position - last_->hand.position))
                        : Eigen::Vector3d::Zero();
  if (last_) {
    last_->next = hand;
    last_->lifts = last_->hand.down && !hand.down;
    loop_.advance(*last_);
  } else {
    loop_.start(hand);
  }
  last_ = loop_.step({time(), hand, told.orientation, [&] { return hand; },
                      [this] {
                        if (relaxes_) relax();
                      }});
  if (relaxes_ && loop_.relaxation_comes_due(ticks_)) relax();
  ++ticks_;
  return *last_;
}

void SteppedSimulation::visit_state(StateVisitor& state) {
  loop_.visit_state(state);
  state.value("relaxes", relaxes_);
  state.value("ticks", ticks_);
  state.value("last", last_);
}

std::string SteppedSimulation::state() {
  StateKeeper keeper;
  visit_state(keeper);
  return std::move(keeper).kept();
}

void SteppedSimulation::set_state(std::string_view state) {
  SteppedSimulation other = *this;
  StateRestorer restorer(state);
  other.visit_state(restorer);
  restorer.end();
  *this = std::move(other);
}

}  // namespace sandstroke
