#pragma once

namespace sandstroke {

/// Reads keys at the terminal one by one and without echo, so that a key can stop the program. Does nothing
/// if the standard input is not a terminal, or is another job's, or if something was typed ahead, which is
/// for the shell. Restores the terminal however the program ends, except by signals that cannot be caught.
class StopKeys {
 public:
  StopKeys();
  ~StopKeys();
  StopKeys(const StopKeys&) = delete;
  StopKeys& operator=(const StopKeys&) = delete;

  /// True if it reads keys.
  bool listening() const { return listening_; }
  /// True if q, Esc, Enter or space was typed since the last call.
  bool pressed();

 private:
  bool listening_ = false;
};

}  // namespace sandstroke
