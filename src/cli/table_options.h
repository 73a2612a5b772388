#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "haptics/table_settings.h"

namespace sandstroke {

/// The values given on the command line, by key.
using TableOptions = std::map<std::string, std::string>;

/// Adds an option for each key of [stroke.table] (describe_table): --position-unit is position_unit. `given`
/// must live as long as the command.
void add_table_options(CLI::App& command, TableOptions& given);

/// The settings with the given values. Error: input, naming the option.
TableSettings table_settings(const TableOptions& given);

}  // namespace sandstroke
