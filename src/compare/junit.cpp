#include "compare/junit.h"

#include <spdlog/fmt/fmt.h>

#include "core/version.h"
#include "core/xml_text.h"

namespace sandstroke {

std::string junit_report(const std::vector<Comparison>& comparisons) {
  std::size_t tests = 0;
  int failures = 0;
  double seconds = 0.0;
  std::string suites;
  for (const Comparison& comparison : comparisons) {
    tests += comparison.checks.size();
    failures += comparison.failures();
    const std::string suite = xml_escaped(comparison.name);
    suites += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" time=\"{:.3f}\">\n", suite,
                          comparison.checks.size(), comparison.failures(), comparison.seconds());
    seconds += comparison.seconds();
    for (const Check& check : comparison.checks) {
      suites += fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"", suite,
                            xml_escaped(check.name), check.seconds);
      suites += check.passed ? "/>\n"
                             : fmt::format(">\n      <failure message=\"{}\"/>\n    </testcase>\n",
                                           xml_escaped(check.sentence));
    }
    suites += "  </testsuite>\n";
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\" tests=\"{}\" "
      "failures=\"{}\" time=\"{:.3f}\">\n{}</testsuites>\n",
      xml_escaped(build), tests, failures, seconds, suites);
}

}  // namespace sandstroke
