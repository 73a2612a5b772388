#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace sandstroke {

/// A command and the words that call it, without the program's name: "golden check". "" is the program.
struct NamedCommand {
  std::string name;
  const CLI::App* app;
};

/// Lists the program and all commands, each before its subcommands, in the order in which they were added.
std::vector<NamedCommand> command_tree(const CLI::App& app);

// List the options with a dash, and those without, in the order in which they were added.
std::vector<const CLI::Option*> named_options(const CLI::App& app);
std::vector<const CLI::Option*> positional_options(const CLI::App& app);

}  // namespace sandstroke
