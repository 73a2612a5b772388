#pragma once

#include <string>

#include "cli/commands.h"
#include "left_out/left_out.h"

namespace sandstroke {

/// Adds a command that says that this program was built without it, whatever its arguments are.
inline void add_left_out_command(CLI::App& app, const std::string& name, const std::string& option) {
  CLI::App* command = app.add_subcommand(name, "Not in this build (cmake -D" + option + "=ON)");
  command->set_help_flag();
  command->preparse_callback([=](std::size_t) { throw_left_out(name, option); });
}

}  // namespace sandstroke
