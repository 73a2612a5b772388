#include <spdlog/fmt/fmt.h>

#include <memory>

#include "cli/command_tree.h"
#include "cli/commands.h"
#include "core/asset.h"
#include "io/scene_keys.h"

// The shell scripts that use the tables below; embedded by assets.S.
SANDSTROKE_DECLARE_ASSET(completion_common);
SANDSTROKE_DECLARE_ASSET(completion_bash);
SANDSTROKE_DECLARE_ASSET(completion_zsh);

namespace sandstroke {
namespace {

/// The kind of an option's value for the scripts: "words A B", "files .EXT .EXT", "folder", "settings",
/// "scenes", or "none" if there is nothing to offer. Follows from the option's type name, which --help shows.
std::string value_kind(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (const auto open = type.find('{'); open != std::string::npos) {
    std::string names = type.substr(open + 1, type.find('}') - open - 1);
    std::replace(names.begin(), names.end(), ',', ' ');
    return "words " + names;
  }
  if (type == "KEY=VALUE") return "settings";
  if (type == "SCENE") return "scenes";
  if (type == "FOLDER") return "folder";
  if (!type.starts_with("FILE.")) return "none";
  std::string extensions = type.substr(4);  // "FILE.toml|.h5"
  std::replace(extensions.begin(), extensions.end(), '|', ' ');
  return "files " + extensions;
}

/// Writes a shell function that sets REPLY by its arguments. cases: patterns with their values of REPLY.
std::string table(const char* name, const std::string& cases) {
  return fmt::format("\n{}() {{\n  REPLY=''\n  case \"$*\" in\n{}  esac\n}}\n", name, cases);
}

std::string one_case(const std::string& patterns, const std::string& reply) {
  return fmt::format("    {}) REPLY='{}' ;;\n", patterns, reply);
}

std::string dashed(const CLI::Option& option, const std::string& before, const char* between) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back(before + "-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back(before + "--" + name);
  return fmt::format("{}", fmt::join(names, between));
}

std::string tables(const CLI::App& app) {
  std::string commands, options, values;
  const std::string everywhere =
      dashed(*app.get_option("--quiet"), "", " ") + " " + dashed(*app.get_option("--overwrite"), "", " ");
  for (const NamedCommand& command : command_tree(app)) {
    std::string below, names = command.app == &app ? "" : " " + everywhere;
    for (const CLI::App* child : command.app->get_subcommands([](const CLI::App*) { return true; }))
      below += (below.empty() ? "" : " ") + child->get_name();
    if (!below.empty()) commands += one_case("'" + command.name + "'", below);
    for (const CLI::Option* option : named_options(*command.app)) {
      names += " " + dashed(*option, "", " ");
      if (option->get_items_expected_max() > 0)
        values += one_case("'" + dashed(*option, command.name + " ", "'|'") + "'", value_kind(*option));
      else if (value_kind(*option) != "none")  // a flag that takes a value behind =
        values += one_case("'" + dashed(*option, command.name + " ", "='|'") + "='", value_kind(*option));
    }
    options += one_case("'" + command.name + "'", names.substr(1));
    int position = 0;
    for (const CLI::Option* option : positional_options(*command.app)) {
      const bool repeated = option->get_items_expected_max() >= CLI::detail::expected_max_vector_size;
      const std::string positions = repeated ? "'[0-9]*" : std::to_string(++position) + "'";
      if (value_kind(*option) != "none")
        values += one_case("'" + command.name + " " + positions, value_kind(*option));
    }
  }
  std::string settings, choices;
  for (const KeySection& section : all_scene_keys()) {
    for (const KeyRow& key : section.keys) {
      settings += (settings.empty() ? "" : " ") + key.name;
      if (!key.choices.empty())
        choices += one_case("'" + key.name + "'", fmt::format("{}", fmt::join(key.choices, " ")));
    }
  }
  return "\n# The commands of a command, its options, and the values of its options and positions; "
         "settings of scenes." +
         table("_sandstroke_commands", commands) + table("_sandstroke_options", options) +
         table("_sandstroke_value", values) + table("_sandstroke_settings", one_case("*", settings)) +
         table("_sandstroke_setting", choices);
}

}  // namespace

void add_completion_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("completion", "Print a script that makes a shell complete commands");
  auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "Name of the shell")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh"}));
  command->footer(
      "Packages install it. To install it by hand:\n"
      "  source <(sandstroke completion bash)    # in ~/.bashrc\n"
      "  source <(sandstroke completion zsh)     # in ~/.zshrc, after compinit");
  command->callback([&app, shell, &chosen] {
    chosen = [&app, shell] {
      const bool bash = *shell == "bash";
      fmt::print("{} sandstroke: made by sandstroke completion {}\n{}{}{}",
                 bash ? "# completion of" : "#compdef sandstroke\n# completion of", *shell, tables(app),
                 SANDSTROKE_ASSET(completion_common),
                 bash ? SANDSTROKE_ASSET(completion_bash) : SANDSTROKE_ASSET(completion_zsh));
      return 0;
    };
  });
}

}  // namespace sandstroke
