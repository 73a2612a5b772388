#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "core/range.h"

namespace sandstroke {

/// The command that the user called: runs and returns the exit code.
using Command = std::function<int()>;

// Check an option's number and describe it in a user's words. They also refuse NaN.
CLI::Validator positive_number();
CLI::Validator not_negative_number();
CLI::Validator finite_number();
CLI::Validator number_within(Range range);

/// Adds --set, which overrides keys of a scene, and --unset, which takes them out. For load_scene. Returns
/// --set.
CLI::Option* add_set_option(CLI::App& command, std::vector<std::string>& overrides);

/// The option that gives an override: "--set key=value" or "--unset key".
std::string scene_option(const std::string& override_text);

/// The files that shells offer for a stroke: scripts, recordings, and all that `stroke convert` reads.
inline constexpr const char* stroke_file_type = "FILE.toml|.h5|.csv|.txt|.thr|.gcode|.mat|.mcap|.db3|.bag";

/// The override with which --stroke FILE (- is standard input) replaces the scene's stroke.
std::string stroke_override(const std::string& file);

// Each adds one subcommand, which sets `chosen` when it is called.
void add_init_command(CLI::App& app, Command& chosen);
void add_run_command(CLI::App& app, Command& chosen);
void add_render_command(CLI::App& app, Command& chosen);
void add_report_command(CLI::App& app, Command& chosen);
void add_export_command(CLI::App& app, Command& chosen);
void add_compare_command(CLI::App& app, Command& chosen);
void add_golden_command(CLI::App& app, Command& chosen);
void add_sweep_command(CLI::App& app, Command& chosen);
void add_fit_command(CLI::App& app, Command& chosen);
void add_stroke_command(CLI::App& app, Command& chosen);
void add_record_command(CLI::App& app, Command& chosen);
void add_bench_command(CLI::App& app, Command& chosen);
void add_stress_command(CLI::App& app, Command& chosen);
void add_info_command(CLI::App& app, Command& chosen);
void add_completion_command(CLI::App& app, Command& chosen);
void add_help_command(CLI::App& app, Command& chosen);

}  // namespace sandstroke
