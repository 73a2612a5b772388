#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "core/child_process.h"

namespace sandstroke {

/// The system's own, which has the modules that Debian's packages bring.
inline constexpr const char* python = "/usr/bin/python3";

/// True if it has these modules, named with commas.
inline bool python_has(const std::string& modules) {
  const auto found = run_child({python, "-c", "import " + modules});
  return found && found->exit_code == 0;
}

}  // namespace sandstroke

/// Skips the test where a program that it needs is missing; fails it in continuous integration.
#define SANDSTROKE_NEEDS(is_there, package)                                           \
  if (!(is_there)) {                                                                  \
    if (std::getenv("CI")) FAIL() << package << " is not installed: run tools/setup"; \
    GTEST_SKIP() << package << " is not installed; tools/setup installs it";          \
  }                                                                                   \
  static_assert(true)
