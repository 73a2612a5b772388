#include "validation/study/plugin_contenders.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <algorithm>

#include "core/error.h"
#include "sim/plugin_laws.h"
#include "sim/sand_watch.h"

namespace sandstroke {

std::vector<PluginLawSettings> single_laws(const PluginLawSettings& plugin,
                                           const std::vector<std::string>& names) {
  std::vector<PluginLawSettings> found;
  std::vector<std::string> known;
  const auto add_kind = [&](const auto& makers, std::string PluginLawSettings::*key) {
    for (const auto& [name, maker] : makers) {
      known.push_back(name);
      if (!names.empty() && std::find(names.begin(), names.end(), name) == names.end()) continue;
      PluginLawSettings& law = found.emplace_back(plugin);
      law.relaxation = law.displacement = law.force = "";
      law.*key = name;
    }
  };
  add_kind(plugin.laws->relaxations, &PluginLawSettings::relaxation);
  add_kind(plugin.laws->displacements, &PluginLawSettings::displacement);
  add_kind(plugin.laws->forces, &PluginLawSettings::force);
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  for (const std::string& name : names)
    if (!std::binary_search(known.begin(), known.end(), name))
      throw_input_error("{}: has no law '{}'; choose from: {}", plugin.plugin, name, fmt::join(known, ", "));
  return found;
}

std::string series_of(const PluginLawSettings& law) {
  return "plugin: " + law.relaxation + law.displacement + law.force;  // one of the three names a law
}

std::vector<std::string> problems_of(const std::vector<PluginLawSettings>& laws) {
  const auto any = [&](std::string PluginLawSettings::*key) {
    return std::any_of(laws.begin(), laws.end(), [&](const auto& law) { return !(law.*key).empty(); });
  };
  std::vector<std::string> names;
  if (any(&PluginLawSettings::relaxation)) names = {"cylinder", "truncated", "cone", "cliff", "trench"};
  if (any(&PluginLawSettings::displacement)) names.emplace_back("stroke-accurate");
  if (any(&PluginLawSettings::force)) names.emplace_back("plunge");
  return names;
}

void add_plugin_laws(StudyOptions& study, const std::vector<PluginLawSettings>& laws) {
  study.plugin_laws = laws;
  for (const PluginLawSettings& law : laws)
    if (!law.relaxation.empty()) study.peers.push_back(peer_of(law));
  if (study.problems.empty()) study.problems = problems_of(laws);
}

Peer peer_of(const PluginLawSettings& law) {
  return {series_of(law), [law](HeightField& bed, double talus_angle) {
            Scene scene;
            scene.plugin_laws = law;
            scene.bed.cols = bed.cols();
            scene.bed.rows = bed.rows();
            scene.bed.width = bed.cols() * bed.cell_size();
            scene.bed.depth = bed.rows() * bed.cell_size();
            scene.relaxation.talus_angle = talus_angle;
            SandWatch watch(bed);
            const RelaxationOutcome outcome = make_relaxer(scene, bed.cell_size())->relax(bed);
            watch.check(bed, law_in_words(law, "relaxation", law.relaxation));
            return outcome;
          }};
}

}  // namespace sandstroke
