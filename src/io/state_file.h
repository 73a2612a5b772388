#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "core/output_file.h"
#include "core/state_visitor.h"

namespace sandstroke {

// A kept state is a line that says what it is, the program's version, and the fields of a structure's
// visit_state(). Only the version that kept it reads it.

/// The first two lines of a kept state.
std::string state_head(const OutputKind& kind);
/// What follows them. name: of the file, for messages. Error: input, if these bytes are of another kind or
/// version.
std::string_view after_state_head(std::string_view bytes, const OutputKind& kind, const std::string& name);

template <class State>
std::string state_bytes(State& state, const OutputKind& kind) {
  StateKeeper keeper;
  state.visit_state(keeper);
  return state_head(kind) + std::move(keeper).kept();
}

/// Error: input, if these are no such state, or damaged.
template <class State>
State read_state(std::string_view bytes, const OutputKind& kind, const std::string& name) {
  StateRestorer restorer(after_state_head(bytes, kind, name), name);
  State state;
  state.visit_state(restorer);
  restorer.end();
  return state;
}

/// The first line in which two scenes (TOML) differ: "it has ..., this ... has ..."; empty: they are the
/// same.
std::string scene_difference(const std::string& here, const std::string& kept, std::string_view what);

}  // namespace sandstroke
