// Instead of cli/run_view.cpp (SANDSTROKE_VIEW=OFF).
#include "cli/run_view.h"

#include "left_out/left_out.h"

namespace sandstroke {

std::unique_ptr<RunView> open_run_view(Simulation&, const std::string&, bool) {
  throw_left_out("run --view", "SANDSTROKE_VIEW");
}

}  // namespace sandstroke
