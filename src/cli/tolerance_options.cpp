#include "cli/tolerance_options.h"

#include <spdlog/fmt/fmt.h>

namespace sandstroke {

void add_tolerance_options(CLI::App& command, GivenTolerances& given, bool golden) {
  for (const ToleranceKey& key : tolerance_keys) {
    const std::string unit = *key.unit ? fmt::format(" [{}]", key.unit) : "";
    command
        .add_option_function<double>(
            key.option, [&given, name = key.name](double value) { given[name] = value; }, key.help + unit)
        ->check(number_within(golden ? key.golden_range() : key.range))
        ->default_str(fmt::format("{}", Tolerances().*key.value));
  }
}

}  // namespace sandstroke
