#include "import/gcode_outputs.h"

#include <algorithm>

#include <spdlog/fmt/fmt.h>

namespace sandstroke {
namespace {

/// M words that switch the same output, times 10.
struct OutputRow {
  int first, last;
};
constexpr OutputRow coolant = {70, 90}, fan = {1060, 1070};
constexpr OutputRow rows[] = {coolant,    {100, 110},   {420, 420},   {620, 650}, {670, 670},
                              {680, 680}, {1010, 1030}, {1260, 1270}, fan,        {3400, 3400}};

const OutputRow* row_of(int m) {
  const auto* row = std::find_if(std::begin(rows), std::end(rows), [&](const OutputRow& each) {
    return each.first <= m && m <= each.last && m % 10 == 0;
  });
  return row == std::end(rows) ? nullptr : row;
}

/// "P4 S255": the words of an M word that are among those letters.
std::string own_text(const GcodeWords& words, std::string_view letters) {
  std::string text;
  for (const char letter : letters)
    if (const auto& value = GcodeWords::of(words.own, letter)) text += fmt::format(" {}{:g}", letter, *value);
  return text;
}

constexpr std::size_t most = 16;  // outputs, and states of each; a file may have any number

}  // namespace

int gcode_output_of(int m) {
  const OutputRow* row = row_of(m);
  return row ? row->first : m;
}

bool switches_fan_off(const std::vector<int>& m, const GcodeWords::Values& own) {
  const auto has = [&](int code) { return std::find(m.begin(), m.end(), code) != m.end(); };
  return has(fan.last) || (has(fan.first) && GcodeWords::of(own, 'S') == 0.0);
}

void GcodeOutputs::take(const GcodeWords& words, std::size_t line) {
  extrudes_ = extrudes_ || words['E'];
  for (const int m : words.m)
    if (row_of(m))
      note_state(gcode_word_text('M', gcode_output_of(m)) + own_text(words, "EP"),
                 gcode_word_text('M', m) + own_text(words, "EPQS"), line);
}

void GcodeOutputs::take_power(double power, std::size_t line) {
  note_state("S", fmt::format("M3 S{:g}", power), line);
}

void GcodeOutputs::note_state(const std::string& output, const std::string& state, std::size_t line) {
  if (outputs_.size() >= most && outputs_.find(output) == outputs_.end()) return;
  Output& out = outputs_[output];
  if (out.states.empty()) out.line = line;
  auto at = std::find(out.states.begin(), out.states.end(), state);
  if (at == out.states.end()) {
    if (out.states.size() >= most) return;
    at = out.states.insert(at, state);
  }
  const auto now = static_cast<std::size_t>(at - out.states.begin());
  if (now != out.now && out.moves_now) {
    ++out.changes;
    out.moves_now = false;
  }
  out.now = now;
}

void GcodeOutputs::note_move() {
  for (auto& [name, output] : outputs_) {
    output.moved.insert(output.now);
    output.moves_now = true;
  }
}

std::vector<GcodeOutputs::Question> GcodeOutputs::questions() const {
  std::vector<Question> questions;
  for (const auto& [name, output] : outputs_) {
    const bool is_coolant = name == gcode_word_text('M', coolant.first);
    const bool is_fan_of_print = extrudes_ && name.starts_with(gcode_word_text('M', fan.first));
    if (output.moved.size() < 2 || is_fan_of_print || (is_coolant && output.changes < 2)) continue;
    Question question{output.line, {}, is_coolant};
    for (const std::size_t state : output.moved) question.states.push_back(output.states[state]);
    questions.push_back(question);
  }
  return questions;
}

}  // namespace sandstroke
