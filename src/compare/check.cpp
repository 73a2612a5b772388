#include "compare/check.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace sandstroke {
namespace {

std::string number_text(double value, const std::string& unit) {
  if (std::isnan(value)) return "-";
  return unit.empty() ? fmt::format("{:.6g}", value) : fmt::format("{:.6g} {}", value, unit);
}

}  // namespace

Check limit_check(std::string name, double measured, double limit, std::string unit, std::string sentence) {
  return {std::move(name), measured <= limit, measured, limit, std::move(unit), std::move(sentence)};
}

Check fact_check(std::string name, bool passed, std::string sentence) {
  return {std::move(name), passed, Check::no_number, Check::no_number, "", std::move(sentence)};
}

Check passed_check(std::string name, std::string sentence) {
  constexpr bool passed = true;
  return fact_check(std::move(name), passed, std::move(sentence));
}

Check failed_check(std::string name, std::string sentence) {
  constexpr bool passed = false;
  return fact_check(std::move(name), passed, std::move(sentence));
}

bool Comparison::passed() const { return !checks.empty() && failures() == 0; }

int Comparison::failures() const {
  return static_cast<int>(
      std::count_if(checks.begin(), checks.end(), [](const Check& c) { return !c.passed; }));
}

double Comparison::worst() const {
  double worst = 0.0;
  for (const Check& check : checks) {
    if (!check.unit.empty() && check.limit > 0.0 && check.measured >= 0.0)
      worst = std::max(worst, check.measured / check.limit);
    else if (!check.passed)
      worst = std::numeric_limits<double>::infinity();
  }
  return worst;
}

double Comparison::seconds() const {
  return std::accumulate(checks.begin(), checks.end(), 0.0,
                         [](double sum, const Check& check) { return sum + check.seconds; });
}

std::string check_table(const Comparison& comparison) {
  std::vector<std::array<std::string, 4>> lines{{"check", "measured", "limit", ""}};
  for (const Check& check : comparison.checks) {
    lines.push_back({check.name, number_text(check.measured, check.unit),
                     number_text(check.limit, check.unit), check.passed ? "ok" : "FAILED"});
  }
  std::array<std::size_t, 3> widths{};
  for (const auto& line : lines)
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], line[i].size());

  std::string table;
  for (const auto& line : lines) {
    std::string row = fmt::format("{:<{}}  {:<{}}  {:<{}}  {}", line[0], widths[0], line[1], widths[1],
                                  line[2], widths[2], line[3]);
    row.erase(row.find_last_not_of(' ') + 1);
    table += row + '\n';
  }
  for (const Check& check : comparison.checks)
    if (!check.passed) table += fmt::format("{}: {}\n", check.name, check.sentence);
  if (!comparison.settings.empty()) table += fmt::format("settings that differ: {}\n", comparison.settings);
  return table;
}

std::string verdict(const Comparison& comparison) {
  if (comparison.passed()) return "same within the tolerances";
  std::vector<std::string> names;
  for (const Check& check : comparison.checks)
    if (!check.passed) names.push_back(check.name);
  return fmt::format("differs: {}", fmt::join(names, ", "));
}

nlohmann::json to_json(const Comparison& comparison) {
  nlohmann::json checks = nlohmann::json::array();
  for (const Check& check : comparison.checks) {
    checks.push_back({{"name", check.name},
                      {"passed", check.passed},
                      {"measured", check.measured},
                      {"limit", check.limit},
                      {"unit", check.unit},
                      {"sentence", check.sentence}});
  }
  nlohmann::json tolerances = nlohmann::json::array();
  for (const auto& [key, value, source] : comparison.tolerances)
    tolerances.push_back({{"name", key.name}, {"value", value}, {"unit", key.unit}, {"source", source}});
  return {{"name", comparison.name},
          {"passed", comparison.passed()},
          {"checks", std::move(checks)},
          {"tolerances", std::move(tolerances)},
          {"settings", comparison.settings}};
}

}  // namespace sandstroke
