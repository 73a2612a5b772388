#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "import/gcode_outputs.h"
#include "import/gcode_words.h"

namespace sandstroke {

/// True for M3, M4 and M5; m: the number times 10.
inline bool is_spindle_word(int m) { return m == 30 || m == 40 || m == 50; }

/// The word of a program that lifts or lowers a pen: "M280 S90", "M5", "G0".
struct GcodePenWord {
  std::string text;
  int m = -1;          ///< the M word's number times 10; -1: none
  bool rapid = false;  ///< it is G0
  bool draws = false;  ///< it is G1, as pen_down: the same as G0 as pen_up
  GcodeWords::Values values = {};

  bool given() const { return !text.empty(); }
  bool of_spindle() const { return is_spindle_word(m); }
};

/// GcodePen::word() of an engraver, with M3 and M5, or S.
inline constexpr const char* gcode_spindle = "M3";

/// The pen's state by a program's words. If it has M3 or M4, the pen is down after these, and up after M5, at
/// S0 and in G0. A word that the user names takes their place: the pen is then up after pen_up, and down
/// after another word of the same output (M106 S255, M107), or after pen_down. G0 draws then where the pen is
/// down, unless pen_up is "G0"; with "none" all moves draw. M3, M4, M5 and S stay in force: an S alone moves
/// the pen of "M3 S30".
class GcodePen {
 public:
  /// Error: input, if a word is not one of those.
  GcodePen(const std::string& pen_up, const std::string& pen_down);

  /// Takes the words of a line, before its motion.
  void take(const GcodeWords& words, std::size_t line);
  /// Takes note of a move along X or Y: whether it draws tells what S means.
  void note_move(int motion);
  bool down(int motion) const;
  /// The word that moves the pen, for messages; empty: none does.
  std::string word() const;
  bool is_named() const { return never_lifts_ || up_.given() || down_.given(); }
  /// Warnings on words that never occurred, and on coolant that may be a pen; `name` is the file's.
  /// z_may_lift: Z may lift it.
  std::vector<std::string> warnings(const std::string& name, bool z_may_lift) const;
  /// Error: input, if only the user can know which position lifts the pen.
  void check_known(const std::string& name, bool z_may_lift) const;

 private:
  /// True if the line switches the word's output; for a spindle, also if it changes S.
  bool concerns(const GcodePenWord& word, const GcodeWords& words) const;
  bool matches(const GcodePenWord& word, const GcodeWords& words) const;
  void take_spindle(const GcodeWords& words, std::size_t line);
  void take_servo(const GcodeWords& words, std::size_t line);

  void ask_about_outputs(const std::string& name) const;

  bool never_lifts_;  // pen_up is none: all moves draw
  GcodePenWord up_, down_;
  bool is_down_ = false, has_up_ = false, has_down_ = false;  // of words that are named
  int spindle_ = -1;                                          // the last of M3, M4 and M5
  std::optional<double> power_;
  bool has_spindle_ = false, power_in_moves_ = false, off_in_moves_ = false;
  int first_spindle_ = 30, servo_ = 0;  // the M words that may move a pen, and where they begin
  std::size_t spindle_line_ = 0, servo_line_ = 0;
  std::set<double> drawn_powers_, servo_angles_;
  GcodeOutputs outputs_;
};

}  // namespace sandstroke
