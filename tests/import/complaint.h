#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "core/error.h"
#include "import/sample_table.h"

namespace sandstroke {

/// The sentence of a reader about bad input; empty where it takes it.
template <class Read>
std::string complaint_of(const Read& read) {
  try {
    read();
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::input);
    return failure.what();
  }
  return "";
}

/// The column of that name. It must be there.
inline const SampleColumn& column(const SampleTable& table, const std::string& name) {
  for (const SampleColumn& one : table.columns)
    if (one.name == name) return one;
  throw std::runtime_error("no column " + name);
}

/// Length of the line through the samples, in their unit.
inline double path_length(const SampleTable& table) {
  double length = 0.0;
  for (std::size_t i = 1; i < table.size(); ++i) {
    double square = 0.0;
    for (const SampleColumn& one : table.columns)
      if (one.name == "x" || one.name == "y" || one.name == "z")
        square += (one.values[i] - one.values[i - 1]) * (one.values[i] - one.values[i - 1]);
    length += std::sqrt(square);
  }
  return length;
}

}  // namespace sandstroke
