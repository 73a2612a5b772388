#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/scene.h"

namespace sandstroke {

/// --plugin, --law and --parameters: laws of a plugin that a command tests.
struct PluginOptions {
  std::filesystem::path file;
  std::vector<std::string> names;
  std::vector<double> parameters;

  /// help: of --plugin. They are kept here, so it must outlive the command.
  void add_to(CLI::App& command, const std::string& help);
  /// Those that are asked for, each in settings of its own; none without --plugin. Error: input, io.
  std::vector<OwnLawSettings> laws() const;
};

}  // namespace sandstroke
