#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "faults/faulted_command.h"

namespace sandstroke {

// Exit codes; the last one is of the system's own loader.
constexpr int input_error = 2, io_error = 4, not_loaded = 127;

using CommandsTest = testing::TestWithParam<FaultedCommand>;

inline std::string name_of(const testing::TestParamInfo<FaultedCommand>& info) {
  std::string name = info.param.name;
  std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
  return name;
}

#define SANDSTROKE_FOR_EACH_COMMAND(suite)                                                                  \
  INSTANTIATE_TEST_SUITE_P(                                                                                 \
      , suite, testing::Values(run_command, sweep_command, golden_command, record_command, render_command), \
      name_of)

}  // namespace sandstroke
