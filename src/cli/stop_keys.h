#pragma once

namespace sandstroke {

/// While it lives, the keys typed at the terminal come one by one and unseen, so that one of them can stop
/// what goes on. Nothing, where the standard input is no terminal, or another job's, or where something was
/// typed ahead, for that is meant for the shell. Whatever ends the program, but what cannot be caught, the
/// terminal is left as it was.
class StopKeys {
 public:
  StopKeys();
  ~StopKeys();
  StopKeys(const StopKeys&) = delete;
  StopKeys& operator=(const StopKeys&) = delete;

  /// There is a keyboard.
  bool listening() const { return listening_; }
  /// q, Esc, Enter or space was typed since the last time it was asked.
  bool pressed();

 private:
  bool listening_ = false;
};

}  // namespace sandstroke
