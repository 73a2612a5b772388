#pragma once

#include <string>

#include "core/child_process.h"

namespace sandstroke {

/// The system's own, which has the modules that Debian's packages bring.
inline constexpr const char* python = "/usr/bin/python3";

/// Whether it has these modules, named with commas.
inline bool python_has(const std::string& modules) {
  const auto found = run_child({python, "-c", "import " + modules});
  return found && found->exit_code == 0;
}

}  // namespace sandstroke
