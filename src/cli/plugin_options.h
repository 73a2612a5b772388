#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/scene.h"

namespace sandstroke {

/// The options --plugin, --law and --parameters of commands that test plugin laws.
struct PluginOptions {
  std::filesystem::path file;
  std::vector<std::string> names;
  std::vector<double> parameters;

  /// Adds the options. help: the text for --plugin. This object keeps their values, so it must outlive the
  /// command.
  void add_to(CLI::App& command, const std::string& help);
  /// The chosen laws, each in its own settings. Empty without --plugin. Error: input, io.
  std::vector<PluginLawSettings> laws() const;
};

}  // namespace sandstroke
