#include "sim/tick_loop.h"

#include <limits>

#include "core/error.h"
#include "rules/schedule.h"
#include "sand/ground.h"
#include "sim/plugin_laws.h"
#include "sim/scene_moisture.h"
#include "tool/tool_surface.h"

namespace sandstroke {

TickLoop::TickLoop(const Scene& scene, HeightField bed, bool plays, std::unique_ptr<Relaxer> relaxer)
    : scene_(std::make_shared<const Scene>(scene)),
      bed_(std::move(bed)),
      own_rotation_(own_rotation(scene.tool)),
      sand_(scene.tool, scene.displacement, scene.relaxation,
            plays ? make_plugin_displacer(scene, bed_.cell_size()) : nullptr),
      tool_force_(plays ? make_tool_force(scene, bed_.cell_size()) : std::make_unique<NoToolForce>()),
      device_(scene),
      relaxer_(relaxer ? std::move(relaxer) : make_relaxer(scene, bed_)) {
  if (plays && bed_.ground() && bed_.ground()->has_floor()) floor_.emplace(scene.tool, bed_.cell_size());
  if (scene.tool.carries) sand_.carry(scene.tool, scene.strength.density);
  if (!scene.sources.empty()) sources_.emplace(scene.sources, scene.strength.density);
  if (!scene.plugin_laws.relaxation.empty() || !scene.plugin_laws.displacement.empty()) watch_.emplace(bed_);
}

namespace {

/// A tool that carries sand, over a bed.
class CarryingTool : public SandCatcher {
 public:
  explicit CarryingTool(SandSide& sand) : sand_(sand) {}
  double top_at(double x, double y) const override { return sand_.top_at({x, y}); }
  void take(double x, double y, double height) override { sand_.catch_sand({x, y}, height); }

