#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "cli/parse_number.h"
#include "cli/run_film.h"
#include "cli/run_picture.h"
#include "cli/run_surface.h"
#include "cli/standard_output.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/output_file.h"
#include "io/film_file.h"
#include "io/png_file.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

struct RenderArguments {
  fs::path run, output, video;
  std::string frame = "final", size;
  std::string view, style;
  std::optional<double> azimuth, elevation, distance, light_azimuth, light_elevation;
  std::vector<double> target;
  std::optional<double> contour_interval;
  std::optional<double> fps;
  std::optional<bool> tool;  // unset: in frames, not in initial and final
};

/// The value with this name. The name must be in the list.
template <class Value>
Value named(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<Value>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Refuses options that would change nothing in this view.
void reject_ignored(const RenderArguments& arguments, const ViewSettings& view) {
  if (!arguments.target.empty() && view.name != ViewName::custom)
    throw_input_error("--target needs --view custom; the view is {}",
                      view_names[static_cast<std::size_t>(view.name)]);
  if (view.name == ViewName::top)
    for (const auto& [name, given] : {std::pair("--azimuth", arguments.azimuth),
                                      {"--elevation", arguments.elevation},
                                      {"--distance", arguments.distance}})
      if (given) throw_input_error("{} needs --view overview, stroke or custom; the view is top", name);
  if (arguments.contour_interval && view.style == RenderStyle::sand)
    throw_input_error("--contour needs --style height or difference; the style sand draws no contour lines");
}

/// The scene's view, changed by the command line.
ViewSettings view_of(const SceneFile& scene, const RenderArguments& arguments) {
  ViewSettings view = scene.view;
  if (!arguments.view.empty()) view.name = named<ViewName>(view_names, arguments.view);
  if (!arguments.style.empty()) view.style = named<RenderStyle>(style_names, arguments.style);
  view.azimuth = arguments.azimuth.value_or(view.azimuth);
  view.elevation = arguments.elevation.value_or(view.elevation);
  view.distance = arguments.distance.value_or(view.distance);
  view.light_azimuth = arguments.light_azimuth.value_or(view.light_azimuth);
  view.light_elevation = arguments.light_elevation.value_or(view.light_elevation);
  if (!arguments.target.empty()) view.target = Eigen::Vector3d(arguments.target.data());
  if (!arguments.size.empty()) {
    const std::string_view size = arguments.size;
    const std::size_t x = size.find('x');
    if (x == std::string::npos || !parse_number(size.substr(0, x), view.width) ||
        !parse_number(size.substr(x + 1), view.height))
      throw_input_error("--size {} is not a size in pixels; write it like 1280x720", size);
  }
  reject_ignored(arguments, view);
  return view;
}

fs::path default_output(const RenderArguments& arguments, const std::string& ending) {
  if (!arguments.output.empty()) return arguments.output;
  return beside(arguments.run, ending);
}

int draw_pictures(const RunFile& run, const FrameLook& look, const RenderArguments& arguments) {
  const fs::path folder = default_output(arguments, "_frames");
  make_folder(folder);
  const auto picture = [&](std::size_t k) { return folder / (frame_name(k) + ".png"); };
  const std::size_t count = frame_times(run).size();
  for (std::size_t k = 0; k < count; ++k) check_output(picture(k), {arguments.run}, picture_output);
  const int exit_code = draw_frames(run, look, [&](std::size_t k, const Image& image) {
    write_png(picture(k), image);
    return true;
  });
  if (exit_code != 0) return exit_code;
  for (std::size_t k = 0; k < count; ++k)
    if (!fs::exists(picture(k)))
      throw_io_error("{}: was removed while other frames were drawn; render again", picture(k).string());
  print_text("{}\n", folder.string());
  return 0;
}

int render(const RenderArguments& arguments) {
  if (!arguments.video.empty()) check_film_name(arguments.video);
  const RunFile run(arguments.run);
  const SceneFile scene = run.scene();
  const ViewSettings view = view_of(scene, arguments);
  if (arguments.frame == "all") {
    catch_interrupts();
    const FrameLook look{view, arguments.tool, arguments.contour_interval.value_or(0.0)};
    if (arguments.video.empty()) return draw_pictures(run, look, arguments);
    check_output(arguments.video, {arguments.run}, film_output);
    const int exit_code = draw_film(run, look, arguments.fps, arguments.video);
    if (exit_code == 0) print_text("{}\n", arguments.video.string());
    return exit_code;
  }
  RunPainter painter(run, view, arguments.contour_interval.value_or(0.0));
  const RunSurface shown = surface_named(run, arguments.frame, "final, initial, all or a number");
  const bool tool = arguments.tool.value_or(shown.is_frame && run.has_trace());
  const fs::path output = default_output(arguments, shown.ending + ".png");
  check_picture_name(output);
  check_output(output, {arguments.run}, picture_output);
  write_png(output, painter.draw(shown.surface, tool ? std::optional(shown.time) : std::nullopt, shown.load));
  print_text("{}\n", output.string());
  return 0;
}

/// Adds the options that change the scene's [view].
void add_view_options(CLI::App& app, RenderArguments& arguments) {
  const std::string scenes = ". Default: the scene's [view]";
  app.add_option("--size", arguments.size, "Picture size in pixels, like 1280x720" + scenes)
      ->type_name("WxH");
  app.add_option("--view", arguments.view,
                 "View: the whole bed, the part under the stroke (if the run has a trace), a map from above, "
                 "or a custom camera" +
                     scenes)
      ->check(CLI::IsMember(view_names));
  app.add_option("--style", arguments.style,
                 "Sand in the sun, a map of heights, or a map of the change since the start" + scenes)
      ->check(CLI::IsMember(style_names));
  app.add_option("--azimuth", arguments.azimuth, "Direction of the camera, from +x towards +y [deg]" + scenes)
      ->check(number_within(degrees));
  app.add_option("--elevation", arguments.elevation, "Height of the camera above the horizon [deg]" + scenes)
      ->check(number_within({0.0, 90.0, false}));
  app.add_option("--distance", arguments.distance,
                 "Distance from target to camera [m]. 0 fits the subject into the picture" + scenes)
      ->check(not_negative_number());
  app.add_option("--target", arguments.target, "Point that a custom view looks at [m]" + scenes)
      ->type_name("X,Y,Z")
      ->delimiter(',')
      ->expected(3)
      ->check(finite_number());
  app.add_option("--light-azimuth", arguments.light_azimuth,
                 "Direction of the sun, from +x towards +y [deg]" + scenes)
      ->check(number_within(degrees));
  app.add_option("--light-elevation", arguments.light_elevation,
                 "Height of the sun above the horizon [deg]" + scenes)
      ->check(number_within(sharp_angle));
  app.add_option("--contour", arguments.contour_interval,
                 "Height between contour lines [m]. Default: 0, a round number is chosen")
      ->check(not_negative_number());
}

}  // namespace

