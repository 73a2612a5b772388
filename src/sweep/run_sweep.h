#pragma once

#include <functional>
#include <map>
#include <mutex>

#include "render/change_picture.h"
#include "sweep/sweep_folder.h"
#include "sweep/sweep_inputs.h"
#include "sweep/sweep_plan.h"

namespace sandstroke {

/// Points that share one simulation.
using PointGroup = std::vector<std::size_t>;

/// A part of a sweep: groups index, index + of, ... of the plan's groups.
struct Shard {
  int index = 1, of = 1;  ///< counted from 1

  std::vector<PointGroup> among(const std::vector<PointGroup>& groups) const;
};

struct SweepOptions {
  int jobs = 0;  ///< number of cores and of simulations at a time; 0: all cores
  Shard shard;
  double checkpoint = 60.0;  ///< s, after which a simulation's state is kept again
  std::function<void(double)> progress = [](double) {};  ///< gets the fraction of the points that is done
};

/// The work of one call of Sweep::run. Counts points of its shard.
struct SweepCounters {
  std::size_t points = 0;       ///< all points of the shard
  std::size_t done_before = 0;  ///< were done already
  std::size_t run = 0;          ///< run by this call
  VerdictCounts verdicts{};     ///< of all done points
  std::size_t simulations = 0;  ///< run by this call; points with equal sand share one
  int strokes_loaded = 0, beds_loaded = 0;
  bool interrupted = false;

  std::size_t of(PointVerdict verdict) const { return verdicts[static_cast<std::size_t>(verdict)]; }
  /// Points without metrics.
  std::size_t failed() const { return of(PointVerdict::unstable) + of(PointVerdict::refused); }
};

/// Which points of a sweep are looked at before it runs. some: a thousand at most, which are enough for
/// estimate().
enum class LookAt { all, some };

/// A plan ready to run: knows the scene of each point, and which points share their sand. Error: io, if a
/// named file cannot be read; input, if no point's bed has the shape of the golden surface.
class Sweep {
 public:
  explicit Sweep(SweepPlan plan, LookAt look_at = LookAt::all);

  const SweepPlan& plan() const { return plan_; }
  const std::vector<PointGroup>& groups() const { return groups_; }
  SweepManifest manifest() const;
  /// How many points were looked at. Groups and refused points are among these.
  std::size_t looked_at() const { return looked_at_; }
  /// Points whose settings contradict each other, and why.
  const std::map<std::size_t, std::string>& refused() const { return refused_; }
  /// Points, run by run() or estimate(), whose stroke goes suspiciously deep: depth_warning().
  const std::map<std::size_t, std::string>& too_deep() const { return too_deep_; }
  /// The number of simulations for all points, as far as known before they run. If not all were looked at,
  /// it goes by which axes change the sand.
  std::size_t simulations();

  /// Runs the shard's points that the folder does not hold yet. Records points that fail, and ends if a file
  /// cannot be written. Stops at the next tick when interrupted(). Error: io, also if another process runs
  /// the same shard.
  SweepCounters run(const SweepFolder& folder, const SweepOptions& options);

  /// Runs one simulation, of a group in the middle, with its picture, and estimates time and bytes of the
  /// sweep.
  struct Estimate {
    double seconds = 0.0;  ///< for all points, on one core
    double bytes = 0.0;    ///< for all points
  };
  Estimate estimate();

 private:
  struct Work;
  std::size_t estimated_simulations();
  /// Takes group after group from `work` and runs it.
  void work_through(const SweepFolder& folder, Work& work);
  /// Runs these points of a group and writes their files; calls `written` after each, got_on when a state was
  /// kept. Stops when interrupted(). checkpoint [s]: as in SweepOptions. Returns true if it ran a simulation.
  bool run_group(const SweepFolder& folder, const std::vector<std::size_t>& points, double checkpoint,
                 ChangePainter& painter, const std::function<void(const PointResult&)>& written,
                 const std::function<void()>& got_on);

  SweepPlan plan_;
  SweepInputs inputs_;
  std::optional<HeightField> golden_;  // the surface to compare with
  std::size_t looked_at_ = 0;
  std::vector<PointGroup> groups_;
  std::map<std::size_t, std::string> refused_;
  std::mutex too_deep_mutex_;
  std::map<std::size_t, std::string> too_deep_;
  // The files that scenes name, and their hashes, in the order of use, which does not depend on their paths.
  std::vector<std::pair<std::string, std::string>> files_;
};

}  // namespace sandstroke
