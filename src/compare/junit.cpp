#include "compare/junit.h"

#include <spdlog/fmt/fmt.h>

namespace sandstroke {
namespace {

/// Text as the value of an attribute. Control characters, which XML cannot carry, become '?'.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&apos;";
        break;
      case '\n':
        result += "&#10;";
        break;
      case '\t':
        result += "&#9;";
        break;
      default:
        result += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    }
  }
  return result;
}

}  // namespace

std::string junit_report(const std::vector<Comparison>& comparisons) {
  std::size_t tests = 0;
  int failures = 0;
  std::string suites;
  for (const Comparison& comparison : comparisons) {
    tests += comparison.checks.size();
    failures += comparison.failures();
    const std::string suite = escaped(comparison.name);
    suites += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\">\n", suite,
                          comparison.checks.size(), comparison.failures());
    for (const Check& check : comparison.checks) {
      suites += fmt::format("    <testcase classname=\"{}\" name=\"{}\"", suite, escaped(check.name));
      suites += check.passed ? "/>\n"
                             : fmt::format(">\n      <failure message=\"{}\"/>\n    </testcase>\n",
                                           escaped(check.sentence));
    }
    suites += "  </testsuite>\n";
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"{}\" "
      "failures=\"{}\">\n{}</testsuites>\n",
      tests, failures, suites);
}

}  // namespace sandstroke
