#include "core/progress.h"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace sandstroke {

Progress::Progress(std::string title)
    : title_(std::move(title)),
      start_(Clock::now()),
      next_draw_(start_ + std::chrono::seconds(1)),
      terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

bool Progress::due() {
  if (!terminal_) return false;
  const auto now = Clock::now();
  if (now < next_draw_) return false;
  next_draw_ = now + std::chrono::milliseconds(200);
  return true;
}

void Progress::draw(const std::string& line) {
  std::fputs(("\r" + title_ + " " + line + "\033[K").c_str(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::update(double fraction) {
  if (!due()) return;
  const double done = std::clamp(fraction, 1e-9, 1.0);
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  constexpr int width = 32;
  const int filled = static_cast<int>(done * width);
  draw(fmt::format("[{}{}] {:3.0f} %, {:.0f} s left", std::string(filled, '#'),
                   std::string(width - filled, '.'), 100.0 * done, elapsed / done - elapsed));
}

void Progress::count(std::int64_t done, const char* what) {
  if (due()) draw(fmt::format("{} {}", done, what));
}

}  // namespace sandstroke
