#include "io/kept_simulation.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "core/error.h"
#include "core/state_visitor.h"
#include "core/version.h"

namespace sandstroke {
namespace {

void visit(StateVisitor& visitor, KeptSimulation& kept) {
  visitor.value("scene", kept.scene);
  visitor.value("folder", kept.folder);
  visitor.value("state", kept.state);
}

}  // namespace

std::string kept_bytes(const KeptSimulation& kept) {
  StateKeeper keeper;
  KeptSimulation copy = kept;
  visit(keeper, copy);
  return std::string(state_output.begin) + std::string(version) + "\n" + std::move(keeper).kept();
}

KeptSimulation kept_simulation(std::string_view bytes, const std::string& name) {
  if (!bytes.starts_with(state_output.begin))
    throw_input_error("{}: this is not a simulation's state; give what Simulation.save() or state() made",
                      name);
  bytes.remove_prefix(state_output.begin.size());
  const std::string_view its_version = bytes.substr(0, std::min(bytes.find('\n'), bytes.size()));
  if (its_version != version)
    throw_input_error("{}: a state is read only by the version that kept it, {}; this is {}", name,
                      its_version, version);
  bytes.remove_prefix(std::min(its_version.size() + 1, bytes.size()));
  KeptSimulation kept;
  StateRestorer restorer(bytes);
  visit(restorer, kept);
  restorer.end();
  return kept;
}

void check_same_scene(const std::string& here, const std::string& kept) {
  std::istringstream ours(here), theirs(kept);
  for (std::string our, their; our == their;) {
    const bool more = static_cast<bool>(std::getline(ours, our)),
               others = static_cast<bool>(std::getline(theirs, their));
    if (!more && !others) return;
    if (!more) our = "nothing";
    if (!others) their = "nothing";
    if (our != their)
      throw_input_error("the state is of another scene: it has {}, this simulation {}", their, our);
  }
}

}  // namespace sandstroke
