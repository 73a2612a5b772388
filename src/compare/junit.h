#pragma once

#include <string>
#include <vector>

#include "compare/check.h"
#include "core/output_file.h"

namespace sandstroke {

/// The name of the test suites tells such a report from other files.
inline constexpr OutputKind junit_output{
    "a JUnit report", "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"sandstroke "};

/// JUnit XML for continuous integration: one testsuite per comparison, one testcase per check with the
/// seconds it took, and a failure with the check's sentence where it failed. The seconds of a golden entry's
/// run are in "run complete".
std::string junit_report(const std::vector<Comparison>& comparisons);

}  // namespace sandstroke
