#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "core/warning.h"

namespace sandstroke {

/// Adds Error, InputError (a ValueError), UnstableError (an ArithmeticError), FileError (an OSError) and
/// ResultWarning (a UserWarning) to the module. Their sentences are the program's error sentences.
void add_errors(pybind11::module_& module);

/// Collects the warnings that this thread logs while it lives. give() makes Python warnings of them, so that
/// none is raised while the interpreter lock is released: a ResultWarning where there is a code.
class Warnings {
 public:
  Warnings();
  ~Warnings();
  Warnings(const Warnings&) = delete;
  Warnings& operator=(const Warnings&) = delete;
  void add(const std::string& sentence) { sentences_.push_back(sentence); }
  /// Call it with the interpreter lock. May throw: users can turn a warning into an error.
  void give();

 private:
  WarningList coded_;
  std::vector<std::string> sentences_;
  std::vector<std::string>* before_;
};

/// Handles an exception that a user's function raised. Keeps a KeyboardInterrupt or SystemExit for
/// throw_kept(). Throws a std::runtime_error with the first line of the exception's text.
[[noreturn]] void throw_raised(const pybind11::error_already_set& raised);
/// Throws the kept exception, or rethrows the current one if none was kept. Call it in a catch block.
[[noreturn]] void throw_kept();

/// Runs work that calls a user's functions. An exception that throw_raised() kept ends it.
template <class Work>
auto or_what_ended_it(const Work& work) {
  try {
    return work();
  } catch (...) {
    throw_kept();
  }
}

/// Checks for Ctrl-C now and then during work without the interpreter lock. Throws KeyboardInterrupt as
/// Python does. A daemon thread stays here when the interpreter ends.
class SignalWatch {
 public:
  void look();

 private:
  double next_ = 0.0;  // s, on a steady clock
};

}  // namespace sandstroke
