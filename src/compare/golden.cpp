#include "compare/golden.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <cstdint>
#include <optional>

#include "compare/replace_folder.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/machine.h"
#include "core/output_file.h"
#include "core/version.h"
#include "io/input_kind.h"
#include "io/png_file.h"
#include "io/toml_reader.h"
#include "render/changed_cells.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

constexpr const char* content_name = "golden.h5";
constexpr const char* picture_name = "picture.png";
constexpr const char* provenance_name = "provenance.toml";
constexpr OutputKind provenance_output{"a golden entry's provenance", "version = \"", "\nscene_hash = \""};

constexpr double height_quantum = 0x1p-30;   // m
constexpr double initial_quantum = 0x1p-20;  // m
constexpr double force_quantum = 0x1p-20;    // N
constexpr std::size_t trace_stride = 10;     // ticks

/// An entry without one of its files is damaged: that is a finding, not an error of the system.
fs::path existing(const fs::path& file) {
  if (!fs::exists(file))
    throw_input_error("{}: is missing; restore it, or make it with golden update", file.string());
  return file;
}

std::string initial_hash(const HeightGrid& heights) {
  ContentHash hash;
  for (const double height : heights.reshaped<Eigen::RowMajor>()) {
    const std::int64_t steps = std::llround(height / initial_quantum);
    hash.add(&steps, sizeof steps);
  }
  return hash.text();
}

/// Keeps NaN.
HeightGrid rounded(const HeightGrid& values, double quantum) { return (values / quantum).round() * quantum; }

// Rows of /trace/rows: time, three of the force, depth, level, contact. One table compresses as a whole.
constexpr Eigen::Index table_rows = 7;

HeightGrid as_table(const std::vector<TickRecord>& trace) {
  HeightGrid table(table_rows, static_cast<Eigen::Index>(trace.size()));
  for (Eigen::Index k = 0; k < table.cols(); ++k) {
    const TickRecord& tick = trace[static_cast<std::size_t>(k)];
    table.col(k) << tick.time, tick.device_force.array(), tick.depth, tick.level, tick.contact;
  }
  table.middleRows(1, 3) = rounded(table.middleRows(1, 3), force_quantum);
  table.middleRows(4, 2) = rounded(table.middleRows(4, 2), height_quantum);
  return table;
}

std::vector<TickRecord> from_table(const HeightGrid& table) {
  std::vector<TickRecord> trace(static_cast<std::size_t>(table.cols()));
  Eigen::Index k = 0;
  for (TickRecord& tick : trace) {
    const Eigen::VectorXd column = table.col(k++);
    tick.time = column[0];
    tick.device_force = column.segment<3>(1);
    tick.depth = column[4];
    tick.level = column[5];
    tick.contact = column[6] != 0.0;
  }
  return trace;
}

void write_content(const fs::path& path, const RunFile& run) {
  if (!run.complete())
    throw_input_error("{}: was cut off; only a complete run can become golden", run.name());
  const HeightGrid initial = run.initial(), change = height_change(run);
  if (!change.allFinite())
    throw_input_error("{}: has heights that are not finite; it cannot become golden", run.name());
  CellRange block =
      changed_cells(HeightGrid::Zero(change.rows(), change.cols()), change, 0.5 * height_quantum);
  if (block.empty()) block = {0, 1, 0, 1};

  Hdf5Writer file(path, output_kind(InputKind::golden));
  file.make_group("/surface");
  file.attribute("/surface", "rows", static_cast<double>(change.rows()));
  file.attribute("/surface", "cols", static_cast<double>(change.cols()));
  file.attribute("/surface", "cell_size", run.cell_size());
  file.attribute("/surface", "initial_hash", initial_hash(initial));
  const HeightGrid kept = change.block(block.row_begin, block.col_begin, block.rows(), block.cols());
  file.write("/surface/change", rounded(kept, height_quantum), Compression::small);
  file.attribute("/surface/change", "row", block.row_begin);
  file.attribute("/surface/change", "col", block.col_begin);
  if (const std::optional<CountedTrace> trace = golden_trace(run)) {
    file.make_group("/trace");
    file.attribute("/trace", "ticks", static_cast<double>(trace->ticks));
    file.write("/trace/rows", as_table(trace->rows), Compression::small);
  }
  file.finish();
}

