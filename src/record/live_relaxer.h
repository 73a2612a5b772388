#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <thread>

#include "record/bed_replica.h"
#include "record/spsc_ring.h"
#include "sand/relaxation.h"
#include "sim/sand_at_rest.h"
#include "sim/sand_side.h"

namespace sandstroke {

/// Where the tool was in a tick of the servo loop.
struct ToolPose {
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();  ///< m, in the bed
  bool contact = false;
  std::optional<Eigen::Matrix3d> rotation = {};  ///< how the tool's frame lies in the bed; none: fixed
};

using SandRing = SpscRing<SandChange>;
using PoseRing = SpscRing<ToolPose>;

/// How the relaxation of a live bed went.
struct RelaxationReport {
  std::int64_t relaxations = 0, passes = 0;
  bool converged = true;         ///< the last relaxation
  std::size_t most_waiting = 0;  ///< most changes that waited for the servo loop
};

/// Relaxes a bed that is felt live, outside the servo loop as in the paper (section 5). It takes displaced
/// sand from `displaced` and the tool's pose from `poses`, relaxes its own replica (with walls under a
/// solid tool at its last known pose), and puts the changes into `relaxed`.
class LiveRelaxer {
 public:
  /// relaxer: null = as the settings say.
  LiveRelaxer(const HeightField& bed, const ToolSettings& tool, const RelaxationSettings& settings,
              SandRing& displaced, PoseRing& poses, SandRing& relaxed,
              std::unique_ptr<Relaxer> relaxer = nullptr);
  ~LiveRelaxer() { stop(); }

  /// Shows the bed to `onlooker` up to 60 times a second, as it or the tool changes, in the thread that
  /// relaxes: at rest (SandAtRest), or on its way where it has far to go. It is always the same object. A
  /// picture delays relaxation by up to some 5 ms. Call it before start().
  void show_to(std::function<void(const HeightField&)> onlooker);
  /// Starts a thread that relaxes settings.rate times a second and by the tool's way, from the first pose of
  /// the tool on. Where a relaxation takes longer, the next one follows at once. Sand with far to go takes
  /// several turns. Displaced sand is taken at least 60 times a second.
  void start();
  /// Ends that thread after the relaxation or picture in progress.
  void stop();

  /// Exchanges changes, and relaxes. Called by the thread, or, where none runs, by the caller. The thread
  /// waits where `relaxed` is full. Changes that it could not give before stop(), or a caller at all, go with
  /// the next turn.
  void turn();
  /// The same without the relaxation.
  void exchange();
  /// Shows the bed now, where somebody looks. While the thread runs, only the thread calls it.
  void show();
  /// The error that ended the thread, if there was one.
  const std::exception_ptr& failure() const { return failure_; }
  /// No change is left to be given.
  bool all_given() const { return ungiven_.empty(); }
  const HeightField& bed() const { return replica_.bed(); }
  const RelaxationReport& report() const { return report_; }

 private:
  void run();
  void give(const SandChange& change);
  void relax();
  void turn_tool();
  /// The tool asks for a relaxation, or the last one has not brought the sand to rest.
  bool relaxation_is_due() const;

  BedReplica replica_;
  RelaxationSettings settings_;
  bool by_way_, solid_;
  SandSide tool_;       // as last told; it displaces nothing
  ToolPose pose_;       // the last that was told
  bool begun_ = false;  // a pose was told; until then sand stays as a run of the stroke finds it
  std::unique_ptr<Relaxer> relaxer_;
  SandRing& displaced_;
  PoseRing& poses_;
  SandRing& relaxed_;
  std::vector<SandChange> ungiven_;  // changes that could not be given before the stop
  std::atomic<bool> stopping_ = true;
  std::function<void(const HeightField&)> onlooker_;
  std::optional<SandAtRest> shown_;  // to the onlooker
  ToolPose shown_pose_;
  bool is_news_ = true;  // the bed changed since it was shown
  bool shown_rests_ = false;
  RelaxationReport report_;
  std::exception_ptr failure_;  // only the thread uses it while it runs
  std::thread thread_;
};

}  // namespace sandstroke
