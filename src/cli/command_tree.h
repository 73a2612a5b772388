#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace sandstroke {

/// A command with the words that call it, without the program's name: "golden check"; "" is the program.
struct NamedCommand {
  std::string name;
  const CLI::App* app;
};

/// The program, and then all commands, each before its own commands, in the order in which they were added.
std::vector<NamedCommand> command_tree(const CLI::App& app);

// Options with a dash, and those without, in the order in which they were added.
std::vector<const CLI::Option*> named_options(const CLI::App& app);
std::vector<const CLI::Option*> positional_options(const CLI::App& app);

}  // namespace sandstroke
