// Instead of cli/bench.cpp and cli/stress.cpp (SANDSTROKE_VALIDATION=OFF).
#include "left_out/left_out_command.h"

namespace sandstroke {

void add_bench_command(CLI::App& app, Command&) {
  add_left_out_command(app, "bench", "SANDSTROKE_VALIDATION");
}

void add_stress_command(CLI::App& app, Command&) {
  add_left_out_command(app, "stress", "SANDSTROKE_VALIDATION");
}

}  // namespace sandstroke
