#pragma once

#include <spdlog/fmt/fmt.h>

#include <stdexcept>
#include <string>

namespace sandstroke {

/// The program's exit code when it fails. 0 means success; 1 means that a comparison failed.
enum class ErrorKind {
  input = 2,     ///< bad input or usage: the user must change the input
  unstable = 3,  ///< not converged or unstable: the user must change settings
  io = 4,        ///< the system would not read or write
};

/// The only exception of this program. Its sentence says what failed, where (file, line, key) and what to do.
/// It is one line, and whole: terminal_line() escapes what it quotes, also a zero byte, at which what() would
/// end.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& sentence);
  ErrorKind kind() const { return kind_; }
  int exit_code() const { return static_cast<int>(kind_); }

 private:
  ErrorKind kind_;
};

/// Input that needs more memory than this machine has.
class NotEnoughMemory : public Error {
 public:
  explicit NotEnoughMemory(const std::string& sentence) : Error(ErrorKind::input, sentence) {}
};

/// True if the machine is the cause: the same input may work elsewhere or later.
inline bool is_of_the_machine(const Error& error) {
  return error.kind() == ErrorKind::io || dynamic_cast<const NotEnoughMemory*>(&error);
}

template <class... Args>
[[noreturn]] void throw_input_error(fmt::format_string<Args...> sentence, Args&&... args) {
  throw Error(ErrorKind::input, fmt::format(sentence, std::forward<Args>(args)...));
}

template <class... Args>
[[noreturn]] void throw_io_error(fmt::format_string<Args...> sentence, Args&&... args) {
  throw Error(ErrorKind::io, fmt::format(sentence, std::forward<Args>(args)...));
}

/// The result of `make`, or an empty one where the file does not hold it (Error: input).
template <class Make>
auto as_far_as_known(const Make& make) -> decltype(make()) {
  try {
    return make();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::input) throw;
    return {};
  }
}

}  // namespace sandstroke
