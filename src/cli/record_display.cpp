#include "cli/record_display.h"

#include <spdlog/fmt/fmt.h>

namespace sandstroke {

void RecordDisplay::show(const ServoProgress& now) {
  if (!line_.visible()) return;
  const double rate = rate_.at(now.time, static_cast<double>(now.recorded));
  line_.draw(fmt::format("record {:.1f} s, {:.0f} Hz, {:.2f} N, {:.0f} us late ({:.0f} at most){}", now.time,
                         rate, now.force, 1e6 * now.lateness, 1e6 * now.max_lateness, keys_));
}

}  // namespace sandstroke
