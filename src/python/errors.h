#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace sandstroke {

/// Error, InputError (a ValueError), UnstableError (an ArithmeticError) and FileError (an OSError) of the
/// module: what the program ends with, in the same sentences.
void add_errors(pybind11::module_& module);

/// What is logged as a warning by this thread while it lives becomes Python warnings when it is told to
/// give them; so none comes while the interpreter is let go.
class Warnings {
 public:
  Warnings();
  ~Warnings();
  Warnings(const Warnings&) = delete;
  Warnings& operator=(const Warnings&) = delete;
  /// With the interpreter held. May throw: a warning can be made an error.
  void give();

 private:
  std::vector<std::string> sentences_;
  std::vector<std::string>* before_;
};

/// Of a function of the user's that was called from work: its KeyboardInterrupt or SystemExit is kept, to end
/// that work as itself; what else it raised is told in one line.
[[noreturn]] void throw_raised(const pybind11::error_already_set& raised);
/// Throws what was kept, if anything; else what is being thrown. In a catch.
[[noreturn]] void throw_kept();

/// Does work that calls functions of the user's.
template <class Work>
auto or_what_ended_it(const Work& work) {
  try {
    return work();
  } catch (...) {
    throw_kept();
  }
}

/// Lets Ctrl-C through to Python now and then, from work that lets the interpreter go: throws
/// KeyboardInterrupt as Python does.
class SignalWatch {
 public:
  void look();

 private:
  double next_ = 0.0;  // s, on a steady clock
};

}  // namespace sandstroke