 private:
  SandSide& sand_;
};

}  // namespace

void TickLoop::pour(double time) {
  CarryingTool tool(sand_);
  sources_->act(bed_, time + 1.0 / scene().device.servo_rate, sand_.load() ? &tool : nullptr);
}

TickRecord TickLoop::step(const TickInput& tick) {
  if (sources_) pour(tick.time);
  if (sand_.load()) sand_.load()->land(bed_, tick.time + 1.0 / scene().device.servo_rate);
  TickRecord record = read_device(tick);
  if (tick.hand.down) {
    if (tick.turns) turn_tool(tick.hand);
    displace(record, tick);
  } else {
    lift();
    if (sand_.relaxation_is_due()) tick.relax();
  }
  if (sand_.load()) record.carried = sand_.load()->mass();
  record.next = tick.next_hand();
  device_.feel(record);
  return record;
}

TickRecord TickLoop::read_device(const TickInput& tick) const {
  TickRecord record;
  record.time = tick.time;
  record.hand = tick.hand;
  record.device_position = device_.device().read().position;
  return record;
}

void TickLoop::turn_tool(const Hand& hand) {
  const Eigen::Matrix3d rotation = rotation_of(hand.orientation) * own_rotation_;
  sand_.turn(rotation);
  tool_force_->turn(rotation);
  if (floor_) floor_->turn(rotation);
}

/// Depth, both passes of the displacement along the tool's path, relaxations by its way, and what the sand
/// then does to the tool.
void TickLoop::displace(TickRecord& record, const TickInput& tick) {
  const Eigen::Vector3d tip = tip_of(scene().device, record.device_position);
  const Eigen::Vector3d true_tip = tip_of(scene().device, device_.device().state().position);
  const std::optional<Eigen::Vector3d> before = sand_.last_tip();
  const Interaction interaction = sand_.move(bed_, tip, true_tip, tick.relax);
  const Eigen::Vector3d motion = before ? Eigen::Vector3d(true_tip - *before) : Eigen::Vector3d::Zero();
  record.wrench = tool_force_->in_tick(sand_, bed_, tip, motion, interaction.contact);
  record.level = interaction.level;
  record.depth = interaction.depth;
  record.displaced_volume = interaction.displaced_volume;
  record.contact = interaction.contact;
  if (sand_.load()) {
    sand_.load()->pass(1.0 / scene().device.servo_rate);
    const LoadOnTool load = sand_.load_on_tool();
    record.load = load.weight;
    record.load_stiffness = load.stiffness;
    record.wrench.torque += load.torque;
  }
  if (!floor_) return;
  const Eigen::Vector3d way_out = floor_->way_out(bed_, tip);
  record.floor_depth = length_of(way_out);
  record.floor_force = scene().ground.stiffness * way_out;
  record.contact |= record.floor_depth > 0.0;
}

void TickLoop::advance(const TickRecord& record) {
  device_.advance(record);
  check_near(record);
  if (record.lifts) lift();
}

void TickLoop::lift() {
  sand_.lift();
  tool_force_->lift();
}

bool TickLoop::end_spills() {
  ToolLoad* const load = sand_.load();
  if (!load) return false;
  load->land(bed_, std::numeric_limits<double>::infinity());
  return load->has_moved() || load->has_landed();
}

RelaxationOutcome TickLoop::relax(double time, const PassWatcher& watcher) {
  relaxer_->set_time(time);
  sand_.make_walls(bed_);
  check_plugin_law("displacement", scene().plugin_laws.displacement);
  const RelaxationOutcome outcome = relaxer_->relax(bed_, watcher);
  sand_.relax_load(bed_, time);
  sand_.relaxed(bed_);
  if (sources_) sources_->settled();
  check_plugin_law("relaxation", scene().plugin_laws.relaxation);
  return outcome;
}

bool TickLoop::relaxation_comes_due(std::int64_t tick) const {
  const RelaxationSettings& settings = scene().relaxation;
  const double servo_rate = scene().device.servo_rate;
  if (comes_due(tick, servo_rate, settings.rate)) return true;
  const bool by_itself = (sources_ && sources_->unsettled()) ||
                         (sand_.load() && (!sand_.load()->carried().empty() || sand_.load()->has_landed()));
  return by_itself && settings.rate == 0.0 && settings.way > 0.0 &&
         comes_due(tick, servo_rate, published_relaxation_rate);
}

void TickLoop::visit_state(StateVisitor& state) {
  if (scene().tool.mesh) state.same("tool.file", content_hash(*scene().tool.mesh));
  bed_.visit_state(state);
  sand_.visit_state(state, bed_);
  tool_force_->visit_state(state);
  if (floor_) floor_->visit_state(state);
  device_.visit_state(state);
  relaxer_->visit_state(state);
  if (sources_) sources_->visit_state(state);
  bool shows_rest = at_rest_.has_value();
  state.value("at_rest", shows_rest);
  if (state.restores()) at_rest_.reset();
  if (!shows_rest) return;
  if (!at_rest_) make_at_rest();
  at_rest_->visit_state(state);
}

void TickLoop::make_at_rest() { at_rest_.emplace(bed_, make_relaxer(scene(), bed_)); }

const HeightField& TickLoop::bed_at_rest() {
  const RelaxationSettings& settings = scene().relaxation;
  if (!scene().plugin_laws.relaxation.empty() || (settings.rate == 0.0 && settings.way == 0.0)) return bed_;
  if (!at_rest_) make_at_rest();
  sand_.make_walls(at_rest_->follow(bed_));
  at_rest_->relax(*relaxer_);
  return at_rest_->copy();
}

void TickLoop::check_near(const TickRecord& record) const {
  const double hand = std::max(tip_of(scene().device, record.hand.position).norm(),
                               tip_of(scene().device, record.next.position).norm());
  const double far = 100.0 * (scene().bed.width + scene().bed.depth) + 2.0 * hand;
  const double distance = tip_of(scene().device, device_.device().state().position).norm();
  if (!(distance < far))
    throw Error(ErrorKind::unstable,
                fmt::format("at {:.4f} s the device has diverged ({:.3g} m from the bed's centre); {}",
                            record.time, distance, loop_remedies(scene(), device_.result())));
}

void TickLoop::check_plugin_law(const char* key, const std::string& name) {
  if (!name.empty())
    watch_->check(bed_, law_in_words(scene().plugin_laws, key, name),
                  sources_ ? sources_->given_volume() : 0.0);
}

}  // namespace sandstroke
