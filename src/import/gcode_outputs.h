#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "import/gcode_words.h"

namespace sandstroke {

/// The first M word (times 10) of those that switch the same output of a machine, of which one may lift a
/// pen: M106 and M107 (fan), M42 (pin), M340 (servo), M62 to M65, M67, M68, M10 and M11, M101 to M103, M126
/// and M127, M7 to M9 (coolant). Other words are their own.
int gcode_output_of(int m);
/// True if a line switches the fan off: M107, M106 S0.
bool switches_fan_off(const std::vector<int>& m, const GcodeWords::Values& own);

/// The states of a machine's outputs, and in which of them moves are made.
class GcodeOutputs {
 public:
  /// Takes the M words of a line.
  void take(const GcodeWords& words, std::size_t line);
  /// Takes an S that stands without the word of a spindle.
  void take_power(double power, std::size_t line);
  /// Takes note of a move along X or Y.
  void note_move();

  /// An output that moves are made with in several states, so that it may lift a pen.
  struct Question {
    std::size_t line;                 ///< of its first state
    std::vector<std::string> states;  ///< words with which moves are made, in their order
    bool is_coolant;
  };
  /// Each of them; coolant only if it alternates more than once, and a fan not in a print (E).
  std::vector<Question> questions() const;

 private:
  struct Output {
    std::vector<std::string> states;
    std::set<std::size_t> moved;  // states with moves
    std::size_t now = 0, line = 0, changes = 0;
    bool moves_now = false;
  };
  void note_state(const std::string& output, const std::string& state, std::size_t line);

  std::map<std::string, Output> outputs_;
  bool extrudes_ = false;
};

}  // namespace sandstroke
