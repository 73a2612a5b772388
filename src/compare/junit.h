#pragma once

#include <string>
#include <vector>

#include "compare/check.h"
#include "core/output_file.h"

namespace sandstroke {

/// Known by its name.
inline constexpr OutputKind junit_output{
    "a JUnit report", "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"sandstroke "};

/// JUnit XML, as continuous integration reads it: one testsuite per comparison, one testcase per check, a
/// failure with its sentence where it failed, and the seconds that each took (of a golden entry's scene the
/// run, in "run complete").
std::string junit_report(const std::vector<Comparison>& comparisons);

}  // namespace sandstroke
