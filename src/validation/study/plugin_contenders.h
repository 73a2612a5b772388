#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "validation/study/study.h"

namespace sandstroke {

/// Lists the laws of a loaded plugin one by one: each result sets one of the keys relaxation, displacement
/// and force. names: the laws to list; empty: all. Error: input, for a name that no law has.
std::vector<PluginLawSettings> single_laws(const PluginLawSettings& plugin,
                                           const std::vector<std::string>& names);

/// "plugin: NAME", the law's name in charts.
std::string series_of(const PluginLawSettings& law);

/// The problems in which plugin laws take part: the heaps, a stroke, a plunge.
std::vector<std::string> problems_of(const std::vector<PluginLawSettings>& laws);

/// Adds plugin laws to a bench. If it names no problems, it gets those of problems_of().
void add_plugin_laws(StudyOptions& study, const std::vector<PluginLawSettings>& laws);

/// A plugin's law of relaxation, for heaps. A SandWatch checks its sand.
Peer peer_of(const PluginLawSettings& law);

/// Computes the truth for contenders when it is first asked for. So a law that fails there fails only its own
/// contenders. For one thread.
template <class Truth>
std::function<const Truth&()> truth_when_asked(std::function<Truth()> compute) {
  return [compute = std::move(compute), known = std::make_shared<std::optional<Truth>>()]() -> const Truth& {
    if (!*known) known->emplace(compute());
    return **known;
  };
}

}  // namespace sandstroke
