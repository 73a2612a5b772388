#include "compare/golden.h"

#include <spdlog/fmt/fmt.h>

#include "compare/compare_runs.h"
#include "compare/replace_folder.h"
#include "compare/scene_difference.h"
#include "core/error.h"
#include "core/output_file.h"
#include "core/version.h"
#include "io/input_kind.h"
#include "io/png_file.h"
#include "io/toml_reader.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

constexpr const char* content_name = "golden.h5";
constexpr const char* picture_name = "picture.png";
constexpr const char* provenance_name = "provenance.toml";
constexpr OutputKind provenance_output{"a golden entry's provenance", "version = \"", "\nscene_hash = \""};

/// An entry without one of its files is damaged: that is a finding, not an error of the system.
fs::path existing(const GoldenEntry& entry, const char* name) {
  const fs::path file = entry.folder / name;
  if (!fs::exists(file))
    throw_input_error("{}: is missing; restore it, or make it again with: {}", file.string(), entry.update);
  return file;
}

/// An entry of a run file's /provenance.
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

/// Where the new entry is made before it changes places with the old one.
fs::path new_entry(const fs::path& entry) { return part_path(fs::path(entry) += ".new"); }

/// Removes what writing an entry leaves: the old one, or half a new one.
struct Leftovers {
  const fs::path& entry;
  ~Leftovers() {
    std::error_code ignored;
    fs::remove_all(new_entry(entry), ignored);
    drop_part(entry);
  }
};

/// Copies an entry. Other files in it come along, and new files take the modes of those that they replace.
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

/// change: what has changed, or empty.
Check same_check(const std::string& what, const GoldenEntry& entry, const std::string& change) {
  if (change.empty()) return passed_check(what, "as recorded");
  return failed_check(what, fmt::format("{}; if this change is intended, run: {}", change, entry.update));
}

Check scene_check(const GoldenEntry& entry, const GoldenContent& golden, const RunFile& run) {
  const std::string change = scene_difference(golden.scene, run.scene_text());
  return same_check("scene", entry, change.empty() ? "" : "changed: " + change);
}

Check stroke_check(const GoldenEntry& entry, const RunFile& run) {
  constexpr const char* key = "stroke_hash";
  const TomlReader provenance = TomlReader::from_file(existing(entry, provenance_name));
  provenance.require(key);
  if (provenance.text(key, "") == provenance_of(run, key)) return same_check("stroke", entry, "");
  const TomlReader scene = TomlReader::from_text(run.scene_text(), run.name() + ": /scene");
  return same_check("stroke", entry,
                    fmt::format("changed: {} holds another stroke",
                                scene.has("stroke") ? scene.text("stroke.file", "") : "the scene"));
}

Check drift_check(double drift) {
  constexpr double most = 1e-12;  // of the volume moved; rounding alone is far below
  Check check = limit_check("volume drift", drift, most, "",
                            fmt::format("{:.3g} of the sand that moved was lost or created", drift));
  if (!check.passed) check.sentence += "; every step must keep the volume: please report this";
  return check;
}

/// The checks against golden.h5.
std::vector<Check> content_checks(const GoldenEntry& entry, const RunFile& run,
                                  const Tolerances& tolerances) {
  const GoldenContent golden = read_golden(entry);
  std::vector<Check> checks;
  add_checks(checks, "scene", [&] { return std::vector{scene_check(entry, golden, run)}; });
  add_checks(checks, "initial surface", [&] {
    const bool same = golden.initial_hash == initial_hash(run.initial());
    return std::vector{same_check("initial surface", entry, same ? "" : "changed")};
  });
  add_checks(checks, "cell size",
             [&] { return std::vector{cell_size_check(golden.cell_size, run.cell_size())}; });
  add_checks(checks, "height change", [&] {
    return std::vector{height_check("height change", HeightField(golden.change, golden.cell_size),
                                    HeightField(height_change(run), golden.cell_size), tolerances.height)};
  });
  add_checks(checks, "trace", [&] { return trace_checks(golden.trace, whole_trace(run), tolerances); });
  return checks;
}

}  // namespace

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
    write_golden_content(made / content_name, file);
    write_png(made / picture_name, run.picture);
    write_text_file(made / provenance_name, provenance_text(file, run.result), provenance_output);
    sync_folder_of(made / content_name);
    replace_folder(made, entry);
  } catch (const fs::filesystem_error& failure) {
    throw_io_error("{}: cannot be written ({}); check the folder's permissions", entry.string(),
                   failure.code().message());
  }
}

GoldenContent read_golden(const GoldenEntry& entry) {
  return read_golden_content(existing(entry, content_name), entry.update);
}

Image read_golden_picture(const GoldenEntry& entry) { return read_png(existing(entry, picture_name)); }

std::vector<std::pair<std::string, std::string>> golden_provenance(const GoldenEntry& entry) {
  const TomlReader file = TomlReader::from_file(existing(entry, provenance_name));
  std::vector<std::pair<std::string, std::string>> entries;
  for (const char* key : {"version", "commit", "compiler", "scene_hash", "stroke_hash"})
    if (file.has(key)) entries.emplace_back(key, file.text(key, ""));
  return entries;
}

Comparison compare_golden(const GoldenEntry& entry, const GoldenRun& run_of_scene,
                          const Tolerances& tolerances) {
  Comparison comparison{entry.name, {}};
  std::vector<Check>& checks = comparison.checks;
  const RunFile run(run_of_scene.run_file);

  add_checks(checks, "run complete", [&] {
    Check complete = complete_check("run", run);
    complete.seconds = run_of_scene.seconds;
    return std::vector{complete};
  });
  checks.push_back(drift_check(run_of_scene.result.volume_drift));
  add_checks(checks, "provenance", [&] { return std::vector{stroke_check(entry, run)}; });
  add_checks(checks, "golden content", [&] { return content_checks(entry, run, tolerances); });
  add_checks(checks, "picture",
             [&] { return picture_checks(read_golden_picture(entry), run_of_scene.picture, tolerances); });
  return comparison;
}

}  // namespace sandstroke
