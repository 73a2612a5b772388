#pragma once

#include <string>
#include <vector>

#include "compare/check.h"

namespace sandstroke {

/// JUnit XML, as continuous integration reads it: one testsuite per comparison, one testcase per check, a
/// failure with its sentence where it failed.
std::string junit_report(const std::vector<Comparison>& comparisons);

}  // namespace sandstroke
