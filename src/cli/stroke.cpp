#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/stroke_parts.h"
#include "core/error.h"
#include "core/log.h"
#include "core/output_file.h"
#include "haptics/stroke_coverage.h"
#include "io/stroke_csv.h"
#include "io/stroke_file.h"
#include "io/stroke_format.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// Writes a stroke and tells what came out.
void write_and_tell(const std::string& file, const Stroke& stroke) {
  write_stroke_file(file, stroke);
  const StrokeSummary summary = summarize(stroke);
  spdlog::info("{}: {} samples, {:.3f} s, {:.1f} x {:.1f} x {:.1f} mm, gaps: {}", file, summary.samples,
               summary.duration, 1e3 * (summary.high.x() - summary.low.x()),
               1e3 * (summary.high.y() - summary.low.y()), 1e3 * (summary.high.z() - summary.low.z()),
               summary.gaps.size());
  if (summary.joined_samples == 0) {
    spdlog::warn("the tool never draws: all samples are further apart in time than the gap threshold of {} s",
                 stroke.gap_threshold);
  }
  warn_if_any(coverage_warning(stroke, file));
}

// --- script ---

void add_script(CLI::App& stroke_app, Command& chosen) {
  struct Options {
    std::string in, out;
  };
  auto options = std::make_shared<Options>();
  CLI::App* app = stroke_app.add_subcommand(
      "script", "Sample a scripted stroke (TOML) and write it as a recorded one (HDF5)");
  app->add_option("IN", options->in, "Script (.toml)")->type_name("FILE.toml")->required();
  app->add_option("OUT", options->out, "Stroke to write (.h5)")->type_name("FILE.h5")->required();
  app->footer(
      "A scene can use a script directly. This command is for looking at its samples. It turns\n"
      "forces into depths with the default [force]; a scene uses its own [force].\n"
      "All keys of a script: sandstroke help script\n"
      "Example:  sandstroke stroke script stroke.toml stroke.h5");
  app->callback([&chosen, options] {
    chosen = [options] {
      check_output(options->out, {options->in}, stroke_output);
      if (fs::path(options->in).extension() != ".toml")
        throw_input_error("{}: is not a script; name a .toml file", options->in);
      write_and_tell(options->out, load_stroke(options->in, ForceSettings{}));
      return 0;
    };
  });
}

// --- convert ---

struct ConvertOptions {
  std::string in, out;
  std::vector<std::string> position, velocity, force, columns;
  std::string position_unit, velocity_unit, force_unit, time_unit, time;
  double rate = 0.0, pixel_size = 0.0;
  std::string pen_up, skip, source, frame = "bed";
  std::string equal_times = "error";
  double gap_threshold = Stroke{}.gap_threshold;
};

Stroke convert(const ConvertOptions& options) {
  StrokeCsvFormat format;
  format.position = {options.position, position_unit(options.position_unit, options.pixel_size)};
  if (!options.velocity.empty()) format.velocity = {options.velocity, speed_unit(options.velocity_unit)};
  if (!options.force.empty()) format.force = {options.force, force_unit(options.force_unit)};
  if (options.time.empty() == (options.rate == 0.0))
    throw_input_error("the times are unknown or given twice; give either --time with --time-unit, or --rate");
  if (!options.time.empty()) {
    format.time = options.time;
    format.time_unit = time_unit(options.time_unit);
  }
  format.rate = options.rate;
  format.columns = options.columns;
  format.pen_up = options.pen_up;
  format.skip = options.skip;
  format.equal_times = options.equal_times == "drop"     ? EqualTimes::drop
                       : options.equal_times == "spread" ? EqualTimes::spread
                                                         : EqualTimes::error;

  Stroke stroke = read_stroke_csv(options.in, format);
  stroke.gap_threshold = options.gap_threshold;
  stroke.frame = options.frame;
  stroke.source = options.source.empty() ? fs::path(options.in).filename().string() : options.source;
  return stroke;
}

constexpr const char* convert_examples =
    "Examples\n"
    "  a recording at 1000 Hz, with force:\n"
    "    sandstroke stroke convert trace.csv trace.h5 --rate 1000 \\\n"
    "        --position x_m,y_m,z_m --position-unit m --force fx_N,fy_N,fz_N --force-unit N\n"
    "  a letter drawn on a screen, without header line, pen strokes separated by lines with BREAK:\n"
    "    sandstroke stroke convert letter.txt letter.h5 --columns x,y,t \\\n"
    "        --position x,y --position-unit px --pixel-size 0.002 --time t --time-unit ms \\\n"
    "        --equal-times spread --skip START --pen-up BREAK --gap-threshold 0.4";

