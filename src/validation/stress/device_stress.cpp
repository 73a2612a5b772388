#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "core/bisection.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "validation/stress/device_parts.h"
#include "validation/stress/loop_margins.h"
#include "validation/stress/loop_theory.h"
#include "validation/stress/stress.h"

namespace sandstroke {
namespace {

constexpr int boundaries = 60, passive_loops = 1000;
constexpr double agreement = 0.02;

void add_boundaries(StressReport& report) {
  const std::vector<LoopSettings> loops = varied_loops(boundaries);
  std::vector<Boundary> found(loops.size());
  parallel_for(loops.size(), [&](std::size_t i) { found[i] = boundary_of(loops[i]); });
  for (const Boundary& boundary : found) {
    const double off = boundary.measured / boundary.exact - 1.0;
    const bool agrees = std::abs(off) <= agreement && boundary.measured >= boundary.passive;
    report.cases.push_back(
        {"device loop, boundary",
         "measured against exact",
         boundary.settings,
         {Verdict::stable},
         agrees ? Verdict::stable : Verdict::broken,
         fmt::format("turns unstable at {:.4g} N/m, by the eigenvalue at {:.4g} N/m ({:+.2f} "
                     "%); passive up to {:.4g} N/m",
                     boundary.measured, boundary.exact, 100.0 * off, boundary.passive)});
  }
  const std::vector<LoopSettings> many = varied_loops(passive_loops);
  const auto unstable = std::count_if(many.begin(), many.end(), [](const LoopSettings& loop) {
    return spectral_radius(with_gain(loop, 0.999 * passive_gain(loop))) >= 1.0;
  });
  report.cases.push_back(
      {"device loop, boundary",
       "passive loops are stable",
       fmt::format("{} loops at 99.9 % of the gain up to which they are passive", many.size()),
       {Verdict::stable},
       unstable == 0 ? Verdict::stable : Verdict::broken,
       fmt::format("{} of them have an eigenvalue outside the unit circle", unstable)});
  report.boundaries.insert(report.boundaries.end(), found.begin(), found.end());
}

/// Finds the largest stable k_f for a device drawn along under 3 N.
void add_drag_gain(StressReport& report) {
  LoopSettings loop;
  loop.device = ideal_device();
  const ForceSettings paper;
  const auto at = [&](double k_f) {
    ForceSettings force;
    force.k_f = k_f;
    loop.against = PressedSand{force, depth_of_repulse_force(3.0, force), 0.1};
    return loop;
  };
  for (const DragVelocity velocity : {DragVelocity::sampled, DragVelocity::implicit}) {
    loop.device.drag = velocity;
    const double most = 1e6;
    const Verdict at_most = run_loop(at(most), 20'000).verdict;
    const auto settles = [&](double k_f) { return run_loop(at(k_f), 20'000).growth < 1.0; };
    const double largest =
        at_most == Verdict::stable ? most : boundary_between(paper.k_f, most, 15, geometric_mean, settles);
    const bool implicit = velocity == DragVelocity::implicit;
    report.cases.push_back({"device loop, drag",
                            implicit ? "implicit" : "sampled",
                            "1 kHz, 3 N, 0.1 m/s; k_f is raised to 1e6 s/m",
                            {implicit ? Verdict::stable : Verdict::diverged},
                            at_most,
                            fmt::format("stable up to k_f = {:.4g} s/m, {:.3g} times the paper's", largest,
                                        largest / paper.k_f)});
  }
}

}  // namespace

void stress_device_loop(StressReport& report, const StressOptions& options) {
  const std::vector<LoopMapPlan> plans = device_map_plans(options.quick);
  const double parts = static_cast<double>(plans.size()) + 2.0;
  double done = 0.0;
  const auto step = [&] { options.progress(++done / parts); };
  for (const MarkedLoop& known : known_loops()) report.margins.push_back(margins_of(known.name, known.loop));
  add_boundaries(report);
  add_drag_gain(report);
  step();
  for (const LoopMapPlan& plan : plans) {
    if (interrupted()) return;
    report.maps.push_back(draw_map(plan));
    step();
  }
  add_device_cases(report);
  step();
}

}  // namespace sandstroke
