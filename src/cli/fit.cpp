#include "fit/fitted_law.h"

#include <spdlog/fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/standard_output.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "io/scene_toml.h"
#include "sim/device_force.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

struct FitArguments {
  std::string scene, stroke;
  std::vector<std::string> overrides, constants;
  bool json = false;
};

constexpr double most_of_it = 0.5;  // fraction of the recorded force; below it the constants mean little

bool explains(const ForceFit& fit) { return fit.explained >= most_of_it; }

/// NaN and infinity become null in JSON. A limit that is null: the recording sets none.
nlohmann::ordered_json as_json(const ForceFit& fit) {
  nlohmann::ordered_json json = {{"ticks", fit.ticks},
                                 {"recorded_rms", fit.recorded_rms},
                                 {"scene_residual_rms", fit.start_residual},
                                 {"residual_rms", fit.residual},
                                 {"explained", fit.explained},
                                 {"explained_reversed", fit.explained_reversed},
                                 {"left_alike_for", fit.noise_length},
                                 {fit.of_scale.json_name, fit.scale.value},
                                 {fit.of_scale.json_name + std::string("_error"), fit.scale.error}};
  if (!fit.combination.powers.isZero(0.0)) {
    json["combination"] = {{"value", fit.combination.value}, {"error", fit.combination.error}};
    for (const FittedConstant& one : fit.constants)
      if (one.kept) json["combination"]["powers"][one.constant.name] = fit.combination.powers[one.index];
  }
  for (const FittedConstant& one : fit.constants)
    json[one.constant.name] = {{"value", one.value},
                               {"error", one.error},
                               {"interval_95", {one.likely.low, one.likely.high}},
                               {"kept", one.kept},
                               {"determined", one.determined()},
                               {"given_error", one.given_error > 0.0 ? one.given_error : one.error},
                               {"unit", one.constant.unit},
                               {"key", one.constant.key}};
  return json;
}

std::string with_unit(std::string number, const char* unit) { return *unit ? number + ' ' + unit : number; }

/// Writes a value and its error, with units.
std::string value_text(double value, double error, const char* unit) {
  return with_unit(std::isnan(error) ? fmt::format("{:.4g} (given)", value)
                                     : fmt::format("{:.4g} +- {:.2g}", value, error),
                   unit);
}

std::string likely_text(const Interval& likely) {
  const bool has_low = likely.low > 0.0, has_high = std::isfinite(likely.high);
  if (has_low && has_high) return fmt::format("95 %: {:.4g} to {:.4g}", likely.low, likely.high);
  if (has_low) return fmt::format("95 %: above {:.4g}", likely.low);
  if (has_high) return fmt::format("95 %: below {:.4g}", likely.high);
  return "95 %: any value";
}

/// The kept constants, as in "given k_c = 0.5 1/m".
std::string given_text(const ForceFit& fit) {
  std::vector<std::string> kept;
  for (const FittedConstant& one : fit.constants)
    if (one.kept)
      kept.push_back(with_unit(fmt::format("{} = {:.4g}", one.constant.name, one.value), one.constant.unit));
  return fmt::format("given {}", fmt::join(kept, ", "));
}

std::string text_of(const FittedConstant& one, const ForceFit& fit) {
  const char* const unit = one.constant.unit;
  const std::string likely = likely_text(one.likely), value = fmt::format("{:.4g}", one.value);
  if (one.determined()) return value_text(one.value, one.error, unit) + " (" + likely + ")";
  const std::string unknown = ": the recording alone does not determine it (" + likely + ")";
  if (one.kept) return with_unit(value, unit) + " (from the scene)" + unknown;
  if (one.given_error > 0.0)
    return value_text(one.value, one.given_error, unit) + ", " + given_text(fit) + unknown;
  return with_unit(value, unit) + unknown;
}

/// The combination that is determined, such as "resistance (tool_friction / 0.4)^0.31".
std::string combination_text(const ForceFit& fit) {
  std::string text = fit.of_scale.name;
  for (const FittedConstant& one : fit.constants)
    if (const double power = fit.combination.powers[one.index]; power != 0.0)
      text += fmt::format(" ({} / {:.4g})^{:.2f}", one.constant.name, one.value, power);
  return text + " = " + value_text(fit.combination.value, fit.combination.error, fit.of_scale.unit);
}

std::string noise_text(const ForceFit& fit) {
  if (fit.noise_length == 0.0) return "differs from one tick to the next";
  return fmt::format("stays alike for {:.2g} s, which the errors allow for if the recording is much longer",
                     fit.noise_length);
}

/// The constants in the form of --set.
std::vector<std::string> settings_of(const ForceFit& fit) {
  std::vector<std::string> settings;
  for (const FittedConstant& one : fit.constants)
    settings.push_back(fmt::format("{}={:.6g}", one.constant.key, one.value));
  return settings;
}

void print_fit(const ForceFit& fit) {
  print_row("ticks",
            fmt::format("{} in contact, with a recorded force of {:.3g} N rms", fit.ticks, fit.recorded_rms));
  for (const FittedConstant& one : fit.constants) print_row(one.constant.key, text_of(one, fit));
  const std::string meaning = fmt::format("{}: {}", fit.of_scale.unit, fit.of_scale.meaning);
  print_row(fit.of_scale.name, value_text(fit.scale.value, fit.scale.error, meaning.c_str()));
  if (!fit.combination.powers.isZero(0.0)) print_row("best known", combination_text(fit));
  print_row("residual", fmt::format("{:.3g} N rms; with the scene's constants {:.3g} N", fit.residual,
                                    fit.start_residual));
  print_row("what is left", noise_text(fit));
  print_row("explained",
            fmt::format("{:.0f} % of the recorded force (of its mean square)", 100.0 * fit.explained));
}