/// What a run file says about itself (/provenance).
std::string provenance_of(const RunFile& run, const std::string& entry) {
  for (const auto& [name, value] : run.provenance())
    if (name == entry) return value;
  throw_input_error("{}: /provenance/{} is missing; run the scene again", run.name(), entry);
}

std::string provenance_text(const RunFile& run, const RunResult& result) {
  return fmt::format(
      "version = \"{}\"\ncommit = \"{}\"\ncompiler = \"{}\"\n"
      "scene_hash = \"{}\"    # of the resolved scene\nstroke_hash = \"{}\"   # of the stroke file\n\n"
      "[result]\nticks = {}\npasses = {}\nresidual = {:.3e}\nvolume_drift = {:.3e}\n",
      version, commit, compiler, provenance_of(run, "scene_hash"), provenance_of(run, "stroke_hash"),
      result.ticks, result.relaxation.passes, result.relaxation.residual, result.volume_drift);
}

/// Where the new entry is made, which then changes places with the old one.
fs::path new_entry(const fs::path& entry) { return part_path(fs::path(entry) += ".new"); }

/// What writing an entry leaves: the old one, or half a new one.
struct Leftovers {
  const fs::path& entry;
  ~Leftovers() {
    std::error_code ignored;
    fs::remove_all(new_entry(entry), ignored);
    drop_part(entry);
  }
};

/// Others may keep files in an entry: they come along, and files that are replaced leave their modes.
void copy_entry(const fs::path& entry, const fs::path& made) {
  fs::remove_all(made);
  if (!fs::exists(entry)) {
    fs::create_directory(made);
    return;
  }
  constexpr fs::copy_options all = fs::copy_options::recursive | fs::copy_options::copy_symlinks;
  std::error_code no_links;
  fs::copy(entry, made, all | fs::copy_options::create_hard_links, no_links);
  if (no_links) fs::copy(entry, made, all | fs::copy_options::overwrite_existing);
  fs::permissions(made, fs::status(entry).permissions());
}

Check same_check(const std::string& what, const std::string& entry_name, bool same) {
  return fact_check(
      what, same,
      same ? what + " as recorded" : fmt::format("{} changed: golden update {}", what, entry_name));
}

}  // namespace

std::optional<CountedTrace> golden_trace(const RunFile& run) {
  if (!run.has_trace()) return std::nullopt;
  const std::vector<TickRecord> trace = run.trace();
  CountedTrace kept{trace.size(), {}};
  for (std::size_t tick = 0; tick < trace.size(); tick += trace_stride) kept.rows.push_back(trace[tick]);
  return kept;
}

HeightGrid height_change(const RunFile& run) {
  const HeightGrid initial = run.initial(), final_heights = run.final();
  if (initial.rows() != final_heights.rows() || initial.cols() != final_heights.cols() || initial.size() == 0)
    throw_input_error("{}: /surface/initial and /surface/final differ in shape or are empty", run.name());
  return final_heights - initial;
}

void check_golden_replaceable(const fs::path& entry) {
  if (fs::exists(entry) && !fs::is_directory(entry))
    throw_io_error("{}: is not a folder; move it away", entry.string());
  check_replaceable(new_entry(entry), {});
  check_replaceable(entry / content_name, output_kind(InputKind::golden));
  check_replaceable(entry / picture_name, picture_output);
  check_replaceable(entry / provenance_name, provenance_output);
}

void write_golden(const fs::path& entry, const GoldenRun& run) {
  try {
    if (entry.has_parent_path()) fs::create_directories(entry.parent_path());
    const FileLock lock = take_part(entry, {});
    const Leftovers at_the_end{entry};
    const fs::path made = new_entry(entry);
    copy_entry(entry, made);
    const RunFile file(run.run_file);
    write_content(made / content_name, file);
    write_png(made / picture_name, run.picture);
    write_text_file(made / provenance_name, provenance_text(file, run.result), provenance_output);
    sync_folder_of(made / content_name);
    replace_folder(made, entry);
  } catch (const fs::filesystem_error& failure) {
    throw_io_error("{}: cannot be written ({}); check the folder's rights", entry.string(),
                   failure.code().message());
  }
}

