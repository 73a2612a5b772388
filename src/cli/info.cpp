#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/standard_output.h"
#include "compare/field_difference.h"
#include "compare/trace_difference.h"
#include "core/error.h"
#include "core/terminal_text.h"
#include "io/run_file.h"
#include "io/scene_keys.h"
#include "io/scene_toml.h"
#include "run/run_summary.h"

namespace sandstroke {
namespace {

struct InfoArguments {
  std::string file;
  bool json = false, scene = false, scene_keys = false;
};

/// The lowest and highest sand of a bed from a run file. The bed is level where it has no tile.
nlohmann::ordered_json range_of(const HeightField& bed) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  const auto take = [&](double height) {
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  };
  if (bed.allocated_tiles() < bed.tile_count()) take(bed.untouched().height(bed, 0, 0));
  for (int slot = 0; slot < bed.allocated_tiles(); ++slot) {
    const CellRange cells = bed.tile_cells(bed.tile_of(slot));
    for (int row = 0; row < cells.rows(); ++row)
      std::for_each_n(bed.tile_heights(slot) + row * HeightField::tile_side, cells.cols(), take);
  }
  return {{"lowest", lowest}, {"highest", highest}};
}

/// The lowest and the highest floor of a bed, and how many cells have one.
nlohmann::ordered_json floor_facts(const HeightField& floor) {
  double lowest = std::numeric_limits<double>::infinity();
  std::int64_t count = 0;
  const auto take = [&](double height, std::int64_t cells) {
    if (!std::isfinite(height)) return;
    lowest = std::min(lowest, height);
    count += cells;
  };
  for (int tile = 0; tile < floor.tile_count(); ++tile) {
    const CellRange cells = floor.tile_cells(tile);
    if (const int slot = floor.slot_of(tile); slot < 0) {
      take(floor.untouched().highest(), std::int64_t{cells.rows()} * cells.cols());
    } else {
      for (int row = 0; row < cells.rows(); ++row)
        for (int col = 0; col < cells.cols(); ++col)
          take(floor.tile_heights(slot)[row * HeightField::tile_side + col], 1);
    }
  }
  return {{"lowest", lowest}, {"highest", floor.highest()}, {"cells", count}};
}

nlohmann::ordered_json describe(const RunFile& run) {
  nlohmann::ordered_json facts;
  facts["file"] = run.name();
  facts["complete"] = run.complete();
  const HeightField initial = run.initial_bed();
  facts["cells"] = {initial.cols(), initial.rows()};
  facts["cell_size"] = run.cell_size();
  if (const std::shared_ptr<const Ground> ground = run.ground()) facts["floor"] = floor_facts(ground->floor);
  facts["initial"] = range_of(initial);
  if (run.has_final()) {
    const HeightField final = run.final_bed();
    facts["final"] = range_of(final);
    facts["changed_cells"] = field_difference(initial, final).cells;
  }
  facts["frames"] = run.frame_times().size();
  if (const std::optional<ErrorEstimate> error = run.error_estimate())
    facts["error_estimate"] = error_json(*error);
  if (const std::vector<SourceLedger> sources = run.sources(); !sources.empty())
    facts["sources"] = sources_json(sources);
  if (const std::optional<LoadLedger> load = run.load()) facts["load"] = load_json(*load);
  if (run.has_trace()) {
    const std::vector<TickRecord> trace = run.trace();
    const auto [force, depth] = trace_peaks(trace);
    facts["trace"] = {{"ticks", trace.size()},
                      {"seconds", trace.size() > 1 ? trace.back().time - trace.front().time : 0.0},
                      {"max_force", force},
                      {"max_depth", depth}};
  }
  for (const auto& [name, value] : run.provenance()) facts["provenance"][name] = value;
  return facts;
}

void print_table(const nlohmann::ordered_json& facts) {
  std::map<std::string, std::string> units = {{"cell_size", "m"}, {"lowest", "m"},    {"highest", "m"},
                                              {"seconds", "s"},   {"max_force", "N"}, {"max_depth", "m"}};
  visit_error_fields([&](const FieldText& field, auto) {
    if (std::string(field.units) != "1") units[field.name] = field.units;
  });
  visit_source_fields([&](const FieldText& field, auto) { units[field.name] = field.units; });
  visit_load_fields(
      [&](const FieldText& field, auto) { units["/load/" + std::string(field.name)] = field.units; });
  const nlohmann::ordered_json flat = facts.flatten();
  for (const auto& [path, value] : flat.items()) {
    const std::string own = path.substr(path.rfind('/') + 1);
    const auto unit = units.contains(path) ? units.find(path) : units.find(own);
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    print_text("{:<27} {}{}\n", terminal_line(path.substr(1)), terminal_line(text),
               unit == units.end() ? "" : " " + unit->second);
  }
}

int info(const InfoArguments& arguments) {
  if (arguments.scene_keys) {
    print_text("{}", key_table(all_scene_keys()));
    return 0;
  }
  if (arguments.file.empty()) throw_input_error("info: no file given; name a run file, or add --scene-keys");
  const RunFile run(arguments.file);
  if (arguments.scene) {
    const std::string text = run.scene_text();
    if (isatty(STDOUT_FILENO))
      print_text("{}", text);
    else
      fmt::print("{}", text);  // into a file, or another program
  } else if (arguments.json) {
    print_json(describe(run));
  } else {
    print_table(describe(run));
  }
  return 0;
}

}  // namespace

void add_info_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("info", "Show the content of a run file, or all keys of a scene");
  auto arguments = std::make_shared<InfoArguments>();
  command->add_option("FILE", arguments->file, "Run file (HDF5)")->type_name("FILE.h5")->option_text("(.h5)");
  command->add_flag("--json", arguments->json, "Print one JSON object");
  command->add_flag("--scene", arguments->scene, "Print the scene of the run (TOML)");
  command->add_flag("--scene-keys", arguments->scene_keys,
                    "List every scene key with its default, unit and meaning");
  command->footer("Example:  sandstroke info wscg.h5");
  command->callback([arguments, &chosen] { chosen = [arguments] { return info(*arguments); }; });
}

}  // namespace sandstroke
