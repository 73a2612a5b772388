#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <thread>

#include "record/bed_replica.h"
#include "record/spsc_ring.h"
#include "sand/relaxation.h"

namespace sandstroke {

using SandRing = SpscRing<SandChange>;

/// How the erosion of a live bed went.
struct ErosionReport {
  std::int64_t relaxations = 0, passes = 0;
  bool converged = true;         ///< the last relaxation
  std::size_t most_waiting = 0;  ///< changes that the servo loop had not taken yet, at most
};

/// Lets a bed that is felt live slip, outside the servo loop as in the paper (section 4): takes what the tool
/// dug from `dug`, relaxes its own replica, and gives what slipped to `slipped`.
class Eroder {
 public:
  /// relaxer: none = as the settings say.
  Eroder(const HeightField& bed, const RelaxationSettings& settings, SandRing& dug, SandRing& slipped,
         std::unique_ptr<Relaxer> relaxer = nullptr);
  ~Eroder() { stop(); }

  /// In a thread of its own, settings.rate times a second, or, where that takes longer, one after the other.
  /// Sand that has far to go does so in several turns. What was dug is taken 60 times a second at least.
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

  BedReplica replica_;
  double rate_;
  std::unique_ptr<Relaxer> relaxer_;
  SandRing &dug_, &slipped_;
  std::vector<SandChange> held_;  // could not be given before the stop
  std::atomic<bool> stopping_ = true;
  ErosionReport report_;
  std::exception_ptr failure_;  // the thread's while it runs
  std::thread thread_;
};

}  // namespace sandstroke