GoldenContent read_golden(const fs::path& entry) {
  const Hdf5Reader file(existing(entry / content_name));
  if (!has_format(file, InputKind::golden) || file.number_attribute("/", "format_version") != 1.0) {
    throw_input_error("{}: is not a golden file of format 1; make it with 'sandstroke golden update'",
                      file.name());
  }
  GoldenContent content;
  content.cell_size = file.cell_size("/surface");
  content.initial_hash = file.text_attribute("/surface", "initial_hash");
  const double rows = file.number_attribute("/surface", "rows"),
               cols = file.number_attribute("/surface", "cols");
  const HeightGrid block = file.grid("/surface/change");
  const double row = file.number_attribute("/surface/change", "row");
  const double col = file.number_attribute("/surface/change", "col");
  constexpr double most = BedGeometry::most_cells;
  const bool fits = rows >= 1 && cols >= 1 && rows <= most && cols <= most && row >= 0 && col >= 0 &&
                    row + static_cast<double>(block.rows()) <= rows &&
                    col + static_cast<double>(block.cols()) <= cols;
  if (!fits) throw_input_error("{}: /surface/change does not lie in the bed; make it again", file.name());
  check_memory(4.0 * sizeof(double) * rows * cols,
               fmt::format("{}: working with a bed of {} x {} cells", file.name(), rows, cols),
               "name another file");
  content.change = HeightGrid::Zero(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(cols));
  content.change.block(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(col), block.rows(),
                       block.cols()) = block;
  if (file.has("/trace")) {
    const HeightGrid table = file.grid("/trace/rows");
    if (table.rows() != table_rows)
      throw_input_error("{}: /trace/rows does not have {} rows; make it again", file.name(), table_rows);
    const double ticks = file.number_attribute("/trace", "ticks");
    if (!(ticks >= 0.0 && ticks <= 0x1p53 && ticks == std::floor(ticks)))
      throw_input_error("{}: /trace has {} ticks; make it again", file.name(), ticks);
    content.trace = CountedTrace{static_cast<std::size_t>(ticks), from_table(table)};
  }
  return content;
}

std::vector<std::pair<std::string, std::string>> golden_provenance(const fs::path& entry) {
  const TomlReader file = TomlReader::from_file(existing(entry / provenance_name));
  std::vector<std::pair<std::string, std::string>> entries;
  for (const char* key : {"version", "commit", "compiler", "scene_hash", "stroke_hash"})
    if (file.has(key)) entries.emplace_back(key, file.text(key, ""));
  return entries;
}

Image read_golden_picture(const fs::path& entry) { return read_png(existing(entry / picture_name)); }

Comparison compare_golden(const std::string& name, const fs::path& entry, const GoldenRun& run_of_scene,
                          const Tolerances& tolerances) {
  Comparison comparison{name, {}};
  std::vector<Check>& checks = comparison.checks;
  const RunFile run(run_of_scene.run_file);

  add_checks(checks, "provenance", [&] {
    const TomlReader provenance = TomlReader::from_file(existing(entry / provenance_name));
    const auto same_hash = [&](const std::string& what) {
      const std::string key = what + "_hash";
      provenance.require(key);
      return same_check(what, name, provenance.text(key, "") == provenance_of(run, key));
    };
    return std::vector{same_hash("scene"), same_hash("stroke")};
  });
  constexpr double most_drift = 1e-12;  // of the volume moved; rounding alone is far below
  checks.push_back(limit_check(
      "volume drift", run_of_scene.result.volume_drift, most_drift, "",
      fmt::format("{}: the volume changed by {:.3g} of the sand moved; no step may lose or make sand", name,
                  run_of_scene.result.volume_drift)));
  add_checks(checks, "run complete", [&] { return std::vector{complete_check("run", run)}; });

  add_checks(checks, "golden content", [&] {
    const GoldenContent golden = read_golden(entry);
    std::vector<Check> found;
    add_checks(found, "initial surface", [&] {
      return std::vector{
          same_check("initial surface", name, golden.initial_hash == initial_hash(run.initial()))};
    });
    add_checks(found, "cell size",
               [&] { return std::vector{cell_size_check(golden.cell_size, run.cell_size())}; });
    add_checks(found, "height change", [&] {
      return std::vector{height_check("height change", HeightField(golden.change, golden.cell_size),
                                      HeightField(height_change(run), golden.cell_size), tolerances.height)};
    });
    add_checks(found, "trace", [&] { return trace_checks(golden.trace, golden_trace(run), tolerances); });
    return found;
  });
  add_checks(checks, "picture",
             [&] { return picture_checks(read_golden_picture(entry), run_of_scene.picture, tolerances); });
  return comparison;
}

}  // namespace sandstroke
