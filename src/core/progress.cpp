#include "core/progress.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace sandstroke {

Progress::Progress(std::string title)
    : title_(std::move(title)), start_(Clock::now()), next_draw_(start_ + std::chrono::seconds(1)) {}

bool Progress::due() {
  if (!line_.visible()) return false;
  const auto now = Clock::now();
  if (now < next_draw_) return false;
  next_draw_ = now + std::chrono::milliseconds(200);
  return true;
}

void Progress::update(double fraction) {
  if (!due()) return;
  const double done = std::clamp(fraction, 1e-9, 1.0);
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  constexpr int width = 32;
  const int filled = static_cast<int>(done * width);
  line_.draw(fmt::format("{} [{}{}] {:3.0f} %, {:.0f} s left", title_, std::string(filled, '#'),
                         std::string(width - filled, '.'), 100.0 * done, elapsed / done - elapsed));
}

void Progress::count(std::int64_t done, const char* what) {
  if (due()) line_.draw(fmt::format("{} {} {}", title_, done, what));
}

}  // namespace sandstroke
