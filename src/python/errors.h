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

/// Lets Ctrl-C through to Python now and then, from work that lets the interpreter go: throws
/// KeyboardInterrupt as Python does.
class SignalWatch {
 public:
  void look();

 private:
  double next_ = 0.0;  // s, on a steady clock
};

}  // namespace sandstroke
