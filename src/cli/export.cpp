#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/run_surface.h"
#include "cli/standard_output.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/machine.h"
#include "core/output_file.h"
#include "export/grid_files.h"
#include "export/mesh_files.h"
#include "export/trace_table.h"
#include "io/png_file.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

struct ExportArguments {
  fs::path run, output;
  std::string frame;           // empty: final
  std::optional<double> base;  // mm
  bool surface_only = false;
  std::vector<double> range;  // m, heights of a PNG's black and white
};

/// The format of a file name's ending: heights, triangles, or neither (a PNG, the trace).
struct ExportFormat {
  std::string_view ending;
  OutputKind kind;
  const GridFormat* grid;
  const MeshFormat* mesh;
  const char* text;
};

constexpr std::string_view png = ".png", trace = ".csv";

const std::vector<ExportFormat>& formats() {
  static const std::vector<ExportFormat> all = {
      {png, height_png_output, nullptr, nullptr,
       "heights, 16-bit grayscale, y upwards. The file contains their range, so bed.surface.file can read "
       "it"},
      {".npy", npy_format.kind, &npy_format, nullptr, "heights [m], for numpy.load: float64 (y, x)"},
      {".asc", esri_grid_format.kind, &esri_grid_format, nullptr,
       "heights [m], an ESRI ASCII grid for QGIS, GDAL and others"},
      {".stl", stl_format.kind, nullptr, &stl_format,
       "triangles [mm], for 3-D printing: the bed with walls and a floor"},
      {".ply", ply_format.kind, nullptr, &ply_format, "the same"},
      {".obj", obj_format.kind, nullptr, &obj_format, "the same"},
      {trace, trace_output, nullptr, nullptr, "the trace: a line per tick, units in the first line"},
  };
  return all;
}

constexpr double default_base = 3.0;  // mm

const ExportFormat& format_of(const fs::path& output) {
  std::vector<std::string_view> endings;
  for (const ExportFormat& format : formats()) {
    if (format.ending == small_ending(output)) return format;
    endings.push_back(format.ending);
  }
  throw_input_error("{}: unknown file name ending; use one of {}", output.string(), fmt::join(endings, ", "));
}

/// Refuses options that would change nothing in this format.
void reject_ignored(const ExportArguments& arguments, const ExportFormat& format) {
  const auto reject = [&](bool given, const char* option, bool taken, const char* wanted) {
    if (given && !taken)
      throw_input_error("{} works only for {}; {} has another format", option, wanted,
                        arguments.output.string());
  };
  reject(!arguments.frame.empty(), "--frame", format.ending != trace, "surfaces");
  reject(arguments.base.has_value(), "--base", format.mesh, "triangles (.stl, .ply, .obj)");
  reject(arguments.surface_only, "--surface-only", format.mesh, "triangles (.stl, .ply, .obj)");
  reject(!arguments.range.empty(), "--range", format.ending == png, "PNG files");
}

void check_room(const fs::path& output, double bytes) {
  check_disk(output, bytes, "choose another place or free disk space");
}

/// The floor under the sand, as maps have it: not-a-number where there is none.
HeightGrid floor_of(const RunFile& run, const ExportArguments& arguments) {
  const std::shared_ptr<const Ground> ground = run.ground();
  if (!ground)
    throw_input_error("{}: has no floor under its sand; export final, initial or a frame", run.name());
  const HeightGrid floor = ground->floor.grid();
  const auto gaps = (!floor.isFinite()).count();
  if (gaps > 0 && !format_of(arguments.output).grid)
    throw_input_error(
        "{}: {} of {} cells have no floor, which only .npy and .asc can say; export one of them", run.name(),
        gaps, floor.size());
  return floor.isFinite().select(floor, std::numeric_limits<double>::quiet_NaN());
}

HeightGrid surface_of(const RunFile& run, const ExportArguments& arguments) {
  if (arguments.frame == "floor") return floor_of(run, arguments);
  HeightGrid heights = surface_named(run, arguments.frame.empty() ? "final" : arguments.frame,
                                     "final, initial, floor or a number")
                           .surface.grid();
  if (!heights.isFinite().all())
    throw_input_error("{}: holds heights that are not finite numbers; run the scene again", run.name());
  return heights;
}

/// The range of a PNG: the given one; or that of the PNG from which the bed was read, so that it comes out
/// the same; or the range of the heights.
GrayRange range_of(const RunFile& run, const HeightGrid& heights, const ExportArguments& arguments) {
  if (!arguments.range.empty()) return {arguments.range[0], arguments.range[1]};
  const double low = heights.minCoeff(), high = heights.maxCoeff();
  const SurfaceSettings begun = run.scene().bed.surface;
  const auto [black, white] = std::minmax(begun.low, begun.high);
  if (begun.kind == SurfaceKind::file && black < white && black <= low && high <= white)
    return {begun.low, begun.high};
  return {low, high > low ? high : low + 1e-3};
}

double cells_of(const RunFile& run) { return static_cast<double>(run.rows()) * run.cols(); }

