#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/standard_output.h"
#include "cli/stroke_parts.h"
#include "cli/table_options.h"
#include "core/error.h"
#include "core/output_file.h"
#include "core/warning.h"
#include "haptics/stroke_coverage.h"
#include "import/import_stroke.h"
#include "import/sample_files.h"
#include "io/stroke_file.h"
#include "io/stroke_format.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// Writes a stroke and prints its summary.
void write_and_tell(const std::string& file, const Stroke& stroke) {
  write_stroke_file(file, stroke);
  const StrokeSummary summary = summarize(stroke);
  spdlog::info("{}: {} samples, {:.3f} s, {:.1f} x {:.1f} x {:.1f} mm, gaps: {}", file, summary.samples,
               summary.duration, 1e3 * (summary.high.x() - summary.low.x()),
               1e3 * (summary.high.y() - summary.low.y()), 1e3 * (summary.high.z() - summary.low.z()),
               summary.gaps.size());
  warn_if_any(WarningCode::stroke_gaps, coverage_warning(stroke, file));
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

constexpr const char* convert_examples =
    "Columns and units are found by the header's names: x, y, z, vx, fx, time ..., with mm in \"x [mm]\",\n"
    "\"x (mm)\" or x_mm. So are separators, decimal marks and the encoding. The last line of the output "
    "says\n"
    "what was found. `run --stroke TABLE` reads a table without this command; its options are keys there:\n"
    "--set stroke.table.rate=1000.\n"
    "Examples\n"
    "  a recording at 1000 Hz, with force, whose header names columns and units:\n"
    "    sandstroke stroke convert trace.csv trace.h5 --rate 1000 --force-sign \"on device\"\n"
    "  a table without a header, with y up, in ms and mm:\n"
    "    sandstroke stroke convert log.txt log.h5 --time 1 --time-unit ms --position 2,-4,3 \\\n"
    "        --position-unit mm\n"
    "  a letter drawn on a screen, pen strokes separated by lines with BREAK:\n"
    "    sandstroke stroke convert letter.txt letter.h5 --columns x,y,t --position-unit px \\\n"
    "        --pixel-size 0.002 --time-unit ms --equal-times spread --skip START --pen-up BREAK \\\n"
    "        --gap-threshold 0.4";

void add_convert(CLI::App& stroke_app, Command& chosen) {
  struct Options {
    std::string in, out, source;
    TableOptions table;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* app = stroke_app.add_subcommand(
      "convert", "Make a stroke from a table of samples, or from a file of another program");
  app->add_option(
         "IN", options->in,
         "Table of numbers, one sample per line (- is standard input); or a file of a sand table (.thr), a "
         "plotter (G-code), a pen (UNIPEN, InkML), MATLAB (.mat) or ROS (.mcap, .db3, .bag)")
      ->type_name("FILE.csv|.txt|.thr|.gcode|.mat|.mcap|.db3|.bag|-")
      ->required();
  app->add_option("OUT", options->out, "Stroke to write (.h5)")->type_name("FILE.h5")->required();
  add_table_options(*app, options->table);
  app->add_option("--source", options->source,
                  "A note on the origin of the samples. Default: the file's name")
      ->option_text("TEXT");
  app->add_flag("--json", options->json, "Print the stroke as 'stroke info --json' does");
  app->footer(convert_examples);
  app->callback([&chosen, options] {
    chosen = [options] {
      const TableSettings settings = table_settings(options->table);
      check_output(options->out, sample_files(options->in, settings), stroke_output);
      ImportedStroke imported = import_stroke(options->in, settings);
      imported.stroke.source =
          options->source.empty() ? samples_name(fs::path(options->in).filename()) : options->source;
      write_and_tell(options->out, imported.stroke);
      if (options->json) print_json(stroke_json(options->out, imported.stroke));
      for (const std::string& warning : imported.warnings) warn({WarningCode::stroke_import, warning});
      spdlog::info("{}: {}", options->in, imported.description);
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
