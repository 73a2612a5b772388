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
#include "sim/sand_side.h"

namespace sandstroke {

/// Where the tool was in a tick of the servo loop.
struct ToolPlace {
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();  ///< m, in the bed
  bool contact = false;
  std::optional<Eigen::Matrix3d> rotation = {};  ///< of the tool's frame in the bed; none: as it is held
};

using SandRing = SpscRing<SandChange>;
using PlaceRing = SpscRing<ToolPlace>;

/// How the erosion of a live bed went.
struct ErosionReport {
  std::int64_t relaxations = 0, passes = 0;
  bool converged = true;         ///< the last relaxation
  std::size_t most_waiting = 0;  ///< changes that the servo loop had not taken yet, at most
};

/// Lets a bed that is felt live slip, outside the servo loop as in the paper (section 4): takes what the tool
/// dug from `dug` and where it is from `places`, relaxes its own replica, under a solid tool as it was last
/// told of, and gives what slipped to `slipped`.
class Eroder {
 public:
  /// relaxer: none = as the settings say.
  Eroder(const HeightField& bed, const ToolSettings& tool, const RelaxationSettings& settings, SandRing& dug,
         PlaceRing& places, SandRing& slipped, std::unique_ptr<Relaxer> relaxer = nullptr);
  ~Eroder() { stop(); }

  /// Is shown the bed in that thread after every turn. Before start().
  void show_to(std::function<void(const HeightField&)> onlooker) { onlooker_ = std::move(onlooker); }
  /// In a thread of its own, from the first place of the tool on settings.rate times a second and by the
  /// tool's way, or, where that takes longer, one after the other. Sand that has far to go does so in several
  /// turns. What was dug is taken 60 times a second at least.
  void start();
  /// Ends that thread, after the relaxation that is going on.
  void stop();

  /// By the thread, or, where none runs, by the caller. The thread waits where `slipped` is full; what it
  /// could not give before stop(), or a caller at all, is given with the next turn.
  void turn();
  /// The same, but for the relaxation.
  void exchange();
  /// What ended the thread, if anything did but stop().
  const std::exception_ptr& failure() const { return failure_; }
  /// Nothing is left to be given.
  bool all_given() const { return held_.empty(); }
  const HeightField& bed() const { return replica_.bed(); }
  const ErosionReport& report() const { return report_; }

 private:
  void run();
  void give(const SandChange& change);
  void relax();
  /// The tool asks for it, or sand that it asked for is still on its way.
  bool slip_is_due() const;

  BedReplica replica_;
  double rate_;  // Hz
  bool by_way_, solid_;
  SandSide tool_;       // as last told of; it displaces nothing
  ToolPlace place_;     // of it
  bool begun_ = false;  // it was told of: until then sand stays as a run of the stroke finds it
  std::unique_ptr<Relaxer> relaxer_;
  SandRing& dug_;
  PlaceRing& places_;
  SandRing& slipped_;
  std::vector<SandChange> held_;  // could not be given before the stop
  std::atomic<bool> stopping_ = true;
  std::function<void(const HeightField&)> onlooker_;
  ErosionReport report_;
  std::exception_ptr failure_;  // the thread's while it runs
  std::thread thread_;
};

}  // namespace sandstroke
