#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "sand/displacer.h"
#include "sand/relaxation.h"
#include "sim/scene.h"
#include "sim/tool_force.h"

namespace sandstroke {

/// Makes a law for a scene. cell_size [m]: of the bed, which may be another one than the scene's. A law's own
/// numbers are scene.plugin_laws.parameters. It may throw an Error: a sentence for the user.
template <class Law>
using LawMaker = std::function<std::unique_ptr<Law>(const Scene& scene, double cell_size)>;

/// Laws that are not this library's, by the names that a scene calls them by (scene.plugin_laws).
struct PluginLaws {
  std::map<std::string, LawMaker<Relaxer>> relaxations;
  std::map<std::string, LawMaker<Displacer>> displacements;
  std::map<std::string, LawMaker<ToolForce>> forces;
  std::string hash;  ///< their file's; empty: none
};

/// The words for the law that a key of [model] names.
std::string law_in_words(const PluginLawSettings& laws, const char* key, const std::string& name);

// The laws that a run of the scene goes by. Error: input, naming the key, where scene.plugin_laws names a law
// that scene.plugin_laws.laws has not. A plugin law is watched: what it throws, other than an Error, becomes
// one that names it; so does a force that is not a number (unstable).

/// scene.plugin_laws.relaxation, or else as scene.relaxation says. A plugin law is told to stop, by an
/// exception from its PassWatcher, where the program is interrupted().
std::unique_ptr<Relaxer> make_relaxer(const Scene& scene, double cell_size);
/// scene.plugin_laws.displacement; nullptr: as scene.displacement says.
std::unique_ptr<Displacer> make_plugin_displacer(const Scene& scene, double cell_size);
/// scene.plugin_laws.force, or else make_contact_force().
std::unique_ptr<ToolForce> make_tool_force(const Scene& scene, double cell_size);

}  // namespace sandstroke
