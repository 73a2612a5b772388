#include "core/status_line.h"

#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>

namespace sandstroke {
namespace {

/// The text that a terminal is sent by a program that draws a line, perhaps loses the terminal to another
/// job, and clears the line.
std::string sent_to_terminal(bool goes_to_background) {
  int terminal = -1;
  const pid_t program = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (program == 0) {
    StatusLine line;
    line.draw("drawn");
    const pid_t job = fork();
    if (job == 0) pause();
    setpgid(job, job);
    if (goes_to_background && tcsetpgrp(STDERR_FILENO, job) != 0) _exit(1);
    line.clear();
    kill(job, SIGKILL);
    _exit(0);
  }
  std::string sent;
  char bytes[256];
  for (ssize_t count; (count = read(terminal, bytes, sizeof bytes)) > 0;)
    sent.append(bytes, static_cast<std::size_t>(count));
  int status = -1;
  waitpid(program, &status, 0);
  close(terminal);
  EXPECT_EQ(status, 0);
  return sent;
}

TEST(StatusLine, IsClearedUnlessAnotherJobHasTheTerminal) {
  EXPECT_EQ(sent_to_terminal(false), "\rdrawn\033[K\r\033[K");
  EXPECT_EQ(sent_to_terminal(true), "\rdrawn\033[K");
}

}  // namespace
}  // namespace sandstroke