void warn_of(const ForceFit& fit, const FittedLaw& law) {
  if (fit.explained_reversed >= most_of_it)
    spdlog::warn(
        "the recorded force seems to have the wrong sign: with the sign reversed, the model explains {:.0f} "
        "% of it. It must be the force on the hand; convert the stroke again with the other --force-sign",
        100.0 * fit.explained_reversed);
  else
    spdlog::warn(
        "the model cannot explain this force: with the best constants {:.3g} of {:.3g} N rms remain. The "
        "model's force {}; the recorded force behaves differently{}",
        fit.residual, fit.recorded_rms, law.nature,
        fit.constants.size() < law.constants.size() ? ", or needs a constant that --constants leaves out"
                                                    : "");
}

/// Says how to play a scene with the fitted constants, or why no scene can have them.
void show_use(const ForceFit& fit, const FitArguments& arguments, const SceneFile& fitted) {
  const std::vector<std::string> settings = settings_of(fit);
  std::string options;
  for (const std::string& one : arguments.overrides) options += " " + scene_option(one);
  for (const std::string& one : settings) options += " " + scene_option(one);
  try {
    const Scene scene = scene_from_text(scene_text(fitted), arguments.scene, settings);
    const std::string doubt = make_device_force(scene)->theory_warning(scene, 0.0);
    if (!arguments.json) print_row("to use it", "sandstroke run SCENE" + options);
    if (!doubt.empty()) spdlog::warn("{}", doubt);
  } catch (const Error& refusal) {
    spdlog::warn("no scene can have these constants: {}. Is the force in newtons, and are tool and {} right?",
                 refusal.what(), fit.of_scale.json_name);
  }
}

int fit(const FitArguments& arguments) {
  const fs::path scene_path = arguments.scene;
  std::vector<std::string> overrides = arguments.overrides;
  if (!arguments.stroke.empty()) overrides.push_back(stroke_override(arguments.stroke));
  const SceneFile scene = load_scene(scene_path, overrides);
  const FittedLaw& law = fitted_law(scene.force.law);
  const std::vector<bool> asked = chosen_constants(law.constants, arguments.constants);
  catch_interrupts();
  const std::optional<ForceFit> found = law.fit(felt_stroke(scene, scene_path.parent_path()), asked);
  if (!found) return 128 + interrupted();
  if (arguments.json)
    print_json(as_json(*found));
  else
    print_fit(*found);
  if (explains(*found))
    show_use(*found, arguments, scene);
  else
    warn_of(*found, law);
  return 0;
}

/// Lists the laws with their constants, and marks those that are not fitted by default.
std::string constants_text() {
  std::string text;
  for (const FittedLaw& law : fitted_laws()) {
    std::vector<std::string> names;
    for (const ForceConstant& one : law.constants)
      names.push_back(one.name + std::string(one.by_default ? "" : " (only with --constants)"));
    text += fmt::format("  {:<12}{}\n", law.name, fmt::join(names, ", "));
  }
  return text;
}

}  // namespace

void add_fit_command(CLI::App& app, Command& chosen) {
  auto arguments = std::make_shared<FitArguments>();
  CLI::App* command = app.add_subcommand("fit", "Find the force constants that fit a recorded force best");
  command->add_option("SCENE", arguments->scene, "Scene file (TOML)")->type_name("FILE.toml")->required();
  command
      ->add_option("--stroke", arguments->stroke,
                   "Stroke with forces, instead of the scene's: any file that 'run' takes")
      ->type_name(stroke_file_type);
  add_set_option(*command, arguments->overrides);
  command
      ->add_option("--constants", arguments->constants,
                   "Constants of force.law to fit; the others stay as in the scene. Default: see below")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("A,B,...");
  command->add_flag("--json", arguments->json, "Print one JSON object in SI units");
  command->footer(fmt::format(
      "Constants of force.law:\n"
      "{}"
      "With the last two laws the force depends on friction_angle and density through one number, the\n"
      "sand's resistance, so the scene's force.density must be right.\n"
      "\n"
      "fit plays the stroke through the scene's sand. Depths count from the sand under the tool, which lies\n"
      "lower in the tool's own furrow. fit compares the model's force with the recorded one by least\n"
      "squares. +- is half of the 68 % interval, with the other fitted constants free. Intervals allow for\n"
      "noise that stays alike for much less than the recording. A constant is determined if the force\n"
      "depends on it and its 95 % interval lies between half and twice its value. Any other constant keeps\n"
      "the scene's value, unless the recording contradicts it. An error before 'given' holds only for the\n"
      "values that are given. k_s and friction_angle are always fitted.\n"
      "Example:  sandstroke fit strokes/wscg/scene.toml --stroke tracing.h5 --set stroke.depth=0.004",
      constants_text()));
  command->callback([arguments, &chosen] { chosen = [arguments] { return fit(*arguments); }; });
}

}  // namespace sandstroke