void write_height_png(const RunFile& run, const ExportArguments& arguments) {
  check_room(arguments.output, 2.0 * cells_of(run));
  const HeightGrid heights = surface_of(run, arguments);
  const GrayRange range = range_of(run, heights, arguments);
  const auto [low, high] = std::minmax(range.black, range.white);
  if (const auto beyond = (heights < low || heights > high).count(); beyond > 0)
    spdlog::warn("{} of {} cells are outside the range and were clipped", beyond, heights.size());
  write_text_file(arguments.output, encode_height_png(heights, range), height_png_output);
  spdlog::info("{}: black is {} m, white {} m; one gray level is {:.3g} um", arguments.output.string(),
               range.black, range.white, 1e6 * (high - low) / 65535.0);
}

bool write_grid(const GridFormat& format, const RunFile& run, const ExportArguments& arguments) {
  check_room(arguments.output, format.bytes(cells_of(run)));
  const HeightGrid heights = surface_of(run, arguments);
  return write_file(arguments.output, format.kind,
                    [&](std::ostream& file) { return format.write(file, heights, run.cell_size()); });
}

bool write_mesh(const MeshFormat& format, const RunFile& run, const ExportArguments& arguments) {
  const MeshSize size = mesh_size(run.rows(), run.cols(), !arguments.surface_only);
  const auto check_count = [&](std::uint64_t count, double most, const char* what) {
    if (static_cast<double>(count) > most)
      throw_input_error("{}: {} x {} cells need {} {}, but {} holds at most {:.0f}; export heights (.npy)",
                        arguments.output.string(), run.cols(), run.rows(), count, what, format.kind.name,
                        most);
  };
  check_count(size.vertices, format.most_vertices, "vertices");
  check_count(size.triangles, format.most_triangles, "triangles");
  check_room(arguments.output, format.bytes(size));
  const HeightGrid heights = surface_of(run, arguments);
  std::optional<double> base;
  if (!arguments.surface_only) base = 1e-3 * arguments.base.value_or(default_base);
  const BedMesh mesh(heights, run.cell_size(), base);
  const double side = 1e3 * run.cell_size();
  spdlog::info("{}: {:.4g} x {:.4g} x {:.4g} mm, {} triangles", arguments.output.string(), side * run.cols(),
               side * run.rows(), 1e3 * (heights.maxCoeff() - heights.minCoeff() + base.value_or(0.0)),
               size.triangles);
  return write_file(arguments.output, format.kind,
                    [&](std::ostream& file) { return format.write(file, mesh); });
}

bool write_trace(const RunFile& run, const ExportArguments& arguments) {
  if (!run.has_trace())
    throw_input_error("{}: has no trace; run a scene with a stroke and output.trace = true", run.name());
  const Table table = trace_table(run.trace(), run.trace_content());
  return write_file(arguments.output, trace_output, [&](std::ostream& file) {
    write_csv(file, table);
    return !interrupted();
  });
}

int export_run(const ExportArguments& arguments) {
  const ExportFormat& format = format_of(arguments.output);
  reject_ignored(arguments, format);
  if (!arguments.range.empty() && arguments.range[0] == arguments.range[1])
    throw_input_error("--range {0},{0} is empty; name two heights", arguments.range[0]);
  const RunFile run(arguments.run);
  check_output(arguments.output, {arguments.run}, format.kind);
  catch_interrupts();
  bool whole = true;
  if (format.mesh)
    whole = write_mesh(*format.mesh, run, arguments);
  else if (format.grid)
    whole = write_grid(*format.grid, run, arguments);
  else if (format.ending == png)
    write_height_png(run, arguments);
  else
    whole = write_trace(run, arguments);
  if (!whole) return 128 + interrupted();
  print_text("{}\n", arguments.output.string());
  return 0;
}

}  // namespace

void add_export_command(CLI::App& app, Command& chosen) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command =
      app.add_subcommand("export", "Write a surface or the trace of a run for other programs");
  command->add_option("RUN", arguments->run, "Run file (HDF5)")->type_name("FILE.h5")->required();
  std::string endings, footer = "The ending of the output file chooses the format:\n";
  for (const ExportFormat& format : formats()) {
    endings += (endings.empty() ? "" : "|") + std::string(format.ending);
    footer += fmt::format("  {}  {}\n", format.ending, format.text);
  }
  command->add_option("-o,--output", arguments->output, "File to write. Its ending chooses the format")
      ->type_name("FILE" + endings)
      ->required();
  command
      ->add_option(
          "--frame", arguments->frame,
          "Which surface: final, initial, the floor under the sand, or a frame's number from 0. Default: "
          "final")
      ->type_name("{final,initial,floor}|K");
  CLI::Option* base = command
                          ->add_option("--base", arguments->base,
                                       fmt::format("Thickness of the floor below the lowest sand [mm]. "
                                                   "Default: {}",
                                                   default_base))
                          ->check(number_within({0.1, 10'000.0}));
  command
      ->add_flag("--surface-only", arguments->surface_only,
                 "Triangles of the surface, without walls and floor")
      ->excludes(base);
  command
      ->add_option("--range", arguments->range,
                   "Heights of a PNG's black and white [m]. Default: those of the PNG from which the bed was "
                   "read, if all sand lies between them; otherwise the lowest and the highest sand")
      ->type_name("BLACK,WHITE")
      ->delimiter(',')
      ->expected(2)
      ->check(finite_number());
  command->footer(footer +
                  "Examples:  sandstroke export wscg.h5 -o wscg.stl --base 5\n"
                  "           sandstroke export wscg.h5 -o trace.csv");
  command->callback([arguments, &chosen] { chosen = [arguments] { return export_run(*arguments); }; });
}

}  // namespace sandstroke
