// Nozzles and sinks that nobody would build. All sand is where the ledger says, none gets below the floor,
// and the run ends; or the scene is refused with an error sentence.
#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "validation/stress/judged_run.h"
#include "validation/stress/stress.h"

namespace sandstroke {
namespace {

constexpr double source_bed = 0.12;  // m, half a tile more than one
constexpr int source_cells = 70;
using P = Eigen::Vector3d;

SourceSettings nozzle(const P& at, double rate, double radius = 0.0, double stop = 0.3) {
  SourceSettings source;
  source.at = at;
  source.rate = rate;
  source.radius = radius;
  source.stop = stop;
  return source;
}

Scene bed_with_sources(ModelPreset preset, std::vector<SourceSettings> sources) {
  Scene scene;
  scene.preset = preset;
  apply_model_preset(scene);
  scene.bed.width = scene.bed.depth = source_bed;
  scene.bed.cols = scene.bed.rows = source_cells;
  scene.sources = std::move(sources);
  scene.output.trace = false;
  return scene;
}

/// Says whether a ledger does not add up: what was poured has landed or is in the air, no sink took what it
/// did not ask for, and the bed has got the difference.
std::string fault_of_ledgers(const Scene& scene, const RunResult& result) {
  // What is less than the last bit of a height waits, or was too much.
  const double cell_area = scene.bed.cell_size() * scene.bed.cell_size(),
               bit = 1e-15 * source_bed * cell_area * scene.strength.density;
  double given = 0.0, handled = 0.0;  // kg
  for (const SourceLedger& one : result.sources) {
    for (const double mass : {one.poured, one.landed, one.in_air, one.asked, one.taken})
      if (!std::isfinite(mass) || mass < 0.0) return fmt::format("a ledger says {} kg", mass);
    if (!(std::abs(one.poured - one.landed - one.in_air) <= 1e-14 * one.poured))
      return fmt::format("{} kg poured, {} kg landed, {} kg in the air", one.poured, one.landed, one.in_air);
    if (!(one.taken <= one.asked * (1.0 + 1e-12) + bit))
      return fmt::format("{} kg taken, {} kg asked for", one.taken, one.asked);
    given += one.landed - one.taken;
    handled += one.landed + one.taken;
  }
  const double off = std::abs(given - result.given_volume * scene.strength.density);
  if (!(off <= 1e-12 * handled + bit * source_cells * source_cells))
    return fmt::format("the bed got {} kg, the ledgers say {} kg",
                       result.given_volume * scene.strength.density, given);
  return "";
}

JudgedRun judged_sources(const Scene& scene, const std::optional<Stroke>& stroke) {
  JudgedRun run = judged_on_threads(scene, starting_bed(scene.bed), stroke);
  if (run.verdict != Verdict::stable && run.verdict != Verdict::not_converged) return run;
  if (const std::string fault = fault_of_ledgers(scene, run.result); !fault.empty()) {
    run.verdict = Verdict::broken;
    run.reason = fault;
  }
  return run;
}

struct HostileSources {
  const char *name, *settings;
  std::vector<SourceSettings> sources;
  std::vector<Verdict> expected;
  GroundSettings ground = {};
};

std::vector<HostileSources> hostile_sources() {
  const std::vector<Verdict> rests = {Verdict::stable}, refused = {Verdict::refused};
  constexpr double edge = 0.5 * source_bed;
  GroundSettings shallow, stone;
  shallow.floor = -0.01;
  stone.floor = -0.02;
  StoneSettings& ball = stone.stones.emplace_back();
  ball.radius = 0.02;
  return {
      {"huge rates",
       "1e3 to 1e300 kg/s onto a point",
       {nozzle(P(0.0, 0.0, 0.1), 1e3), nozzle(P(0.01, 0.0, 0.1), 1e300)},
       refused},
      {"tiny rates",
       "5e-324 to 1e-12 kg/s",
       {nozzle(P(0.0, 0.0, 0.1), 5e-324), nozzle(P(0.01, 0.0, 0.1), 1e-300), nozzle(P(0.02, 0.0, 0.1), 1e-12),
        nozzle(P(0.0, 0.01, -0.1), -1e-300), nozzle(P(0.0, 0.01, -0.1), -1e-12)},
       rests},
      {"on the wall",
       "in a corner and on an edge, a point and 10 mm wide",
       {nozzle(P(edge, edge, 0.1), 0.05), nozzle(P(-edge, 0.0, 0.1), 0.05, 0.01),
        nozzle(P(0.0, -edge, -0.01), -0.05, 0.01)},
       rests},
      {"beyond the wall", "1 pm", {nozzle(P(edge + 1e-12, 0.0, 0.1), 0.05)}, refused},
      {"far beyond the wall", "1e300 m", {nozzle(P(1e300, 0.0, 0.1), 0.05)}, refused},
      {"in the sand", "1 m below it", {nozzle(P(0.0, 0.0, -1.0), 0.05)}, rests},
      {"from high up",
       "1 km and 1 m",
       {nozzle(P(0.0, 0.0, 1000.0), 0.05), nozzle(P(0.0, 0.0, 1.0), 0.05)},
       rests},
      {"from beyond the sky", "1e300 m", {nozzle(P(0.0, 0.0, 1e300), 0.05)}, refused},
      {"wider than the bed",
       "10 m, a source and a sink",
       {nozzle(P(0.0, 0.0, 0.1), 5.0, 10.0), nozzle(P(0.02, 0.0, -0.001), -2.0, 10.0)},
       rests},
      {"a sink for all",
       "more than lies on a shallow floor",
       {nozzle(P(0.0, 0.0, -1.0), -100.0, 0.2), nozzle(P(0.0, 0.0, -1.0), -1e300)},
       rests,
       shallow},
      {"a sink without a floor", "down to 50 mm", {nozzle(P(0.0, 0.0, -0.05), -1e6, 0.005)}, rests},
      {"a sink in the air", "100 mm above", {nozzle(P(0.0, 0.0, 0.1), -1.0, 0.02)}, rests},
      {"a source into a sink",
       "at one place, at one rate",
       {nozzle(P(0.0, 0.0, 0.02), 0.1), nozzle(P(0.0, 0.0, -0.01), -0.1)},
       rests},
      {"onto and under a stone",
       "a source above, sinks in and beside it",
       {nozzle(P(0.0, 0.0, 0.05), 0.1, 0.004), nozzle(P(0.0, 0.0, 0.0), -0.1, 0.004),
        nozzle(P(0.02, 0.0, -1.0), -0.1, 0.004)},
       rests,
       stone},
      {"open for a moment",
       "1 ns, and a bit of a second",
       {nozzle(P(0.0, 0.0, 0.1), 10.0, 0.0, 1e-9), nozzle(P(0.01, 0.0, 0.1), 10.0, 0.0, 5e-324)},
       rests},
      {"never open", "stop at its start", {nozzle(P(0.0, 0.0, 0.1), 0.1, 0.0, 0.0)}, refused},
      {"open for ever", "1e300 s", {nozzle(P(0.0, 0.0, 0.1), 0.1, 0.0, 1e300)}, refused},
      {"no rate", "0 kg/s", {nozzle(P(0.0, 0.0, 0.1), 0.0)}, refused},
  };
}

/// Pours without a stroke, and under a tool that goes through the sand there.
std::optional<Stroke> stroke_under_sources(bool any) {
  if (!any) return {};
  Stroke stroke;
  for (int i = 0; i <= 300; ++i) {
    stroke.time.push_back(0.001 * i);
    stroke.position.emplace_back(0.03 - 0.0002 * i, 0.0, -0.004);
  }
  return stroke;
}

StressCase pour_hostile(const HostileSources& hostile, bool quick) {
  Variations all("sources", hostile.name, hostile.settings, hostile.expected);
  for (const ModelPreset preset : {ModelPreset::paper, ModelPreset::accurate})
    for (const bool tool : {false, true}) {
      if (quick && tool != (preset == ModelPreset::accurate)) continue;
      Scene scene = bed_with_sources(preset, hostile.sources);
      scene.ground = hostile.ground;
      if (tool) scene.stroke.emplace().file = "in memory";
      all.add(judged_sources(scene, stroke_under_sources(tool)),
              fmt::format("{}, {}", preset_name(preset), tool ? "a tool under them" : "no tool"));
    }
  return all.done();
}

/// Sand that is poured and has no passes, or no time, to come to rest.
StressCase pour_without_rest() {
  Variations all("sources", "hardly relaxed",
                 "relaxation.max_passes of 0 and 1, relaxation.rate of 0 and 1e6 Hz",
                 {Verdict::stable, Verdict::not_converged});
  for (const ModelPreset preset : {ModelPreset::paper, ModelPreset::accurate})
    for (const int passes : {0, 1})
      for (const double rate : {0.0, 1e6}) {
        Scene scene =
            bed_with_sources(preset, {nozzle(P(0.0, 0.0, 0.1), 0.1), nozzle(P(0.02, 0.0, -0.01), -0.1)});
        scene.ground.floor = -0.005;
        scene.relaxation.max_passes = passes;
        scene.relaxation.rate = rate;
        all.add(judged_sources(scene, {}),
                fmt::format("{}, {} passes, {} Hz", preset_name(preset), passes, rate));
      }
  return all.done();
}

/// Servo rates and cells from one end of their range to the other.
StressCase pour_at_any_rate() {
  Variations all("sources", "any servo rate and cells", "1 Hz to 100 kHz; cells of 1e-100 to 1e100 m",
                 {Verdict::stable, Verdict::refused});
  for (const double servo_rate : {1.0, 7.0, 1e5}) {
    Scene scene = bed_with_sources(ModelPreset::accurate, {nozzle(P(0.0, 0.0, 0.1), 0.1, 0.003, 0.05)});
    scene.device.servo_rate = servo_rate;
    all.add(judged_sources(scene, {}), fmt::format("{} Hz", servo_rate));
  }
  for (const double size : {1e-100, 1e-9, 1.0, 1e9, 1e100}) {
    Scene scene = bed_with_sources(ModelPreset::accurate,
                                   {nozzle(P(0.0, 0.0, size), 1e3 * size * size * size, 2.0 * size, 0.05)});
    scene.bed.width = scene.bed.depth = source_cells * size;
    all.add(judged_run(scene, starting_bed(scene.bed)), fmt::format("cells of {} m", size));
  }
  return all.done();
}

}  // namespace

void stress_sources(StressReport& report, const StressOptions& options) {
  const std::vector<HostileSources> sources = hostile_sources();
  double done = 0.0;
  for (const HostileSources& hostile : sources) {
    report.cases.push_back(pour_hostile(hostile, options.quick));
    options.progress(done += 0.9 / static_cast<double>(sources.size()));
  }
  report.cases.push_back(pour_without_rest());
  report.cases.push_back(pour_at_any_rate());
  options.progress(1.0);
}

}  // namespace sandstroke
