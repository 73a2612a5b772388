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

void Progress::update(double fraction) {
  if (!terminal_) return;
  const auto now = Clock::now();
  if (now < next_draw_) return;
  next_draw_ = now + std::chrono::milliseconds(200);
  const double done = std::clamp(fraction, 1e-9, 1.0);
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  constexpr int width = 32;
  const int filled = static_cast<int>(done * width);
  const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
  const std::string line = fmt::format("\r{} [{}] {:3.0f} %, {:.0f} s left\033[K", title_, bar, 100.0 * done,
                                       elapsed / done - elapsed);
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace sandstroke
