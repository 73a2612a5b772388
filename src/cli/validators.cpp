#include <charconv>
#include <cmath>

#include "cli/commands.h"

namespace sandstroke {
namespace {

CLI::Validator finite_number(const char* name, const char* wanted, bool (*accepts)(double)) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        double value = 0.0;
        const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool whole = failure == std::errc() && end == text.data() + text.size();
        return whole && std::isfinite(value) && accepts(value) ? "" : text + " is not " + wanted;
      },
      name);
}

}  // namespace

CLI::Validator positive_number() {
  return finite_number("NUMBER > 0", "a number above 0", [](double value) { return value > 0.0; });
}

CLI::Validator not_negative_number() {
  return finite_number("NUMBER >= 0", "a number of 0 or more", [](double value) { return value >= 0.0; });
}

CLI::Option* add_set_option(CLI::App& command, std::vector<std::string>& overrides) {
  return command
      .add_option("--set", overrides, "Override a scene key, such as relaxation.talus_angle=35 (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)  // what follows its one value is not another
      ->take_all();
}

}  // namespace sandstroke
