#include "fit/force_fit.h"

#include <spdlog/spdlog.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/print_json.h"
#include "cli/print_row.h"
#include "core/interrupt.h"
#include "fit/felt_ticks.h"
#include "io/scene_toml.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

struct FitArguments {
  std::string scene, stroke;
  std::vector<std::string> overrides, constants;
  bool json = false;
};

constexpr double most_of_it = 0.5;  // of the recorded force: below it the constants mean little

bool explains(const ForceFit& fit) { return fit.explained >= most_of_it; }

nlohmann::ordered_json as_json(const ForceFit& fit) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();  // null
  nlohmann::ordered_json json = {{"ticks", fit.ticks},
                                 {"recorded_rms", fit.recorded_rms},
                                 {"scene_residual_rms", fit.start_residual},
                                 {"residual_rms", fit.residual},
                                 {"explained", fit.explained},
                                 {"explained_reversed", fit.explained_reversed},
                                 {"stiffness", fit.stiffness},
                                 {"stiffness_error", fit.stiffness_error}};
  for (const FittedConstant& one : fit.constants)
    json[one.constant.name] = {{"value", one.value},
                               {"error", std::isfinite(one.error) ? one.error : none},
                               {"determined", one.determined()},
                               {"unit", one.constant.unit},
                               {"key", one.constant.key}};
  return json;
}

/// Values with as many digits as their error has a say in.
std::string value_text(double value, double error, const char* unit) {
  return fmt::format("{:.4g} +- {:.2g} {}", value, error, unit);
}

std::string text_of(const FittedConstant& one) {
  const char* const unit = one.constant.unit;
  if (one.determined()) return value_text(one.value, one.error, unit);
  return (std::isfinite(one.error) ? value_text(one.value, one.error, unit)
                                   : fmt::format("{:.4g} {}, the scene's", one.value, unit)) +
         ": the recording does not determine it";
}

void print_fit(const ForceFit& fit) {
  print_row("ticks",
            fmt::format("{} in contact, with a recorded force of {:.3g} N rms", fit.ticks, fit.recorded_rms));
  std::string settings;
  for (const FittedConstant& one : fit.constants) {
    print_row(one.constant.key, text_of(one));
    settings += fmt::format(" --set {}={:.6g}", one.constant.key, one.value);
  }
  print_row("k_s k_c", value_text(fit.stiffness, fit.stiffness_error, "N/m: how the force begins to grow"));
  print_row("left", fmt::format("{:.3g} N rms; with the scene's constants {:.3g} N", fit.residual,
                                fit.start_residual));
  print_row("explained",
            fmt::format("{:.0f} % of the recorded force (of its mean square)", 100.0 * fit.explained));
  if (explains(fit)) print_row("to use it", "sandstroke run SCENE" + settings);
}

void warn_of(const ForceFit& fit) {
  if (explains(fit)) return;
  if (fit.explained_reversed >= most_of_it)
    spdlog::warn(
        "the recorded force has the other sign: turned round, the model explains {:.0f} % of it. It must be "
        "the "
        "force on the hand; convert the stroke again with the other sign",
        100.0 * fit.explained_reversed);
  else
    spdlog::warn(
        "the model cannot explain this force: with the best constants {:.3g} of {:.3g} N rms are left. It "
        "grows with the depth in the sand and, sideways, with the speed; the recorded one does something "
        "else{}",
        fit.residual, fit.recorded_rms,
        fit.constants.size() < std::size(force_constants)
            ? ", or needs a constant that --constants leaves out"
            : "");
}

int fit(const FitArguments& arguments) {
  const fs::path scene_path = arguments.scene;
  std::vector<std::string> overrides = arguments.overrides;
  if (!arguments.stroke.empty()) overrides.push_back(stroke_override(arguments.stroke));
  const Scene scene = load_scene(scene_path, overrides);
  catch_interrupts();
  const std::vector<FeltTick> ticks = felt_ticks(scene, scene_path.parent_path());
  if (interrupted()) return 128 + interrupted();
  const ForceFit found = fit_force(ticks, scene.force, scene.device.max_force, arguments.constants);
  if (arguments.json)
    print_json(as_json(found));
  else
    print_fit(found);
  warn_of(found);
  return 0;
}

}  // namespace

void add_fit_command(CLI::App& app, Command& chosen) {
  auto arguments = std::make_shared<FitArguments>();
  for (const ForceConstant& constant : force_constants) arguments->constants.push_back(constant.name);
  CLI::App* command =
      app.add_subcommand("fit", "Find the force constants that come nearest to a recorded force");
  command->add_option("SCENE", arguments->scene, "Scene file (TOML)")->type_name("FILE.toml")->required();
  command
      ->add_option("--stroke", arguments->stroke,
                   "Stroke with forces, instead of the scene's: any file that 'run' takes")
      ->type_name(stroke_file_type);
  add_set_option(*command, arguments->overrides);
  command
      ->add_option("--constants", arguments->constants,
                   "Constants to fit; the others stay as in the scene. Default: k_s,k_c,k_f")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("A,B,...");
  command->add_flag("--json", arguments->json, "Print one JSON object in SI units");
  command->footer(
      "The stroke is played through the scene's sand. Depths count from the sand under the tool, which lies\n"
      "lower in the tool's own furrow. The force of the model is held against the recorded one, by least\n"
      "squares. Errors are standard errors (jackknife over ten stretches of time).\n"
      "Example:  sandstroke fit strokes/wscg/scene.toml --stroke tracing.h5 --set stroke.depth=0.004");
  command->callback([arguments, &chosen] { chosen = [arguments] { return fit(*arguments); }; });
}

}  // namespace sandstroke
