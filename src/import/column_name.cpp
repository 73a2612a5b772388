#include "import/column_name.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "import/text_parts.h"
#include "import/units.h"

namespace sandstroke {
namespace {

using Words = std::set<std::string>;
const Words position_words{"p",     "pos",  "position", "tip",   "tcp", "translation",
                           "point", "pose", "ee",       "coord", "xyz"};
const Words velocity_words{"v", "vel", "velocity", "speed", "twist"};
const Words force_words{"f", "force", "wrench"};
const Words orientation_words{"q", "quat", "quaternion", "orientation", "rot", "rotation"};
const Words time_words{"t", "time", "timestamp", "stamp", "zeit", "temps", "tiempo"};
const Words number_words{"frame", "sample", "seq", "index"};  // of the sample
const Words other_words{"torque",       "tau",  "moment",  "a",   "acc",    "accel",
                        "acceleration", "gyro", "omega",   "mag", "target", "desired",
                        "goal",         "cmd",  "command", "ref", "cov",    "angular"};

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }
bool alnum(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

bool is_unit(const std::string& text) {
  for (const Quantity quantity : {Quantity::length, Quantity::time, Quantity::speed, Quantity::force})
    if (known_unit(quantity, text)) return true;
  return false;
}

std::string trimmed(std::string_view text) { return std::string(without_blanks(text, " \t")); }

void take_unit(const std::string& name, ColumnName& column) {
  column.bare = name;
  const auto open = name.find_last_of("[(");
  if (open != std::string::npos && open > 0 && (name.ends_with(']') || name.ends_with(')'))) {
    const std::string inside = trimmed(name.substr(open + 1, name.size() - open - 2));
    if (inside.empty() || std::isdigit(static_cast<unsigned char>(inside[0]))) return;  // an index
    column.unit = inside;
    column.bare = trimmed(name.substr(0, open));
    return;
  }
  for (const char mark : {'_', '/', ' '}) {
    const auto first = name.find(mark, 1);  // the unit of "v_m/s" follows the first mark
    if (first == std::string::npos) continue;
    for (const auto at : {name.rfind(mark), first}) {
      if (at == 0 || !is_unit(name.substr(at + 1))) continue;
      column.unit = name.substr(at + 1);
      column.bare = trimmed(name.substr(0, at));
      return;
    }
  }
}

/// The words of a name, in small letters: tip, pos, x of "tip_posX".
std::vector<std::string> words_of(const std::string& bare) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < bare.size(); ++i) {
    if (!alnum(bare[i])) continue;
    const bool hump = i > 0 && std::islower(static_cast<unsigned char>(bare[i - 1])) &&
                      std::isupper(static_cast<unsigned char>(bare[i]));
    if (i == 0 || !alnum(bare[i - 1]) || hump) words.emplace_back();
    words.back() += lower(bare[i]);
  }
  return words;
}

/// Takes the axis off the last word, such as "x" or "fx".
int take_axis(std::vector<std::string>& words) {
  constexpr std::string_view axes = "xyzw";
  std::string& last = words.back();
  const auto axis = axes.find(last.back());
  if (axis == std::string_view::npos) return -1;
  const std::string before = last.substr(0, last.size() - 1);
  if (!before.empty() && !position_words.contains(before) && !velocity_words.contains(before) &&
      !force_words.contains(before) && !orientation_words.contains(before))
    return -1;
  words.pop_back();
  if (!before.empty()) words.push_back(before);
  return static_cast<int>(axis);
}

/// Takes the number off a matrix's column, "pos.1" to "pos.3". Numbers do not tell a quaternion's order:
/// MATLAB has w first.
int take_number(const std::string& bare, std::vector<std::string>& words) {
  if (words.size() < 2 || bare.size() < 2 || bare[bare.size() - 2] != '.') return -1;
  const int axis = bare.back() - '1';
  const std::string& before = words[words.size() - 2];
  if (axis < 0 || axis > 3 ||
      (!position_words.contains(before) && !velocity_words.contains(before) && !force_words.contains(before)))
    return -1;
  words.pop_back();
  return axis;
}

/// The position of "r11" to "r33" (first = '1'), or "r00" to "r22" (first = '0'), in a matrix, row by row.
int matrix_position(const std::string& word, char first) {
  if (word.size() != 3 || word[0] != 'r') return -1;
  const int row = word[1] - first, column = word[2] - first;
  return row >= 0 && row < 3 && column >= 0 && column < 3 ? 3 * row + column : -1;
}

}  // namespace

ColumnName column_name(const std::string& name) {
  using enum ColumnName::Means;
  ColumnName column;
  take_unit(name, column);
  std::vector<std::string> words = words_of(column.bare);
  if (words.empty()) return column;
  const auto any_in = [&](const Words& known) {
    return std::any_of(words.begin(), words.end(),
                       [&](const std::string& word) { return known.contains(word); });
  };
  column.rank = static_cast<int>(words.size());
  if (time_words.contains(words.back())) {
    column.means = time;
    return column;
  }
  if (number_words.contains(words.back())) {
    column.means = number;
    return column;
  }
  if (words.back() == "pressure") {
    column.means = pressure;
    return column;
  }
  for (const char first : {'1', '0'}) {
    column.axis = matrix_position(words.back(), first);
    if (column.axis < 0) continue;
    column.means = matrix;
    column.group = first;
    return column;
  }
  column.axis = take_number(column.bare, words);
  column.numbered = column.axis >= 0;
  if (!column.numbered) column.axis = take_axis(words);
  column.group = fmt::format("{}", fmt::join(words, " "));
  if (column.axis < 0 || any_in(other_words)) return column;
  if (any_in(orientation_words)) {
    column.means = orientation;
  } else if (any_in(force_words)) {
    column.means = force;
  } else if (any_in(velocity_words)) {
    column.means = velocity;
  } else {
    column.means = position;
    column.rank = words.empty() ? 0 : any_in(position_words) ? 1 : 2;
  }
  return column;
}

std::vector<std::string> parts_of_list(const std::string& list) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin <= list.size() && !list.empty()) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    parts.push_back(trimmed(list.substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

}  // namespace sandstroke