void add_render_command(CLI::App& app, Command& chosen) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command =
      app.add_subcommand("render", "Draw the surfaces of a run, by default in the scene's [view]");
  command->add_option("RUN", arguments->run, "Run file (HDF5)")->type_name("FILE.h5")->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "Picture (PNG), or a folder for --frame all. Default: beside RUN, named RUN.png, "
                   "RUN_initial.png, RUN_frame_0000.png, ... or RUN_frames/")
      ->type_name("FILE.png");
  CLI::Option* frame =
      command->add_option("--frame", arguments->frame, "final, initial, all, or a frame's number from 0")
          ->type_name("{final,initial,all}|K")
          ->capture_default_str();
  CLI::Option* video = command
                           ->add_option("--video", arguments->video,
                                        fmt::format("Film of all frames ({}). Needs the program ffmpeg",
                                                    fmt::join(film_endings(), ", ")))
                           ->type_name(fmt::format("FILE{}", fmt::join(film_endings(), "|")))
                           ->excludes("--output");
  command
      ->add_option(
          "--fps", arguments->fps,
          "Frames per second of the film. Default: that of the run, so the film is as fast as the stroke")
      ->needs(video)
      ->check(positive_number());
  add_view_options(*command, *arguments);
  command->add_flag_callback(
      "--tool", [arguments] { arguments->tool = true; },
      "Draw the tool. Default: drawn in frames, not in the initial and final surface");
  command->add_flag_callback(
      "--no-tool", [arguments] { arguments->tool = false; }, "Do not draw the tool");
  command->footer(
      "Examples:  sandstroke render wscg.h5 --view stroke --style height --size 1920x1080\n"
      "           sandstroke render wscg.h5 --frame all --video wscg.mp4");
  command->callback([arguments, frame, video, &chosen] {
    if (video->count() > 0 && frame->count() == 0) arguments->frame = "all";
    if (video->count() > 0 && arguments->frame != "all")
      throw CLI::ValidationError("--video", "films all frames; leave out --frame " + arguments->frame);
    chosen = [arguments] { return render(*arguments); };
  });
}

}  // namespace sandstroke
