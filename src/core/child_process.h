#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sandstroke {

/// How another program ended.
struct ChildResult {
  int exit_code = -1;    ///< 128 + signal, if one ended it
  std::string out, err;  ///< what it wrote, without white space at the end
};

/// Runs a program, found on PATH, with these words as its arguments (no shell takes them apart), and waits
/// for its end. None where there is no such program. Error: io, where it cannot be started.
std::optional<ChildResult> run_child(const std::vector<std::string>& words);

}  // namespace sandstroke
