#pragma once

#include <string>

namespace sandstroke {

/// One line on stderr that is drawn over and over, and cleared by the destructor. It is drawn only on a
/// terminal, not if the log is quiet, nor while the program runs in the background. It is not drawn on a held
/// terminal (Ctrl-S), which would stop the program, too.
class StatusLine {
 public:
  StatusLine();
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// True if somebody can see the line.
  bool visible() const { return visible_; }
  /// Draws the text, cut to the width of the terminal.
  void draw(const std::string& text);
  void clear();

 private:
  bool visible_, drawn_ = false;
};

}  // namespace sandstroke
