#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>

#include "haptics/stroke_placement.h"
#include "record/hand_force.h"
#include "record/live_relaxer.h"
#include "record/tool_shaper.h"
#include "sim/scene.h"

namespace sandstroke {

/// The facts about a device that LiveSand needs.
struct FeltDevice {
  std::string frame;                 ///< DeviceSpecification::frame
  double largest_force = any_force;  ///< N, what the hand may get
  bool turns = false;                ///< the tool turns with the hand
};

/// A report on sand that was felt live.
struct LiveSandReport {
  RelaxationReport relaxation;
  std::int64_t contact_ticks = 0;
  std::int64_t deferred_ticks =
      0;  ///< the tool displaced nothing, because the relaxing bed was too far behind
};

/// Sand under a recorded hand: the scene's tool, displacement and force in the servo loop, its relaxation in
/// a thread of its own (paper 5). A `run` of the recorded stroke in the same scene has the same sand and
/// forces, except for
/// - time: a run plays a smooth curve through the samples, at even ticks;
/// - velocity: a run knows that of the curve, and here only the past is known (velocity_window);
/// - relaxation: in a run at the tick it is due, here when its thread has come to it;
/// - a tool that turns: here the footprint is turned as the hand was a while ago (ToolShaper);
/// - a contact law: here the sand is weakened to what the hand may get, too (flagged: clamped_force).
/// Take a tip of speed v and acceleration a [m/s, m/s^2, in the bed], samples at most h and relaxations r
/// apart [s] (by way: that way / v), W = velocity_window and K the sand's stiffness (felt_sand). Where the
/// recorder did not alter the force:
///   |difference| <= K v (2 h + r) (1 + k_f v) + k_f |F_r| a (W / 2 + 2) h
/// (contact laws know no speed: k_f = 0). In h the hand goes v h, and displaces and feels that much
/// elsewhere. In r sand moves no further than its disturbance reached, v r. Where a script's speed jumps, a
/// is the jump over h.
class LiveSand : public FeltWorld {
 public:
  /// Drag uses the mean velocity over this many ticks, which lags by half of them. Over one tick alone, the
  /// encoders' steps would be felt (9 um in 1 ms are 9 mm/s).
  static constexpr int velocity_window = 4;

  /// A contact law is limited to the device's largest force (Wrench::limited). Error: input, naming the key,
  /// where the scene cannot be felt live: a simulated device, a stroke placed by its plane or cut, or a bed
  /// too large for memory.
  LiveSand(const Scene& scene, const HeightField& bed, const FeltDevice& device);

  /// Shows the sand to `onlooker` as LiveRelaxer::show_to() does, and a last time in finish().
  void show_to(std::function<void(const HeightField&)> onlooker) {
    relaxer_thread_.show_to(std::move(onlooker));
  }
  /// Starts relaxation, just before the recording begins.
  void start();
  FeltForce feel(double time, const DeviceReading& reading) noexcept override;
  bool touches(const DeviceReading& reading) noexcept override;
  /// Ends the recording: stops relaxation, brings both beds together, and shows the sand. Throws the error
  /// that ended a thread, if there was one.
  LiveSandReport finish();

  /// Relaxes once, where start() was not called: for a loop whose time is not the wall's.
  void relax_once() { relaxer_thread_.turn(); }
  /// Makes the tool's shape once, likewise: the shape that the hand asked for last.
  void shape() {
    if (shaper_) shaper_->work();
  }
  /// The tip's position in the bed [m], from a device's position.
  Eigen::Vector3d tip(const Eigen::Vector3d& position) const {
    return tip_of(device_, placement_.position(position));
  }
  /// A force in the device's frame, turned to the bed's axes [N].
  Eigen::Vector3d force_on_bed(const Eigen::Vector3d& force) const { return placement_.force(force); }
  /// Depth of the tip in the sand [m] when it was last felt; NaN: it was above. From any thread.
  double depth() const { return depth_.load(std::memory_order_relaxed); }
  /// How the hand turns the tool, on the bed's axes. From any thread; its numbers may come from two ticks.
  Eigen::Quaterniond orientation() const;
  /// The bed that the hand feels.
  const HeightField& bed() const { return replica_.bed(); }
  /// The bed that relaxes.
  const HeightField& relaxed_bed() const { return relaxer_thread_.bed(); }

 private:
  struct Past {
    double time;
    Eigen::Vector3d tip;
  };

  /// True where the tool is beside the bed, and lower than its highest sand. tip: in the bed [m].
  bool is_beside(const Interaction& interaction, const Eigen::Vector3d& tip) const {
    return std::isnan(interaction.level) && tip.z() + sand_.tool().lowest() <= highest_;
  }
  Eigen::Vector3d velocity(double time, const Eigen::Vector3d& tip);
  void turn_tool(const Eigen::Quaterniond& orientation);
  /// One of the last velocity_window readings, by its number.
  Past& past(std::int64_t reading) { return past_[static_cast<std::size_t>(reading % velocity_window)]; }
  void take_relaxed(int most);
  std::size_t changes_of_move(const Eigen::Vector3d& tip) const;

  DeviceSettings device_;
  PointPlacement placement_;
  double highest_;  // m: no sand is higher
  SandRing displaced_, relaxed_;
  PoseRing poses_;
  BedReplica replica_;
  LiveRelaxer relaxer_thread_;
  SandSide sand_;
  std::unique_ptr<HandForce> force_;
  Eigen::Matrix3d own_rotation_;      // of the tool
  bool turns_;                        // the tool turns with the hand
  std::optional<ToolShaper> shaper_;  // for a tool that turns, and is no sphere
  std::array<Past, velocity_window> past_;
  std::int64_t readings_ = 0;                                             // since the tool was lifted
  std::atomic<double> depth_ = std::numeric_limits<double>::quiet_NaN();  // m
  std::array<std::atomic<double>, 4> orientation_{0.0, 0.0, 0.0, 1.0};    // x, y, z, w
  LiveSandReport report_;
};

}  // namespace sandstroke
