#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "haptics/stroke_sampler.h"
#include "sand/floor_contact.h"
#include "sim/device_side.h"
#include "sim/sand_at_rest.h"
#include "sim/sand_side.h"
#include "sim/sand_sources.h"
#include "sim/sand_watch.h"
#include "sim/tool_force.h"

namespace sandstroke {

/// The hand's part in a tick.
struct TickInput {
  double time;  ///< s, of its start
  Hand hand;    ///< at its start
  bool turns;   ///< the tool turns with the hand, from tool.orientation
  /// Where the hand is at its end, as far as that is known; called once the tool has displaced sand.
  std::function<Hand()> next_hand;
  /// Called with the tool at the positions where a relaxation is due by its way; calls TickLoop::relax().
  std::function<void()> relax;
};

/// A device whose tool goes through a bed, tick by tick: what whole runs (Simulation) and those who drive a
/// hand themselves (SteppedSimulation) have in common. A tick is step(), then advance().
class TickLoop {
 public:
  /// plays: a hand will move the tool; else the bed is only relaxed. relaxer: none = as the scene says.
  TickLoop(const Scene& scene, HeightField bed, bool plays, std::unique_ptr<Relaxer> relaxer = nullptr);

  const Scene& scene() const { return *scene_; }
  const HeightField& bed() const { return bed_; }
  /// The trace has torques.
  bool has_torque() const { return tool_force_->gives_wrench(); }
  /// The tool may come to a floor.
  bool has_floor() const { return floor_.has_value(); }
  DeviceResult device_result() const { return device_.result(); }

  /// The device is where the hand is, and moves as it does.
  void start(const Hand& hand) { device_.start(hand); }
  /// The stages of a tick, in this order: sources pour, the device is read, the tool displaces sand, and the
  /// device feels the sand's force.
  TickRecord step(const TickInput& tick);
  /// The device goes to the tick's end; where the hand is lifted before it (record.lifts), with it. Error:
  /// unstable, where force or device leave all bounds.
  void advance(const TickRecord& record);
  /// The tool touches nothing.
  void lift();
  /// The sand on the tool; null: it carries none.
  const ToolLoad* load() const { return sand_.load(); }
  std::optional<LoadSurface> load_surface() const { return sand_.load_surface(); }
  /// Lands what the tool spilled and still falls. Whether the bed or the tool has sand since that was not
  /// brought to rest.
  bool end_spills();
  /// A tick from this time [s] on without a hand: sources pour, which the scene must have.
  void pour(double time);
  /// None: the scene has none.
  std::optional<SandSources>& sources() { return sources_; }
  const std::optional<SandSources>& sources() const { return sources_; }
  /// Whether sand has to relax in this tick, counted from the run's start, by relaxation.rate. Where that is
  /// 0 and sand relaxes by the tool's way alone, what sources pour relaxes at the published rate.
  bool relaxation_comes_due(std::int64_t tick) const;
  /// All that later ticks depend on. Error: input, if a plugin law has a part in them.
  void visit_state(StateVisitor& state);
  /// Relaxes the sand to rest at this time of the run [s], around a solid tool or into the hollow that it has
  /// left. Error: unstable, where a plugin law makes or loses sand.
  RelaxationOutcome relax(double time, const PassWatcher& watcher);
  /// bed() as it would lie if it came to rest now, which it need not until the next relaxation (SandAtRest).
  /// bed() itself where a scene does not relax as its stroke goes on, or by a law of one's own. Always the
  /// same object, from the first call on.
  const HeightField& bed_at_rest();

 private:
  TickRecord read_device(const TickInput& tick) const;
  void turn_tool(const Hand& hand);
  void displace(TickRecord& record, const TickInput& tick);
  void make_at_rest();
  void check_near(const TickRecord& record) const;
  void check_plugin_law(const char* key, const std::string& name);

  std::shared_ptr<const Scene> scene_;
  HeightField bed_;
  Eigen::Matrix3d own_rotation_;  // of the tool
  SandSide sand_;
  Copied<ToolForce> tool_force_;
  std::optional<FloorContact> floor_;  // where the bed has a floor
  DeviceSide device_;
  Copied<Relaxer> relaxer_;
  std::optional<SandSources> sources_;
  std::optional<SandAtRest> at_rest_;
  std::optional<SandWatch> watch_;  // where a law that is not this library's moves sand
};

}  // namespace sandstroke
