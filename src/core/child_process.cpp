#include "core/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/interrupt.h"

namespace sandstroke {
namespace {

constexpr int look_ms = 20;  // how often a wait checks for an interrupt

std::string written_to(std::FILE* output) {
  std::rewind(output);
  std::string text;
  for (int c; (c = std::fgetc(output)) != EOF;) text += static_cast<char>(c);
  return text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
}

ChildOutputs outputs_of(const std::string& program) {
  ChildOutputs outputs;
  outputs.out.reset(std::tmpfile());
  outputs.err.reset(std::tmpfile());
  if (!outputs.out || !outputs.err)
    throw_io_error("cannot make a temporary file for the output of {}; free disk space in /tmp", program);
  return outputs;
}

/// Returns the started process, or 0 if there is no such program. input < 0: it has nothing to read.
pid_t spawn(const std::vector<std::string>& words, int input, const ChildOutputs& outputs) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (input >= 0)
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  else
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(outputs.out.get()), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(outputs.err.get()), STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t ignored_here;  // ignore_write_signals(), which a child would inherit
  sigemptyset(&ignored_here);
  sigaddset(&ignored_here, SIGPIPE);
  sigaddset(&ignored_here, SIGXFSZ);
  posix_spawnattr_setsigdefault(&attributes, &ignored_here);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t process = 0;
  const int failure =
      posix_spawnp(&process, words[0].c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (failure == ENOENT) return 0;
  if (failure) throw_io_error("{} cannot be started: {}", words[0], std::generic_category().message(failure));
  return process;
}

int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

ChildResult result_of(int status, const ChildOutputs& outputs) {
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), written_to(outputs.out.get()),
          written_to(outputs.err.get())};
}

}  // namespace

std::string one_line(const std::string& lines) {
  std::string line;
  for (const char c : lines) {
    if (c == '\r') continue;
    if (c != '\n')
      line += c;
    else if (!line.empty() && !line.ends_with("; "))
      line += "; ";
  }
  return line;
}

bool is_installed(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder + "/" + name).c_str(), X_OK) == 0) return true;
  return false;
}

std::optional<FedChild> FedChild::start(const std::vector<std::string>& words) {
  ChildOutputs outputs = outputs_of(words[0]);
  int ends[2];  // sockets, not a pipe: writing to a child that has ended raises no SIGPIPE
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw_io_error("no connection to {} can be opened: {}; close other programs", words[0],
                   std::strerror(errno));
  const std::unique_ptr<int, void (*)(int*)> its_end(&ends[1], [](int* end) { close(*end); });
  FedChild child(0, ends[0], std::move(outputs));
  child.process_ = spawn(words, ends[1], child.outputs_);
  if (child.process_ == 0) return std::nullopt;
  return child;
}

FedChild::FedChild(FedChild&& other) noexcept
    : process_(std::exchange(other.process_, 0)),
      input_(std::exchange(other.input_, -1)),
      outputs_(std::move(other.outputs_)) {}

FedChild::~FedChild() {
  end_input();
  if (process_ == 0) return;
  kill(process_, SIGKILL);
  wait_for(process_);
}

void FedChild::end_input() {
  if (input_ >= 0) close(std::exchange(input_, -1));
}

bool FedChild::feed(const void* bytes, std::size_t count) {
  const char* rest = static_cast<const char*>(bytes);
  while (count > 0) {
    if (interrupted()) return false;
    const ssize_t taken = send(input_, rest, count, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (taken >= 0) {
      rest += taken;
      count -= static_cast<std::size_t>(taken);
    } else if (errno == EAGAIN) {
      pollfd room{input_, POLLOUT, 0};
      poll(&room, 1, look_ms);
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

std::optional<ChildResult> FedChild::wait() {
  end_input();
  int status = 0;
  while (waitpid(process_, &status, WNOHANG) == 0) {
    if (interrupted()) return std::nullopt;
    poll(nullptr, 0, look_ms);
  }
  process_ = 0;
  return result_of(status, outputs_);
}

std::optional<ChildResult> run_child(const std::vector<std::string>& words) {
  const ChildOutputs outputs = outputs_of(words[0]);
  const pid_t process = spawn(words, -1, outputs);
  if (process == 0) return std::nullopt;
  return result_of(wait_for(process), outputs);
}

}  // namespace sandstroke
