#pragma once

#include <string>

namespace sandstroke {

/// One line on stderr that is drawn over and over, on a terminal only, not where the log is quiet nor while
/// the program runs in the background; gone with its holder. A terminal that is held (Ctrl-S) is left out,
/// for who draws must not be held with it.
class StatusLine {
 public:
  StatusLine();
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// Somebody sees it.
  bool visible() const { return visible_; }
  /// Cut to the width of the terminal.
  void draw(const std::string& text);
  void clear();

 private:
  bool visible_, drawn_ = false;
};

}  // namespace sandstroke