/// Of the samples.
void add_time_options(CLI::App& app, ConvertOptions& options) {
  auto* time =
      app.add_option("--time", options.time, "Column of the time (or give --rate)")->option_text("T");
  auto* time_unit = app.add_option("--time-unit", options.time_unit, "s, ms, us or ns")->option_text("UNIT");
  time->needs(time_unit);
  time_unit->needs(time);
  app.add_option("--rate", options.rate, "Samples per second, instead of --time")
      ->check(positive_number())
      ->excludes(time)
      ->option_text("HZ");
  app.add_option("--equal-times", options.equal_times,
                 "What to do with equal times: error (default), drop (keep the first sample) or spread "
                 "(space them evenly)")
      ->check(CLI::IsMember({"error", "drop", "spread"}))
      ->option_text("RULE");
}

/// How lines are read, and what is said of them.
void add_reading_options(CLI::App& app, ConvertOptions& options) {
  app.add_option("--pen-up", options.pen_up,
                 "Lines with this word lift the pen. The next sample starts a new pen stroke")
      ->option_text("WORD");
  app.add_option("--skip", options.skip, "Lines with this word are skipped")->option_text("WORD");
  app.add_option("--gap-threshold", options.gap_threshold,
                 "Samples further apart are not joined: the tool lifts (default 0.1 s)")
      ->check(positive_number())
      ->option_text("S");
  app.add_option("--frame", options.frame, "Axes of the positions: bed (default) or device")
      ->check(CLI::IsMember({"bed", "device"}))
      ->option_text("FRAME");
  app.add_option("--source", options.source, "A note on the origin of the samples. Default: the file's name")
      ->option_text("TEXT");
}

void add_convert(CLI::App& stroke_app, Command& chosen) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* app = stroke_app.add_subcommand("convert", "Make a stroke from a table of samples (CSV)");
  app->add_option("IN", options->in,
                  "Table of comma-separated numbers: one sample per line, column names in the first line")
      ->type_name("FILE.csv|.txt")
      ->required();
  app->add_option("OUT", options->out, "Stroke to write (.h5)")->type_name("FILE.h5")->required();

  // A list is one argument, so that file names may follow it.
  const auto add_list = [app](const char* name, std::vector<std::string>& columns, const char* help) {
    return app->add_option(name, columns, help)->delimiter(',')->allow_extra_args(false);
  };
  add_list("--position", options->position,
           "Columns of the tip's position: x,y,z with z up, or x,y (then z = 0)")
      ->expected(2, 3)
      ->required()
      ->option_text("X,Y[,Z] REQUIRED");
  app->add_option("--position-unit", options->position_unit, "m, cm, mm, um, in or px")
      ->required()
      ->option_text("UNIT REQUIRED");
  app->add_option("--pixel-size", options->pixel_size, "Metres per pixel, for unit px")
      ->check(positive_number())
      ->option_text("M");

  add_time_options(*app, *options);

  const auto add_vector = [&](const std::string& name, std::vector<std::string>& columns, std::string& unit,
                              const char* help, const char* units) {
    auto* vector = add_list(name.c_str(), columns, help)->expected(2, 3)->option_text("X,Y[,Z]");
    auto* vector_unit = app->add_option(name + "-unit", unit, units)->option_text("UNIT");
    vector->needs(vector_unit);
    vector_unit->needs(vector);
  };
  add_vector("--velocity", options->velocity, options->velocity_unit, "Columns of the tip's velocity",
             "m/s, cm/s or mm/s");
  add_vector("--force", options->force, options->force_unit, "Columns of the recorded force", "N or mN");

  add_list("--columns", options->columns, "Names of all columns, for a file without a header line")
      ->option_text("A,B,...");
  add_reading_options(*app, *options);
  app->footer(convert_examples);
  app->callback([&chosen, options] {
    chosen = [options] {
      check_output(options->out, {options->in}, stroke_output);
      write_and_tell(options->out, convert(*options));
      return 0;
    };
  });
}

}  // namespace

void add_stroke_command(CLI::App& app, Command& chosen) {
  CLI::App* stroke_app =
      app.add_subcommand("stroke", "Make, convert, repair and describe strokes (hand motions)");
  stroke_app->require_subcommand(1);
  add_convert(*stroke_app, chosen);
  add_script(*stroke_app, chosen);
  add_stroke_info_command(*stroke_app, chosen);
  add_stroke_repair_command(*stroke_app, chosen);
}

}  // namespace sandstroke
