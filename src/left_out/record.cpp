// Instead of cli/record*.cpp (SANDSTROKE_VIEW=OFF).
#include "left_out/left_out_command.h"

namespace sandstroke {

void add_record_command(CLI::App& app, Command&) { add_left_out_command(app, "record", "SANDSTROKE_VIEW"); }

}  // namespace sandstroke
