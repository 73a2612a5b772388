#include "compare/golden_scenes.h"

#include <spdlog/fmt/fmt.h>

#include <set>

#include "core/error.h"
#include "core/output_file.h"
#include "core/shell_text.h"
#include "core/stopwatch.h"
#include "core/temporary_folder.h"
#include "io/scene_toml.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

constexpr const char* tolerances_name = "tolerances.toml";

std::set<std::string> folders_in(const fs::path& parent) {
  std::set<std::string> names;
  if (!fs::is_directory(parent)) return names;
  for (const fs::directory_entry& child : fs::directory_iterator(parent)) {
    // An update that was killed leaves NAME.part.
    if (child.is_directory() && child.path().extension() != ".part")
      names.insert(child.path().filename().string());
  }
  return names;
}

/// Says which file named by the scene does not exist; empty where all exist. That is a finding about this
/// scene, not a failure of the machine. Error: where the scene cannot be read.
std::string missing_input(const fs::path& scene_file) {
  for (const fs::path& file : input_files(load_scene(scene_file), scene_file.parent_path()))
    if (!fs::exists(file))
      return fmt::format("{} does not exist; restore it, or commit it too", file.string());
  return "";
}

/// Refuses a result with which a run ends in exit code 3.
void refuse_doubtful(const fs::path& scene, const RunResult& result) {
  const auto refuse = [&](const std::string& reason, const char* remedy) {
    throw Error(ErrorKind::unstable,
                fmt::format("{}: {}, so the golden entry stays as it was; {}, or, where the scene shows just "
                            "this, add --doubtful",
                            scene.string(), reason, remedy));
  };
  if (!result.relaxation.converged)
    refuse(fmt::format("the sand is not at rest (residual {:.2e})", result.relaxation.residual),
           "raise relaxation.max_passes or relaxation.tolerance");
  if (result.device.swings_from)
    refuse(fmt::format("from {:.3f} s on the device swings by itself", *result.device.swings_from),
           "run the scene to see what to change");
}

}  // namespace

GoldenEntry GoldenFolders::entry(const std::string& name) const {
  std::string update = "sandstroke golden update " + shell_quoted(name);
  const GoldenFolders usual;
  if (strokes != usual.strokes) update += " --strokes " + shell_quoted(strokes);
  if (golden != usual.golden) update += " --golden " + shell_quoted(golden);
  return {name, golden / name, update};
}

std::vector<std::string> golden_names(const GoldenFolders& folders,
                                      const std::vector<std::string>& asked_for) {
  if (!fs::is_directory(folders.strokes)) {
    throw_io_error(
        "{}: is not a folder; start sandstroke in the folder that contains it, or name it with --strokes",
        folders.strokes.string());
  }
  std::set<std::string> known = folders_in(folders.golden);
  for (const std::string& name : folders_in(folders.strokes))
    if (fs::exists(folders.scene(name))) known.insert(name);
  if (known.empty()) {
    throw_input_error("{}: has no NAME/scene.toml, and {} has no golden entry; check both folders",
                      folders.strokes.string(), folders.golden.string());
  }
  if (asked_for.empty()) return {known.begin(), known.end()};
  for (const std::string& name : asked_for) {
    if (!known.contains(name)) {
      throw_input_error("{}: neither {} nor {} exists; known scenes: {}", name, folders.scene(name).string(),
                        folders.entry(name).folder.string(), fmt::join(known, ", "));
    }
  }
  return asked_for;
}

Comparison check_golden(const std::string& name, const GoldenFolders& folders, const SceneRunner& runner,
                        const GivenTolerances& options, const ComparisonWatcher& compared) {
  const Stopwatch watch;
  const auto failed = [&](const std::string& name_of_check, const std::string& sentence) {
    Check check = failed_check(name_of_check, sentence);
    check.seconds = watch.seconds();
    return Comparison{name, {check}};
  };
  if (!fs::exists(folders.scene(name)))
    return failed("scene", fmt::format("{} does not exist; restore it or delete the golden entry",
                                       folders.scene(name).string()));
  const GoldenEntry entry = folders.entry(name);
  if (!fs::is_directory(entry.folder))
    return failed("golden entry",
                  "does not exist; look at the run, then make the entry with: " + entry.update);

  const TemporaryFolder folder;
  GoldenRun run;
  std::vector<UsedTolerance> used;
  std::string step = "tolerances";
  try {
    const fs::path own = entry.folder / tolerances_name;
    used = used_tolerances(options, read_tolerances(own), own);
    step = "scene";
    if (const std::string missing = missing_input(folders.scene(name)); !missing.empty())
      return failed(step, missing);
    step = "run";
    run = runner(folders.scene(name), folder / "run.h5");
  } catch (const Error& error) {
    if (is_of_the_machine(error)) throw;
    return failed(step, error.what());
  }
  if (run.result.interrupted) return failed("run", "was interrupted");
  run.seconds = watch.seconds();
  const Tolerances tolerances = values_of(used);
  Comparison comparison = compare_golden(entry, run, tolerances);
  comparison.tolerances = used;
  if (compared) compared(entry, run, comparison, tolerances);
  return comparison;
}

bool update_golden(const std::string& name, const GoldenFolders& folders, const SceneRunner& runner,
                   bool doubtful) {
  if (fs::path(name).filename() != name || name == "." || name == "..")
    throw_input_error("{}: is a path, not the name of a scene; name a folder in {}", name,
                      folders.strokes.string());
  const fs::path scene = folders.scene(name);
  if (!fs::exists(scene))
    throw_input_error("{}: {} does not exist; check the name and --strokes", name, scene.string());
  make_folder(folders.golden);  // fails before the run, not after it
  const fs::path entry = folders.entry(name).folder;
  check_golden_replaceable(entry);
  const TemporaryFolder folder;
  const GoldenRun run = runner(scene, folder / "run.h5");
  if (run.result.interrupted) return false;
  if (!doubtful) refuse_doubtful(scene, run.result);
  write_golden(entry, run);
  return true;
}

}  // namespace sandstroke
