#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/output_file.h"
#include "core/progress.h"
#include "io/png_file.h"
#include "io/scene_toml.h"
#include "run_picture.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

struct Options {
  fs::path run, output;
  std::string frame = "final", size;
  std::string view, style;
  std::optional<double> azimuth, elevation, distance, light_azimuth, light_elevation;
  std::vector<double> target;
  double contour_interval = 0.0;
  std::optional<bool> tool;  // unset: in frames, not in initial and final
};

template <class Number>
bool parse_whole(std::string_view text, Number& number) {
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  return failure == std::errc() && end == text.data() + text.size();
}

/// The value with this name, which is known to be one of them.
template <class Value>
Value named(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<Value>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// The scene's view, changed by what the command line says.
ViewSettings view_of(const RunFile& run, const Options& options) {
  ViewSettings view = scene_from_text(run.scene_text(), run.name() + ": /scene").view;
  if (!options.view.empty()) view.name = named<ViewName>(view_names, options.view);
  if (!options.style.empty()) view.style = named<RenderStyle>(style_names, options.style);
  view.azimuth = options.azimuth.value_or(view.azimuth);
  view.elevation = options.elevation.value_or(view.elevation);
  view.distance = options.distance.value_or(view.distance);
  view.light_azimuth = options.light_azimuth.value_or(view.light_azimuth);
  view.light_elevation = options.light_elevation.value_or(view.light_elevation);
  if (!options.target.empty()) view.target = Eigen::Vector3d(options.target.data());
  if (!options.size.empty()) {
    const std::string_view size = options.size;
    const std::size_t x = size.find('x');
    if (x == std::string::npos || !parse_whole(size.substr(0, x), view.width) ||
        !parse_whole(size.substr(x + 1), view.height))
      throw_input_error("--size {} is no size in pixels; write it like 1280x720", size);
  }
  return view;
}

fs::path default_output(const Options& options, const char* ending) {
  if (!options.output.empty()) return options.output;
  return beside(options.run, ending);
}

int draw_film(const RunFile& run, RunPainter& painter, const Options& options) {
  const std::vector<double> times = run.frame_times();
  if (times.empty())
    throw_input_error("{}: holds no frames; run the scene again with --frames HZ", run.name());
  const fs::path folder = default_output(options, "_frames");
  make_folder(folder);
  const bool tool = options.tool.value_or(run.has_trace());
  Progress progress("render");
  for (std::size_t k = 0; k < times.size(); ++k) {
    const Image image =
        painter.draw(run.frame(static_cast<int>(k)), tool ? std::optional(times[k]) : std::nullopt);
    write_png(folder / fmt::format("frame_{:04}.png", k), image);
    if (interrupted()) return 128 + interrupted();
    progress.update(static_cast<double>(k + 1) / static_cast<double>(times.size()));
  }
  fmt::print("{}\n", folder.string());
  return 0;
}

int render(const Options& options) {
  const RunFile run(options.run);
  RunPainter painter(run, view_of(run, options), options.contour_interval);
  if (options.frame == "all") return draw_film(run, painter, options);

  HeightGrid surface;
  double time = 0.0;
  bool tool = options.tool.value_or(false);
  if (options.frame == "initial") {
    surface = run.initial();
  } else if (options.frame == "final") {
    surface = run.final();
    time = std::numeric_limits<double>::infinity();
  } else {
    const std::vector<double> times = run.frame_times();
    int k = 0;
    if (!parse_whole(options.frame, k))
      throw_input_error("--frame {} is no frame; take final, initial, all or a number", options.frame);
    if (k < 0 || k >= static_cast<int>(times.size()))
      throw_input_error("{}: holds no frame {}, but {} of them, counted from 0", run.name(), k, times.size());
    surface = run.frame(k);
    time = times[static_cast<std::size_t>(k)];
    tool = options.tool.value_or(run.has_trace());
  }
  const fs::path output = default_output(options, ".png");
  check_output(output, {options.run});
  write_png(output, painter.draw(surface, tool ? std::optional(time) : std::nullopt));
  fmt::print("{}\n", output.string());
  return 0;
}

}  // namespace

void add_render_command(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("render", "Draw the surfaces of a run (the scene's [view], unless told otherwise)");
  command->add_option("RUN", options->run, "Run file (HDF5)")->required();
  command->add_option(
      "-o,--output", options->output,
      "Picture (PNG), or the folder for --frame all; default: RUN.png or RUN_frames/ beside RUN");
  command->add_option("--frame", options->frame, "final, initial, all, or a frame's number from 0")
      ->capture_default_str();
  command->add_option("--size", options->size, "Picture size in pixels, like 1280x720")->type_name("WxH");
  command->add_option("--view", options->view, "All of it; what changes; a map; as aimed")
      ->check(CLI::IsMember(view_names));
  command->add_option("--style", options->style, "As one sees it; heights; change since the initial surface")
      ->check(CLI::IsMember(style_names));
  command->add_option("--azimuth", options->azimuth, "Towards the camera, from +x towards +y [deg]");
  command->add_option("--elevation", options->elevation, "Of the camera above the horizon [deg]")
      ->check(CLI::Range(0.0, 90.0));
  command
      ->add_option("--distance", options->distance, "From target to camera [m]; 0: what frames the subject")
      ->check(not_negative_number());
  command->add_option("--target", options->target, "What a custom view looks at [m]")
      ->type_name("X,Y,Z")
      ->delimiter(',')
      ->expected(3);
  command->add_option("--light-azimuth", options->light_azimuth, "Towards the sun [deg]");
  command->add_option("--light-elevation", options->light_elevation, "Of the sun above the horizon [deg]");
  command
      ->add_option("--contour", options->contour_interval, "Between contour lines [m]; 0: a round interval")
      ->check(not_negative_number());
  command->add_flag_callback(
      "--tool", [options] { options->tool = true; },
      "Draw the tool; default: in frames, not in initial and final");
  command->add_flag_callback(
      "--no-tool", [options] { options->tool = false; }, "Do not draw the tool");
  command->footer("Example:  sandstroke render wscg.h5 --view stroke --style height --size 1920x1080");
  command->callback([options, &chosen] { chosen = [options] { return render(*options); }; });
}

}  // namespace sandstroke
