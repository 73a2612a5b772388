#include "fit/felt_ticks.h"

#include <cmath>

#include "run/run_progress.h"
#include "sim/contact_force.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

bool is_felt(const TickRecord& tick) { return tick.contact && !std::isnan(tick.recorded_force.x()); }

class PaperTicks : public SimulationObserver {
 public:
  explicit PaperTicks(double scale) : scale_(scale) {}
  void on_tick(const TickRecord& tick) override {
    if (is_felt(tick)) ticks.push_back({tick.depth, scale_ * tick.hand.velocity, tick.recorded_force});
  }
  std::vector<FeltTick> ticks;

 private:
  double scale_;
};

/// Follows the tool and computes its force in each of the grid's sands, as the run does in its own sand.
class ContactTicks : public SimulationObserver {
 public:
  ContactTicks(const Simulation& run, ContactLaw& law)
      : run_(run),
        law_(law),
        turns_(run.trace_content().orientation),
        own_rotation_(own_rotation(run.scene().tool)),
        sand_(run.scene().tool, run.scene().displacement) {
    Scene scene = run.scene();
    scene.device.max_force = 0.0;  // the law cuts what a device of any strength would give
    for (const SandStrength& sand : law.grid().sands()) {
      scene.strength = sand;
      forces_.push_back(make_contact_force(scene, run.bed().cell_size()));
    }
    felt_.resize(forces_.size());
  }

  void on_tick(const TickRecord& tick) override {
    if (tick.hand.down) feel(tick);
    if (!tick.hand.down || tick.lifts) lift();
  }

 private:
  void lift() {
    last_tip_.reset();
    for (const auto& force : forces_) force->lift();
  }

  void feel(const TickRecord& tick) {
    const Eigen::Vector3d tip = tip_of(run_.scene().device, tick.device_position);
    const Eigen::Vector3d motion = last_tip_ ? Eigen::Vector3d(tip - *last_tip_) : Eigen::Vector3d::Zero();
    last_tip_ = tip;
    if (turns_) turn(rotation_of(tick.hand.orientation) * own_rotation_);
    sand_.meet(run_.bed(), tip);
    for (std::size_t i = 0; i < forces_.size(); ++i)
      felt_[i] = forces_[i]->in_tick(sand_, run_.bed(), tip, motion, tick.contact);
    if (is_felt(tick)) law_.add(felt_, tick.recorded_force);
  }

  void turn(const Eigen::Matrix3d& rotation) {
    sand_.turn(rotation);
    for (const auto& force : forces_) force->turn(rotation);
  }

  const Simulation& run_;
  ContactLaw& law_;
  bool turns_;  // the tool turns with the hand
  Eigen::Matrix3d own_rotation_;
  SandSide sand_;
  std::vector<std::unique_ptr<ToolForce>> forces_;
  std::vector<Wrench> felt_;
  std::optional<Eigen::Vector3d> last_tip_;
};

}  // namespace

std::vector<FeltTick> felt_ticks(const FeltStroke& felt) {
  Simulation run(felt.scene, felt.bed, felt.stroke);
  PaperTicks ticks(felt.scene.device.scale);
  RunProgress bar;
  run.run({&ticks, &bar});
  return std::move(ticks.ticks);
}

ContactLaw felt_in(const FeltStroke& felt, SandGrid grid) {
  Simulation run(felt.scene, felt.bed, felt.stroke);
  ContactLaw law(std::move(grid), felt.scene.device.max_force, 1.0 / felt.scene.device.servo_rate);
  ContactTicks ticks(run, law);
  RunProgress bar;
  run.run({&ticks, &bar});
  return law;
}

}  // namespace sandstroke
