#include "core/progress.h"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace sandstroke {

Progress::Progress(std::string title, Clock::duration silence)
    : title_(std::move(title)),
      start_(Clock::now()),
      next_(start_ + (line_.visible() ? std::chrono::seconds(1) : silence)) {}

bool Progress::due() {
  const auto now = Clock::now();
  if (now < next_) return false;
  next_ = now + (line_.visible() ? std::chrono::milliseconds(200) : now - start_);
  return true;
}

void Progress::show(const std::string& bar, const std::string& text) {
  if (line_.visible())
    line_.draw(fmt::format("{}{} {}", title_, bar, text));
  else
    spdlog::info("{}: {} after {:.0f} s", title_, text,
                 std::chrono::duration<double>(Clock::now() - start_).count());
}

void Progress::update(double fraction) {
  if (!due()) return;
  const double done = std::clamp(fraction, 1e-9, 1.0);
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  constexpr int width = 32;
  const int filled = static_cast<int>(done * width);
  show(fmt::format(" [{}{}]", std::string(filled, '#'), std::string(width - filled, '.')),
       fmt::format("{:.0f} %, {:.0f} s left", 100.0 * done, elapsed / done - elapsed));
}

void Progress::count(std::int64_t done, const char* what) {
  if (due()) show("", fmt::format("{} {}", done, what));
}

}  // namespace sandstroke
