#include "core/status_line.h"

#include <poll.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>

namespace sandstroke {
namespace {

bool takes_output() {
  pollfd terminal = {STDERR_FILENO, POLLOUT, 0};
  return poll(&terminal, 1, 0) > 0 && (terminal.revents & POLLOUT) != 0;
}

}  // namespace

StatusLine::StatusLine() : visible_(isatty(STDERR_FILENO) != 0 && spdlog::should_log(spdlog::level::info)) {}

void StatusLine::draw(const std::string& text) {
  if (!visible_ || !takes_output()) return;
  std::fputs(("\r" + text + "\033[K").c_str(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

void StatusLine::clear() {
  if (drawn_ && takes_output()) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

}  // namespace sandstroke
