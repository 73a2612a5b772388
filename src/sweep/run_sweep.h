#pragma once

#include <functional>
#include <map>
#include <mutex>

#include "render/change_picture.h"
#include "sweep/sweep_folder.h"
#include "sweep/sweep_inputs.h"
#include "sweep/sweep_plan.h"

namespace sandstroke {

/// Points that one simulation serves.
using PointGroup = std::vector<std::size_t>;

/// A part of a sweep: groups i, i + of, ... of those that the plan has.
struct Shard {
  int index = 1, of = 1;  ///< counted from 1

  std::vector<PointGroup> among(const std::vector<PointGroup>& groups) const;
};

struct SweepOptions {
  int jobs = 0;  ///< cores, and at most so many simulations at a time; 0: all cores
  Shard shard;
  std::function<void(double)> progress = [](double) {};  ///< share of the points to do that are done
};

/// What a call of run_sweep did; counts are of the shard's points.
struct SweepCounters {
  std::size_t points = 0;       ///< that belong to it
  std::size_t done_before = 0;  ///< found done
  std::size_t run = 0;          ///< done now
  VerdictCounts verdicts{};     ///< of all done
  std::size_t simulations = 0;  ///< run now: points of equal sand share one
  int strokes_loaded = 0, beds_loaded = 0;
  bool interrupted = false;

  std::size_t of(PointVerdict verdict) const { return verdicts[static_cast<std::size_t>(verdict)]; }
  /// Without metrics.
  std::size_t failed() const { return of(PointVerdict::unstable) + of(PointVerdict::refused); }
};

/// A plan made ready: what each point's scene is, and which of them share their sand. Error: io, where a file
/// that is named cannot be read; input, where a golden surface is of no point's shape.
class Sweep {
 public:
  explicit Sweep(SweepPlan plan);

  const SweepPlan& plan() const { return plan_; }
  const std::vector<PointGroup>& groups() const { return groups_; }
  SweepManifest manifest() const;
  /// Points whose settings do not go together, and why.
  const std::map<std::size_t, std::string>& refused() const { return refused_; }
  /// Points that were run by this call, or by estimate(), whose stroke goes suspiciously deep:
  /// depth_warning().
  const std::map<std::size_t, std::string>& too_deep() const { return too_deep_; }
  /// That the points take, as far as is known before they run.
  std::size_t simulations() const { return groups_.size() - refused_.size(); }

  /// Runs what the folder does not hold yet of the shard's points. Points that fail are recorded; what
  /// cannot be written ends it. Stops at the next tick when interrupted(). Error: io, also where another
  /// process is at the same shard.
  SweepCounters run(const SweepFolder& folder, const SweepOptions& options);

  /// Runs one point of a group, in the middle of them, and its picture, and says what that took.
  struct Estimate {
    double seconds = 0.0;  ///< for all, on one core
    double bytes = 0.0;    ///< for all
  };
  Estimate estimate();

 private:
  struct Work;
  /// Takes group after group from what is to be done.
  void work_through(const SweepFolder& folder, Work& work);
  /// Runs these points of a group and writes their files, which it tells of each; stops when interrupted().
  /// Whether a simulation served them.
  bool run_group(const SweepFolder& folder, const std::vector<std::size_t>& points, ChangePainter& painter,
                 const std::function<void(const PointResult&)>& written);

  SweepPlan plan_;
  SweepInputs inputs_;
  std::optional<HeightField> golden_;  // surface that each is compared with
  std::vector<PointGroup> groups_;
  std::map<std::size_t, std::string> refused_;
  std::mutex too_deep_mutex_;
  std::map<std::size_t, std::string> too_deep_;
  // That scenes name, and their hashes; in order of use, which does not depend on where they are.
  std::vector<std::pair<std::string, std::string>> files_;
};

}  // namespace sandstroke
