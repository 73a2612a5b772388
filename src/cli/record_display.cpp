#include "cli/record_display.h"

#include <spdlog/fmt/fmt.h>

namespace sandstroke {

void RecordDisplay::show(const ServoProgress& now) {
  if (!line_.visible()) return;
  const double rate = rate_.at(now.time, static_cast<double>(now.recorded));
  if (const std::string hint = hint_of(now); !hint.empty()) {
    const std::string so_far = now.elapsed > 0 ? fmt::format(" {:.1f} s", now.time) : "";
    line_.draw(fmt::format("record{}: {}{}", so_far, hint, keys_));
    return;
  }
  line_.draw(fmt::format("record {:.1f} s, {:.0f} Hz, {:.2f} N, {:.0f} us late ({:.0f} at most){}", now.time,
                         rate, now.force, 1e6 * now.lateness, 1e6 * now.max_lateness, keys_));
}

}  // namespace sandstroke
