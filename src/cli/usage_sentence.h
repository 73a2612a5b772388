#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace sandstroke {

/// Says what is wrong with a command line, and which command's help says more. Empty if the user asked for
/// help or the version. A word that is not a command is reported first: it has no help either.
std::string usage_sentence(const CLI::App& app, const CLI::ParseError& failure);

}  // namespace sandstroke
