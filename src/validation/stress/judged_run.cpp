#include "validation/stress/judged_run.h"

#include <spdlog/fmt/fmt.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/hash.h"
#include "sand/ground.h"

namespace sandstroke {
namespace {

bool monotone(const RelaxationSettings& settings) {
  return settings.law != RelaxationLaw::paper || settings.method == RelaxationMethod::rkl;
}

/// How far sand lies below the floor anywhere [m]; 0: nowhere.
double below_floor(const HeightField& bed) {
  double most = 0.0;
  if (bed.ground())
    for (int row = 0; row < bed.rows(); ++row)
      for (int col = 0; col < bed.cols(); ++col) most = std::max(most, bed.floor(row, col) - bed(row, col));
  return most;
}

/// Looks at every tick, and at the bed between passes, ever more seldom.
class Watch : public SimulationObserver {
 public:
  explicit Watch(bool on_floor) : on_floor_(on_floor) {}
  void on_tick(const TickRecord& tick) override {
    for (const Eigen::Vector3d* force : {&tick.device_force, &tick.repulse_force, &tick.drag_force,
                                         &tick.floor_force, &tick.wrench.force, &tick.wrench.torque}) {
      all_numbers_ = all_numbers_ && force->allFinite();
      forces_.add(force->data(), sizeof(Eigen::Vector3d));
    }
  }
  void on_pass(std::int64_t passes, const BedNow& bed_now) override {
    if (on_floor_ && (passes & (passes - 1)) == 0) below_ = std::max(below_, below_floor(bed_now()));
  }
  bool all_numbers() const { return all_numbers_; }
  double below() const { return below_; }
  std::string forces() const { return forces_.text(); }

 private:
  bool on_floor_, all_numbers_ = true;
  double below_ = 0.0;  // m
  ContentHash forces_;
};

/// Says what is wrong with a run that ended. Empty: nothing is wrong.
std::string fault_of(const HeightField& start_bed, const HeightField& end_bed, const Watch& watch,
                     bool keeps_range, JudgedRun& run) {
  const HeightGrid start = start_bed.grid(), end = end_bed.grid();
  if (!end.isFinite().all()) return "a height is not a number";
  const RunResult& r = run.result;
  if (!std::isfinite(r.device.max_force) || !std::isfinite(r.device.absorbed_energy))
    return "a figure is not a number";
  if (!watch.all_numbers()) return "a force is not a number";
  if (const double below = std::max(watch.below(), below_floor(end_bed)); below > 0.0)
    return fmt::format("sand lies {:.3g} m below the floor", below);

  const double low = start.minCoeff(), high = start.maxCoeff(),
               size = std::max(std::abs(low), std::abs(high));
  const double lost = std::abs(r.volume_final - r.volume_initial - r.given_volume);
  const double tallest = std::max(size, end.abs().maxCoeff());
  const double rounding = 1e-14 * tallest * start_bed.cell_area() * static_cast<double>(end.size());
  if (!(lost <= 1e-12 * r.moved_volume + rounding))
    return fmt::format("{:.3g} m^3 are lost of {:.3g} that moved", lost, r.moved_volume);

  const double outside = std::max({0.0, low - end.minCoeff(), end.maxCoeff() - high});
  run.overshoot = size > 0.0 ? outside / size : 0.0;
  if (keeps_range && run.overshoot > 1e-12)
    return fmt::format("a height left the range of the starting heights by {:.3g} of the highest",
                       run.overshoot);
  return "";
}

}  // namespace

JudgedRun judged_run(const Scene& scene, const HeightField& bed, const std::optional<Stroke>& stroke,
                     Observers observers) {
  JudgedRun run;
  try {
    check_scene(scene, "scene");
    const HeightField start = on_ground(bed, scene);
    Watch watch(scene.ground.is_solid());
    observers.push_back(&watch);
    const Solution end = solve(scene, start, stroke, std::move(observers));
    run.result = end.result;
    run.bits = content_hash(end.surface) + watch.forces();
    const bool only_relaxes = !stroke && scene.sources.empty();
    run.reason = fault_of(start, end.surface, watch, only_relaxes && monotone(scene.relaxation), run);
    if (!run.reason.empty()) return run;
    const RelaxationOutcome& last = run.result.relaxation;
    run.verdict = last.converged ? Verdict::stable : Verdict::not_converged;
    if (!last.converged) run.reason = fmt::format("residual {:.3g}", last.residual);
  } catch (const Error& error) {
    run.verdict = Verdict::refused;
    run.reason = error.what();
  }
  return run;
}

JudgedRun judged_on_threads(const Scene& scene, const HeightField& bed, const std::optional<Stroke>& stroke) {
  const auto on_at_most = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return judged_run(scene, bed, stroke);
  };
  const JudgedRun one = on_at_most(1);
  JudgedRun several = on_at_most(4);
  if (one.bits == several.bits && one.verdict == several.verdict) return several;
  several.verdict = Verdict::broken;
  several.reason = fmt::format("more threads give other bits than one; {} {}", several.reason, one.reason);
  return several;
}

Variations::Variations(std::string group, std::string name, std::string settings,
                       std::vector<Verdict> expected)
    : case_{std::move(group),    std::move(name), std::move(settings),
            std::move(expected), Verdict::broken, ""} {}

void Variations::add(const JudgedRun& run, const std::string& variation) {
  StressCase one = case_;
  one.verdict = run.verdict;
  ++met_[static_cast<std::size_t>(run.verdict)];
  if (one.surprise() && surprises_++ == 0) {
    case_.verdict = run.verdict;
    case_.detail = fmt::format("{}: {} {}", variation, name_of(run.verdict), run.reason);
  }
  if (run.verdict == Verdict::refused) refusal_ = run.reason;
  overshoot_ = std::max(overshoot_, run.overshoot);
  drift_ = std::max(drift_, run.result.volume_drift);
  passes_ = std::max(passes_, run.result.relaxation.passes);
}

StressCase Variations::done() const {
  StressCase all = case_;
  const auto most = std::max_element(met_.begin(), met_.end());
  if (surprises_ == 0) all.verdict = static_cast<Verdict>(most - met_.begin());
  std::string counts;
  for (std::size_t i = 0; i < met_.size(); ++i)
    if (met_[i] > 0)
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", met_[i], name_of(static_cast<Verdict>(i)));
  if (surprises_ > 0) {
    all.detail = fmt::format("{} ({})", all.detail, counts);
  } else {
    all.detail = counts;
    if (passes_ > 0) all.detail += fmt::format("; at most {} passes", passes_);
    if (overshoot_ > 1e-12) all.detail += fmt::format(", out of the starting range by {:.2g}", overshoot_);
    if (drift_ > 0.0) all.detail += fmt::format(", volume drift {:.1e}", drift_);
    if (!refusal_.empty()) all.detail += "; " + refusal_;
  }
  return all;
}

}  // namespace sandstroke
