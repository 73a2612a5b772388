#include <cmath>
#include <filesystem>

#include "cli/commands.h"
#include "cli/parse_number.h"
#include "io/toml_reader.h"

namespace sandstroke {
namespace {

CLI::Validator accepted_number(const std::string& name, const std::string& wanted, Range range) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        double value = 0.0;
        const bool is_number = parse_number(text, value) && std::isfinite(value);
        const bool fits = range.contains(value) && (!range.whole || value == std::floor(value));
        return is_number && fits ? "" : text + " is not " + wanted;
      },
      name);
}

}  // namespace

CLI::Validator positive_number() { return accepted_number("NUMBER > 0", "a number above 0", positive); }

CLI::Validator not_negative_number() {
  return accepted_number("NUMBER >= 0", "a number of 0 or more", not_negative);
}

CLI::Validator finite_number() { return accepted_number("", "a finite number", any_number); }

CLI::Validator number_within(Range range) {
  const std::string words = range_text(range);
  return accepted_number("NUMBER " + words, (range.whole ? "a whole number " : "a number ") + words, range);
}

CLI::Option* add_set_option(CLI::App& command, std::vector<std::string>& overrides) {
  CLI::Option* set =
      command
          .add_option("--set", overrides,
                      "Override a scene key, such as relaxation.talus_angle=35 (repeatable). Another choice, "
                      "such as tool.shape=plate, leaves out what the scene sets for the old one, and says so")
          ->type_name("KEY=VALUE")
          ->allow_extra_args(false)  // takes one value each time
          ->take_all();
  // Defined after --set, which replaces the list: what is taken out comes first.
  command
      .add_option_function<std::vector<std::string>>(
          "--unset",
          [&overrides](const std::vector<std::string>& keys) {
            for (const std::string& key : keys) overrides.insert(overrides.begin(), "!" + key);
          },
          "Take a key or a section out of the scene, such as stroke (repeatable)")
      ->type_name("KEY")
      ->allow_extra_args(false)
      ->take_all();
  return set;
}

std::string scene_option(const std::string& override_text) {
  return override_text.starts_with('!') ? "--unset " + override_text.substr(1) : "--set " + override_text;
}

std::string stroke_override(const std::string& file) {
  if (file == "-") return "stroke.file=-";
  return "stroke.file=" + toml_string(std::filesystem::absolute(file).string());
}

}  // namespace sandstroke
