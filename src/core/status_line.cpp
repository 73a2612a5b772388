#include "core/status_line.h"

#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

namespace sandstroke {
namespace {

bool takes_output() {
  pollfd terminal = {STDERR_FILENO, POLLOUT, 0};
  return poll(&terminal, 1, 0) > 0 && (terminal.revents & POLLOUT) != 0;
}

/// The width of the terminal; 0: the system does not say.
std::size_t columns() {
  winsize terminal{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &terminal) == 0 ? terminal.ws_col : 0;
}

/// True if another job has the terminal, and somebody types there. False, too, if it is no terminal of ours.
bool in_background() {
  const pid_t foreground = tcgetpgrp(STDERR_FILENO);
  return foreground >= 0 && foreground != getpgrp();
}

}  // namespace

StatusLine::StatusLine() : visible_(isatty(STDERR_FILENO) != 0 && spdlog::should_log(spdlog::level::info)) {}

void StatusLine::draw(const std::string& text) {
  if (!visible_ || in_background() || !takes_output()) return;
  std::string line = "\r" + text;
  // A longer text would go on in the next line, and stay there. The last column stays free, because clearing
  // the rest of the line may clear it, too.
  if (const std::size_t most = columns(); most > 0 && line.size() > most) line.resize(most);
  std::fputs((line + "\033[K").c_str(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

void StatusLine::clear() {
  if (drawn_ && !in_background() && takes_output()) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

}  // namespace sandstroke
