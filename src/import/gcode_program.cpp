#include "import/gcode_program.h"

#include <algorithm>

#include "core/error.h"
#include "import/text_parts.h"

namespace sandstroke {
namespace {

/// The words of a line that is not followed, and so may hold any text.
GcodeWords words_if_any(std::string_view line) {
  try {
    return gcode_words(line, "");
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

std::string GcodeProgram::text(const Lines& lines) {
  return lines.count == 1 ? fmt::format("line {}", lines.first)
                          : fmt::format("{} lines, the first is line {}", lines.count, lines.first);
}

std::optional<GcodeWords> GcodeProgram::words_to_follow(std::string_view line, std::size_t number) {
  if (!end_word_.empty()) {
    pass_over(line, number);
    return {};
  }
  if (takes_percent(line, number)) return {};
  if (in_subprogram_ && words_if_any(line).control != "ENDSUB") return {};
  GcodeWords words = gcode_words(line, fmt::format("{}:{}", name_, number));
  if (words.control == "SUB" || words.control == "ENDSUB") {
    in_subprogram_ = words.control == "SUB";
    in_subprograms_.note(number);
    return {};
  }
  if (!words.macro.empty()) {
    if (macros_.count == 0) first_macro_ = words.macro;
    macros_.note(number);
    return {};
  }
  if (words.may_be_skipped && words.has_any_of("XYZIJ")) skippable_.note(number);
  if (!words.control.empty()) note_call("O " + words.control, number);
  for (const int code : words.m) {
    if (code == 970 || code == 980) note_call(gcode_word_text('M', code), number);
    if (code == 20 || code == 300 || code == 990) end(gcode_word_text('M', code), number);
  }
  has_begun_ = has_begun_ || !words.g.empty() || !words.m.empty() || words.has_any_of("OXYZ");
  return words;
}

/// A % alone begins or ends a tape.
bool GcodeProgram::takes_percent(std::string_view line, std::size_t number) {
  if (without_blanks(line) != "%") return false;
  if (has_begun_) end("%", number);
  has_begun_ = true;
  return true;
}

void GcodeProgram::end(const std::string& word, std::size_t line) {
  end_word_ = word;
  end_line_ = line;
}

/// Counts a line behind the program's end, if it would have moved the tool.
void GcodeProgram::pass_over(std::string_view line, std::size_t number) {
  if (words_if_any(line).has_any_of("XYZIJ")) after_end_.note(number);
}

void GcodeProgram::note_call(const std::string& word, std::size_t line) { calls_[word].note(line); }

void GcodeProgram::pass_over_rotary_axes(std::size_t line) { rotary_.note(line); }

void GcodeProgram::pass_over_machine_move(std::size_t line) { of_machine_.note(line); }

std::vector<std::string> GcodeProgram::warnings() const {
  std::vector<std::string> sentences;
  for (const auto& [word, lines] : calls_)
    sentences.push_back(fmt::format(
        "{}: {} is not followed ({}), so what it runs, repeats or leaves out is not drawn that way; "
        "write the moves themselves",
        name_, word, text(lines)));
  if (in_subprograms_.count > 0)
    sentences.push_back(fmt::format("{}: the subprograms between O sub and O endsub are not drawn ({})",
                                    name_, text(in_subprograms_)));
  if (after_end_.count > 0)
    sentences.push_back(fmt::format("{}:{}: {} ends the program, so the moves behind it are not drawn ({})",
                                    name_, end_line_, end_word_, text(after_end_)));
  if (macros_.count > 0)
    sentences.push_back(
        fmt::format("{}: {} and other names of macros are passed over ({}), so what they move is not drawn; "
                    "write the moves themselves",
                    name_, first_macro_, text(macros_)));
  if (skippable_.count > 0)
    sentences.push_back(fmt::format(
        "{}: moves in lines that begin with / are drawn ({}); remove those that the machine skips", name_,
        text(skippable_)));
  if (of_machine_.count > 0)
    sentences.push_back(fmt::format(
        "{}: G53 moves the tool in the machine's coordinates, whose distance from the path is not in "
        "the file, so these cuts are not drawn ({}); write them in the path's coordinates",
        name_, text(of_machine_)));
  if (rotary_.count > 0)
    sentences.push_back(
        fmt::format("{}: moves along A, B, C, U, V or W are left out ({}); only X, Y and Z are read", name_,
                    text(rotary_)));
  return sentences;
}

}  // namespace sandstroke
