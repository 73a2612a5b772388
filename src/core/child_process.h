#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sandstroke {

/// How another program ended.
struct ChildResult {
  int exit_code = -1;    ///< 128 + the signal's number, if a signal ended it
  std::string out, err;  ///< what it wrote, without white space at the end
};

/// The lines that a program wrote, as one line: "one; two".
std::string one_line(const std::string& lines);

/// A child's output, in files without a name. A child that writes much to both never waits for a reader.
struct ChildOutputs {
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> out, err;
};

/// Whether there is a program of this name on PATH.
bool is_installed(const std::string& name);

/// Another program that is fed through its standard input. `words` are its name, found on PATH, and its
/// arguments; no shell splits them. The destructor kills a program that nobody waited for.
class FedChild {
 public:
  /// None if there is no such program. Error: io, if it cannot be started.
  static std::optional<FedChild> start(const std::vector<std::string>& words);
  FedChild(FedChild&& other) noexcept;
  ~FedChild();

  /// Waits until the child has taken all bytes. False if it takes no more, or this program is interrupted.
  bool feed(const void* bytes, std::size_t count);
  /// Closes the child's input and waits for its end. None if this program is interrupted before.
  std::optional<ChildResult> wait();

 private:
  FedChild(pid_t process, int input, ChildOutputs outputs)
      : process_(process), input_(input), outputs_(std::move(outputs)) {}
  void end_input();

  pid_t process_;  // 0: none, or already waited for
  int input_;      // our end of its standard input; -1: closed
  ChildOutputs outputs_;
};

/// Runs a program without input and waits for its end, even if this program is interrupted. None if there is
/// no such program. Error: io, if it cannot be started.
std::optional<ChildResult> run_child(const std::vector<std::string>& words);

}  // namespace sandstroke
