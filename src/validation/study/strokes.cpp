// Strokes without a closed form. The truth is the same run in finer steps.
#include <spdlog/fmt/fmt.h>

#include "measure/error_estimate.h"
#include "validation/study/hand_strokes.h"
#include "validation/study/plugin_contenders.h"
#include "validation/study/stroke_replay.h"

namespace sandstroke {

Problem dynamic_problem(const ProblemOptions& options) {
  Problem problem{"dynamic",
                  "Dynamic device against a continuous loop",
                  "A hand plunges 8 mm and moves on at 0.1 m/s through a device of 0.25 kg; the truth is the "
                  "same loop at a servo rate that is all but continuous.",
                  "force_error",
                  "force, rms error of the largest",
                  "",
                  {}};
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.2;
  scene.bed.cols = scene.bed.rows = 100;
  scene.device = ideal_device();
  scene.relaxation.rate = 0.0;  // relaxation between ticks is not measured here
  Stroke stroke;
  stroke.gap_threshold = 1.0;
  stroke.time = {0.0, 0.2, 0.6};
  stroke.position = {{-0.02, 0.0, 0.002}, {-0.02, 0.0, -0.008}, {0.02, 0.0, -0.008}};

  const double finest = options.quick ? 200e3 : 1e6;  // Hz
  const auto at_rate = [&](double rate) {
    Scene one = scene;
    one.device.servo_rate = rate;
    return one;
  };
  const auto truth = std::make_shared<const Replay>(replay(at_rate(finest), stroke));
  problem.converged_to = judge(replay(at_rate(0.5 * finest), stroke), *truth).force_error;
  for (const double rate : {100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0, 10e3, 20e3, 50e3})
    problem.contenders.push_back(stroke_contender("force held for a tick",
                                                  fmt::format("servo rate {} Hz", rate), at_rate(rate),
                                                  options.threads, 1.0 / rate, stroke, truth));
  problem.check_errors = [=] {  // cells matter here too: the level is a mean of cells
    Scene eighth = scene;
    for (int halvings = 0; halvings < 3; ++halvings) eighth = second_scene(eighth, SecondSolution::finer);
    return check_errors("1000 Hz, 5 cells per radius", scene, stroke, replay(eighth, stroke));
  };
  return problem;
}

namespace {

/// The preset's scene with its cell size divided by `cells_by`, and its ways and times between relaxations by
/// `period_by`. The servo rate suits the finest.
Scene refined(ModelPreset preset, int cells_by, int period_by) {
  Scene scene = hand_scene(preset);
  scene.bed.cols *= cells_by;
  scene.bed.rows *= cells_by;
  scene.relaxation.rate *= period_by;
  scene.relaxation.way /= period_by;
  scene.relaxation.way_at_rim /= period_by;
  scene.device.servo_rate = 2000.0;
  return scene;
}

/// The accurate preset without a solid tool: sand flows into the tool, and the tool displaces it ahead again.
Scene pumping(int cells_by) {
  Scene scene = refined(ModelPreset::accurate, cells_by, 1);
  scene.tool.solid = false;
  scene.displacement.deposit = Deposit::ahead;
  scene.relaxation.way = 0.0;
  scene.relaxation.rate = 240.0 * cells_by;
  return scene;
}

/// The accurate preset with the same talus slope in every direction.
Scene isotropic(int by) {
  Scene scene = refined(ModelPreset::accurate, by, by);
  scene.relaxation.law = RelaxationLaw::isotropic;
  return scene;
}

/// A stroke that is compared with the same stroke in smaller steps.
struct StrokeCase {
  const char* name;
  const char* title;
  const char* subject;  // Problem::subject
  ModelPreset preset;
  Stroke stroke;
  bool at_rim;  // sand stands at the tool's rim: then more steps and their order matter
};

/// The preset's cell size, ways and times between relaxations, divided by a number.
std::string label_of(int by) {
  return by == 1 ? "the preset itself" : fmt::format("all steps divided by {}", by);
}

/// Adds a plugin's law of displacement, with all steps divided by 1, 2, 4 ... below `finest`.
void add_plugin_law(Problem& problem, const PluginLawSettings& plugin_laws, ModelPreset preset,
                    const Stroke& stroke, int finest, const ProblemOptions& options) {
  problem.text += " A plugin's law is compared with itself in equally fine steps.";
  const auto by_law = [=](int by) {
    Scene scene = refined(preset, by, by);
    scene.plugin_laws = plugin_laws;
    return scene;
  };
  const auto law_truth = truth_when_asked<Replay>([=] { return replay(by_law(finest), stroke); });
  for (int by = 1; by < finest; by *= 2)
    problem.contenders.push_back({series_of(plugin_laws), label_of(by),
                                  settings_of(by_law(by), options.threads), by_law(by).bed.cell_size(),
                                  [=] {
                                    const Replay run = replay(by_law(by), stroke);
                                    return Trial{run.result.wall_seconds, judge(run, law_truth())};
                                  },
                                  true});
}

// The numbers that are varied alone.
double& rate_of(Scene& s) { return s.relaxation.rate; }
double& way_at_rim_of(Scene& s) { return s.relaxation.way_at_rim; }
double& tolerance_of(Scene& s) { return s.relaxation.tolerance; }
double& step_tolerance_of(Scene& s) { return s.relaxation.step_tolerance; }
double& way_of(Scene& s) { return s.relaxation.way; }
double& distance_of(Scene& s) { return s.displacement.distance; }

/// The problem without contenders.
Problem described(const StrokeCase& given, int finest) {
  return {given.name,
          given.title,
          fmt::format("At 2 kHz. The reference is the same stroke with cell size and the time or way between "
                      "relaxations divided by {}. The dotted line is its distance from the run \"{}\".",
                      finest, label_of(finest / 2)),
          "l1",
          "misplaced sand, fraction of the sand that moves",
          "",
          given.subject};
}

Problem stroke_problem(const StrokeCase& given, const ProblemOptions& options) {
  const ModelPreset preset = given.preset;
  const Stroke stroke = given.stroke;
  const bool paper = preset == ModelPreset::paper;
  const int finest = (options.quick ? 4 : 8) / (given.at_rim ? 2 : 1);
  const std::string all_finer = "all finer";
  Problem problem = described(given, finest);
  const auto all = [preset](int by) { return refined(preset, by, by); };
  const auto truth = std::make_shared<const Replay>(replay(all(finest), stroke));
  problem.converged_to = judge(replay(all(finest / 2), stroke), *truth).l1;
  const auto add = [&](const std::string& series, const std::string& label, const Scene& scene) {
    // The paper's model has no limit, so no order is fitted.
    const double step = !paper && series == all_finer ? scene.bed.cell_size() : not_applicable;
    problem.contenders.push_back(
        stroke_contender(series, label, scene, options.threads, step, stroke, truth));
  };
  const auto divide = [&](const std::string& series, const auto& scene_by) {
    for (int by = 1; by < finest; by *= 2) add(series, label_of(by), scene_by(by));
  };
  divide(all_finer, all);
  for (const PluginLawSettings& plugin_laws : options.plugin_laws)
    if (!plugin_laws.displacement.empty())
      add_plugin_law(problem, plugin_laws, preset, stroke, finest, options);
  if (!paper) divide("without a solid tool, 240 relaxations a second", pumping);
  const auto vary = [&](const std::string& series, std::initializer_list<double> values,
                        double& (*knob)(Scene&), const std::string& label) {
    for (const double value : values) {
      Scene scene = all(1);
      knob(scene) = value;
      add(series, fmt::format(fmt::runtime(label), value), scene);
    }
  };
  vary("relaxation rate alone", {15.0, 30.0, 60.0, 120.0, 240.0, 480.0, 960.0, 1920.0}, rate_of,
       paper ? "{} relaxations a second" : "{} relaxations a second besides those by way");
  if (!paper) divide("law isotropic", isotropic);
  problem.check_errors = [=] {
    return check_errors("5 cells per radius", refined(preset, 1, 1), stroke, *truth);
  };
  if (given.at_rim) vary("way at the rim alone", {0.025, 0.05, 0.1, 0.2, 0.4}, way_at_rim_of, "{} radii");
  for (int by = 1; by <= finest; by *= 2) {
    const Scene scene = refined(preset, by, 1);
    add("cell size alone", fmt::format("{:.3g} cells per radius", scene.tool.radius / scene.bed.cell_size()),
        scene);
  }
  if (given.at_rim) return problem;
  vary("tolerance alone", {1e-2, 1e-3, 1e-4}, tolerance_of, "tolerance {}");
  if (paper) return problem;
  vary("step tolerance alone", {1.0, 0.1, 0.01}, step_tolerance_of, "step tolerance {}");
  vary("way between relaxations alone", {0.05, 0.1, 0.2, 0.4, 0.8}, way_of, "{} radii");
  vary("place of pushed sand alone", {1.05, 1.1, 1.15, 1.2, 1.25}, distance_of, "{} radii from the axis");
  return problem;
}

}  // namespace

Problem accurate_stroke_problem(const ProblemOptions& options) {
  return stroke_problem({"stroke-accurate", "A stroke 4 mm deep, accurate preset", "Stroke 4 mm deep",
                         ModelPreset::accurate, s_curve(0.004, 0.25, options.quick), false},
                        options);
}

Problem deep_stroke_problem(const ProblemOptions& options) {
  return stroke_problem({"stroke-deep", "A stroke as deep as the tool's radius, accurate preset",
                         "Stroke as deep as the tool's radius", ModelPreset::accurate,
                         s_curve(0.01, 0.25, options.quick), true},
                        options);
}

Problem reworked_stroke_problem(const ProblemOptions& options) {
  return stroke_problem(
      {"stroke-reworked", "A scribble 5 mm deep over its own furrows, accurate preset",
       "Scribble over its furrows", ModelPreset::accurate, scribble(0.005, 0.25, options.quick), true},
      options);
}

Problem paper_stroke_problem(const ProblemOptions& options) {
  return stroke_problem({"stroke-paper", "A stroke 4 mm deep, paper preset", "", ModelPreset::paper,
                         s_curve(0.004, 0.25, options.quick), false},
                        options);
}

Problem hands_problem(const ProblemOptions& options) {
  Problem problem{
      "hands",
      "Influence of the hand",
      "A curved stroke 4 mm deep, and one as deep as the radius, with five cells per radius at 1 kHz, at the "
      "speeds, with the noise in z and the slopes of hands, against the same preset's stroke at 0.25 m/s "
      "without any. A stroke's outcome should depend on none of them.",
      "l1",
      "misplaced sand, fraction of the sand that moves",
      "",
      {}};
  struct Case {
    const char* name;
    ModelPreset preset;
    double depth;  // m
  };
  for (const Case& hands : {Case{"paper", ModelPreset::paper, 0.004},
                            {"accurate", ModelPreset::accurate, 0.004},
                            {"accurate, deep", ModelPreset::accurate, 0.01}}) {
    const Scene scene = hand_scene(hands.preset);
    const Stroke clean = s_curve(hands.depth, 0.25, options.quick);
    const auto truth = std::make_shared<const Replay>(replay(scene, clean));
    const auto add = [&](const std::string& what, const std::string& label, const Stroke& stroke,
                         double rate = 0.0) {
      Scene one = scene;
      if (rate > 0.0) one.relaxation.rate = rate;
      Contender contender = stroke_contender(fmt::format("{}, {}", hands.name, what), label, one,
                                             options.threads, not_applicable, stroke, truth);
      if (what == "speed")  // its forces and positions belong to other times
        contender.run = [run = contender.run] {
          Trial trial = run();
          trial.score.force_error = trial.score.position_error = not_applicable;
          return trial;
        };
      problem.contenders.push_back(std::move(contender));
    };
    for (const double speed : {0.02, 0.05, 0.1, 0.5, 1.0})
      add("speed", fmt::format("{} m/s", speed), s_curve(hands.depth, speed, options.quick));
    for (const double noise : {2e-6, 10e-6, 55e-6})
      add("noise", fmt::format("{:.0f} um rms", 1e6 * noise), with_noise(clean, noise));
    for (const double rate : {60.0, 960.0})
      add("slopes of 5 %", fmt::format("{:.0f} relaxations a second", rate), with_slopes(clean, 0.05), rate);
  }
  return problem;
}

}  // namespace sandstroke
