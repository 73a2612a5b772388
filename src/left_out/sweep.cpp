// Instead of cli/sweep*.cpp and cli/fit.cpp (SANDSTROKE_SWEEP=OFF).
#include "left_out/left_out_command.h"

namespace sandstroke {

void add_sweep_command(CLI::App& app, Command&) { add_left_out_command(app, "sweep", "SANDSTROKE_SWEEP"); }

void add_fit_command(CLI::App& app, Command&) { add_left_out_command(app, "fit", "SANDSTROKE_SWEEP"); }

}  // namespace sandstroke
