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
  int exit_code = -1;    ///< 128 + signal, if one ended it
  std::string out, err;  ///< what it wrote, without white space at the end
};

/// What a child writes, in files without a name: one that writes much on both never waits for a reader.
struct ChildOutputs {
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> out, err;
};

/// Another program, found on PATH, with these words as its arguments (no shell takes them apart), that is fed
/// through its standard input. One that nobody waited for is killed with its holder.
class FedChild {
 public:
  /// None where there is no such program. Error: io, where it cannot be started.
  static std::optional<FedChild> start(const std::vector<std::string>& words);
  FedChild(FedChild&& other) noexcept;
  ~FedChild();

  /// Waits until the child has taken it all. False where it takes no more, or this program is interrupted.
  bool feed(const void* bytes, std::size_t count);
  /// Ends its input and waits for its end. None where this program is interrupted before.
  std::optional<ChildResult> wait();

 private:
  FedChild(pid_t process, int input, ChildOutputs outputs)
      : process_(process), input_(input), outputs_(std::move(outputs)) {}
  void end_input();

  pid_t process_;  // 0: waited for
  int input_;      // our end of its standard input; -1: closed
  ChildOutputs outputs_;
};

/// Runs a program, as above but with nothing to read, and waits for its end, interrupted or not. None where
/// there is no such program. Error: io, where it cannot be started.
std::optional<ChildResult> run_child(const std::vector<std::string>& words);

}  // namespace sandstroke
