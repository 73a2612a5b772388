#include "cli/stop_keys.h"

#include <poll.h>
#include <signal.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <string_view>

namespace sandstroke {
namespace {

bool has_input() {
  pollfd keyboard = {STDIN_FILENO, POLLIN, 0};
  return poll(&keyboard, 1, 0) > 0 && (keyboard.revents & POLLIN) != 0;
}

// Signals that end a program, also those of faults in a driver.
constexpr std::array ending_signals = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGABRT, SIGSEGV, SIGBUS, SIGFPE};

// Globals, because a signal handler takes no arguments.
termios terminal_before;
std::array<struct sigaction, ending_signals.size()> handlers_before;

std::atomic<bool> terminal_taken = false;

void leave_terminal() {
  if (!terminal_taken.exchange(false)) return;
  tcsetattr(STDIN_FILENO, TCSANOW, &terminal_before);  // POSIX allows this call in a signal handler
  for (std::size_t i = 0; i < ending_signals.size(); ++i)
    sigaction(ending_signals[i], &handlers_before[i], nullptr);
}

void leave_terminal_and_pass_on(int signal) {
  leave_terminal();
  raise(signal);
}

}  // namespace

StopKeys::StopKeys() {
  // The system would stop a background job that touches the terminal.
  if (tcgetpgrp(STDIN_FILENO) != getpgrp() || tcgetattr(STDIN_FILENO, &terminal_before) != 0) return;
  if (has_input()) return;  // typed ahead or pasted input is for the shell
  terminal_taken = true;
  struct sigaction leave = {};
  leave.sa_handler = leave_terminal_and_pass_on;
  for (std::size_t i = 0; i < ending_signals.size(); ++i) {
    sigaction(ending_signals[i], nullptr, &handlers_before[i]);
    if (handlers_before[i].sa_handler != SIG_IGN) sigaction(ending_signals[i], &leave, nullptr);
  }
  termios unbuffered = terminal_before;
  unbuffered.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);  // Ctrl-C still is a signal
  unbuffered.c_cc[VMIN] = 1;
  unbuffered.c_cc[VTIME] = 0;
  listening_ = tcsetattr(STDIN_FILENO, TCSANOW, &unbuffered) == 0;
}

StopKeys::~StopKeys() { leave_terminal(); }

bool StopKeys::pressed() {
  if (!listening_ || !has_input()) return false;
  char bytes[64];
  const ssize_t count = read(STDIN_FILENO, bytes, sizeof bytes);
  const std::string_view typed(bytes, count > 0 ? static_cast<std::size_t>(count) : 0);
  // Other keys also begin with the code of Esc: an arrow is "\033[A".
  return typed.starts_with('\033') ? typed.size() == 1 : typed.find_first_of("qQ \n\r") != typed.npos;
}

}  // namespace sandstroke
