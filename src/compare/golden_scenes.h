#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "compare/golden.h"

namespace sandstroke {

/// Runs a scene into a run file and renders it.
using SceneRunner =
    std::function<GoldenRun(const std::filesystem::path& scene, const std::filesystem::path& run_file)>;

/// The scenes and what they must give: strokes/NAME/scene.toml and golden/NAME/.
struct GoldenFolders {
  std::filesystem::path strokes = "strokes", golden = "golden";

  std::filesystem::path scene(const std::string& name) const { return strokes / name / "scene.toml"; }
  GoldenEntry entry(const std::string& name) const;
};

/// Every name with a scene or a golden entry, in alphabetical order; or those asked for, if any. Error: input
/// for a name that has neither, or where there is none at all; io where the folder of scenes is missing.
std::vector<std::string> golden_names(const GoldenFolders& folders,
                                      const std::vector<std::string>& asked_for);

/// Called with what was compared, while the files of the run are there.
using ComparisonWatcher =
    std::function<void(const GoldenEntry&, const GoldenRun&, const Comparison&, const Tolerances&)>;

/// Runs one scene and compares it with its golden entry. Tolerances in `options` override those of the
/// entry's own tolerances.toml. These are failed checks: a scene without entry, an entry without scene, a
/// file of tolerances with bad input, and a run that stops with bad input or is interrupted. compared: called
/// if the run was compared; or empty.
Comparison check_golden(const std::string& name, const GoldenFolders& folders, const SceneRunner& runner,
                        const GivenTolerances& options, const ComparisonWatcher& compared = {});

/// Runs one scene and makes the result its golden entry. Returns false, and changes nothing, where the run
/// was interrupted. Error: input where there is no such scene; unstable where the sand is not at rest, or the
/// device swings, unless that is allowed (doubtful).
bool update_golden(const std::string& name, const GoldenFolders& folders, const SceneRunner& runner,
                   bool doubtful = false);

}  // namespace sandstroke
