#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "import/gcode_words.h"

namespace sandstroke {

/// Which lines of a file a controller would follow, as far as a file tells it without being run. The program
/// ends at M2, M30, M99 or at a % after its beginning; a subprogram's lines (O100 sub to O100 endsub) are
/// left out where they stand. Calls, loops and branches are not followed; warnings tell of each.
class GcodeProgram {
 public:
  explicit GcodeProgram(const std::string& name) : name_(name) {}

  /// The words of a line; none if it is not followed. Error: input.
  std::optional<GcodeWords> words_to_follow(std::string_view line, std::size_t number);
  void note_call(const std::string& word, std::size_t line);
  void pass_over_rotary_axes(std::size_t line);
  /// Takes note of a move in the coordinates of the machine (G53 G1 X5).
  void pass_over_machine_move(std::size_t line);
  std::vector<std::string> warnings() const;

 private:
  struct Lines {
    std::size_t count = 0, first = 0;
    void note(std::size_t line) {
      if (count++ == 0) first = line;
    }
  };
  static std::string text(const Lines& lines);
  bool takes_percent(std::string_view line, std::size_t number);
  void end(const std::string& word, std::size_t line);
  void pass_over(std::string_view line, std::size_t number);

  const std::string& name_;
  bool has_begun_ = false;  // a % or a word came
  bool in_subprogram_ = false;
  std::string end_word_;  // empty: the program has not ended
  std::size_t end_line_ = 0;
  Lines after_end_, in_subprograms_, rotary_, macros_, skippable_, of_machine_;
  std::string first_macro_;
  std::map<std::string, Lines> calls_;
};

}  // namespace sandstroke
