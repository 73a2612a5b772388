#include "core/status_line.h"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>

namespace sandstroke {

StatusLine::StatusLine() : visible_(isatty(STDERR_FILENO) != 0 && spdlog::should_log(spdlog::level::info)) {}

void StatusLine::draw(const std::string& text) {
  if (!visible_) return;
  std::fputs(("\r" + text + "\033[K").c_str(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

void StatusLine::clear() {
  if (drawn_) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

}  // namespace sandstroke
