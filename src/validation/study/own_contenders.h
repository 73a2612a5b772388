#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "validation/study/study.h"

namespace sandstroke {

/// The laws of a loaded plugin one by one: in each result one key of relaxation, displacement and force is
/// set. names: of those that are wanted; empty: all. Error: input, for a name that no law has.
std::vector<OwnLawSettings> single_laws(const OwnLawSettings& plugin, const std::vector<std::string>& names);

/// "plugin: NAME", as charts call one of them.
std::string series_of(const OwnLawSettings& law);

/// The problems that such laws take part in: the heaps, a stroke, a plunge.
std::vector<std::string> problems_of(const std::vector<OwnLawSettings>& laws);

/// Lets such laws take part in a study; where it names no problems, in those that they take part in.
void add_own_laws(StudyOptions& study, const std::vector<OwnLawSettings>& laws);

/// An own law of relaxation, for heaps; its sand is watched (SandWatch).
Peer peer_of(const OwnLawSettings& law);

/// What a contender compares with, computed when it is first asked for: a law that fails then fails its
/// contenders, and no more. For one thread.
template <class Truth>
std::function<const Truth&()> truth_when_asked(std::function<Truth()> compute) {
  return [compute = std::move(compute), known = std::make_shared<std::optional<Truth>>()]() -> const Truth& {
    if (!*known) known->emplace(compute());
    return **known;
  };
}

}  // namespace sandstroke
