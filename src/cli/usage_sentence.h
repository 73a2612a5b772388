#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace sandstroke {

/// What is wrong with a command line that could not be parsed, and whose help says more; empty where help or
/// the version was asked for. A word that is no command comes first: there is no help of it either.
std::string usage_sentence(const CLI::App& app, const CLI::ParseError& failure);

}  // namespace sandstroke
