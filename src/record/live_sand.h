#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>

#include "haptics/stroke_placement.h"
#include "record/eroder.h"
#include "record/felt_force.h"
#include "record/tool_shaper.h"
#include "sim/contact_force.h"
#include "sim/scene.h"

namespace sandstroke {

/// What LiveSand has to know of a device.
struct FeltDevice {
  std::string frame;                 ///< DeviceSpecification::frame
  double largest_force = any_force;  ///< N, what the hand may get
  bool turns = false;                ///< the tool with the hand
};

/// What came of feeling sand live.
struct LiveSandReport {
  ErosionReport erosion;
  std::int64_t contact_ticks = 0;
  std::int64_t held_ticks = 0;  ///< the tool did not dig, for the eroding bed was too far behind
};

/// Sand under a recorded hand: the scene's tool, displacement and force in the servo loop, its erosion in a
/// thread of its own (paper 4). A `run` of the recorded stroke in the same scene has the same sand and
/// forces, but for
/// - time: it plays a smooth curve through the samples, at even ticks;
/// - velocity: of that curve, while here only the past is known (velocity_window);
/// - erosion: there at the tick it is due, here when its thread has come to it;
/// - a tool that turns: what digs is turned as the hand was a while ago (ToolShaper);
/// - a law of the contact: here the sand is weakened to what the hand may get, too (flagged: clamped_force).
/// With a tip of speed v and acceleration a [m/s, m/s^2, in the bed], samples at most h and relaxations r
/// apart [s] (by way: that way / v), W = velocity_window and K the sand's stiffness (felt_sand), where the
/// recorder did not alter the force:
///   |difference| <= K v (2 h + r) (1 + k_f v) + k_f |F_r| a (W / 2 + 2) h
/// (laws of the contact know no speed: k_f = 0) for in h the hand goes v h, and digs and feels that much
/// elsewhere; in r sand slips no further than its disturbance reached, v r. Where a script's speed jumps, a
/// is as large as the jump over h.
class LiveSand : public FeltWorld {
 public:
  /// The velocity that drag is taken of is the mean over this many ticks, so that it lags by half of them:
  /// the encoders' steps over one tick alone would be felt (9 um in 1 ms are 9 mm/s).
  static constexpr int velocity_window = 4;

  /// A law of the contact is limited to the device's largest force (Wrench::limited). Error: input, naming
  /// the key, where the scene is of a kind that cannot be felt live: a simulated device, a stroke placed by
  /// its plane or cut, or a bed too large for memory.
  LiveSand(const Scene& scene, const HeightField& bed, const FeltDevice& device);

  /// Is shown the eroding bed, in the thread that erodes. Before start().
  void show_to(std::function<void(const HeightField&)> onlooker) { eroder_.show_to(std::move(onlooker)); }
  /// Starts eroding; the recording is about to begin.
  void start();
  FeltForce feel(double time, const DeviceReading& reading) noexcept override;
  bool touches(const DeviceReading& reading) noexcept override;
  /// The recording is over: stops eroding, and brings both beds together. Throws what eroding may have failed
  /// of.
  LiveSandReport finish();

  /// Lets sand slip once, where it was not started: for a loop whose time is not the wall's.
  void erode() { eroder_.turn(); }
  /// The same of the tool that turns: it is as the hand held it last.
  void shape() {
    if (shaper_) shaper_->work();
  }
  /// Where the tip is in the bed [m], of a device's position.
  Eigen::Vector3d tip(const Eigen::Vector3d& position) const {
    return tip_of(device_, placement_.position(position));
  }
  /// On the bed's axes [N], of a force in the device's frame.
  Eigen::Vector3d force_on_bed(const Eigen::Vector3d& force) const { return placement_.force(force); }
  /// Of the tip in the sand [m] when it was last felt, NaN: it was above. From any thread.
  double depth() const { return depth_.load(std::memory_order_relaxed); }
  /// How the hand turns the tool, on the bed's axes, as far as it does. From any thread; not of one tick.
  Eigen::Quaterniond orientation() const;
  /// As the hand feels it.
  const HeightField& bed() const { return replica_.bed(); }
  /// As it erodes.
  const HeightField& eroding_bed() const { return eroder_.bed(); }

 private:
  struct Past {
    double time;
    Eigen::Vector3d tip;
  };

  /// Beside the bed, and lower than its highest sand; tip: in the bed [m].
  bool is_beside(const Interaction& interaction, const Eigen::Vector3d& tip) const {
    return std::isnan(interaction.level) && tip.z() + sand_.footprint().lowest() <= highest_;
  }
  Eigen::Vector3d velocity(double time, const Eigen::Vector3d& tip);
  void turn_tool(const Eigen::Quaterniond& orientation);
  /// After the tool went by `motion` [m].
  void give_force(const Interaction& interaction, const Eigen::Vector3d& tip, const Eigen::Vector3d& motion,
                  const Eigen::Vector3d& speed, FeltForce& felt);
  /// Of the last velocity_window readings, by their number.
  Past& past(std::int64_t reading) { return past_[static_cast<std::size_t>(reading % velocity_window)]; }
  void take_slipped(int most);
  std::size_t changes_of_move(const Eigen::Vector3d& tip) const;

  ForceSettings force_;
  DeviceSettings device_;
  PointPlacement placement_;
  double highest_;  // m: no sand is higher
  SandRing dug_, slipped_;
  PlaceRing places_;
  BedReplica replica_;
  Eroder eroder_;
  SandSide sand_;
  std::optional<ContactForce> contact_force_;  // where force.law is not the paper's
  double largest_force_;                       // N
  Eigen::Matrix3d own_rotation_;               // of the tool
  bool turns_;                                 // with the hand
  std::optional<ToolShaper> shaper_;           // of a tool that turns, and is no sphere
  std::array<Past, velocity_window> past_;
  std::int64_t readings_ = 0;                                             // since the tool was lifted
  std::atomic<double> depth_ = std::numeric_limits<double>::quiet_NaN();  // m
  std::array<std::atomic<double>, 4> orientation_{0.0, 0.0, 0.0, 1.0};    // x, y, z, w
  LiveSandReport report_;
};

}  // namespace sandstroke
