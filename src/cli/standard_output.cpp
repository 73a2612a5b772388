#include "cli/standard_output.h"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "core/error.h"

namespace sandstroke {

void throw_output_error(int error) {
  pollfd output = {STDOUT_FILENO, POLLOUT, 0};
  if (poll(&output, 1, 0) > 0 && (output.revents & POLLERR) != 0) {  // a pipe without a reader
    signal(SIGPIPE, SIG_DFL);
    raise(SIGPIPE);
  }
  throw_io_error("standard output: cannot be written ({}); free disk space, or redirect it",
                 std::strerror(error));
}

void flush_output() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) throw_output_error(errno);
}

}  // namespace sandstroke
