#include "import/column_name.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "core/small_letters.h"
#include "import/text_parts.h"
#include "import/units.h"

namespace sandstroke {
namespace {

using Means = ColumnName::Means;
using Words = std::set<std::string>;
const Words position_words{"p",     "pos",  "position", "tip",   "tcp", "translation",
                           "point", "pose", "ee",       "coord", "xyz"};
const Words velocity_words{"v", "vel", "velocity", "speed", "twist"};
const Words force_words{"f", "force", "wrench"};
const Words orientation_words{"q", "quat", "quaternion", "orientation", "rot", "rotation"};
const Words time_words{"t",       "time", "timestamp", "timestamps", "stamp",
                       "elapsed", "ts",   "zeit",      "temps",      "tiempo"};
const Words number_words{"frame", "sample", "seq", "index"};  // of the sample
const Words other_words{"torque",  "tau",   "moment", "a",       "acc",     "accel",  "acceleration",
                        "gyro",    "omega", "mag",    "target",  "desired", "goal",   "cmd",
                        "command", "ref",   "cov",    "angular", "joint",   "joints", "gimbal",
                        "tilt",    "angle", "euler",  "std",     "stddev",  "scale"};

// Names without what parts their words, in small letters.
const Words stroke_numbers{"stroke",      "strokes",   "strokeid",    "strokenumber",
                           "strokeindex", "strokeno",  "strokenr",    "strokenum",
                           "strokeidx",   "penstroke", "penstrokeid", "penstrokenumber"};
const Words perhaps_stroke_numbers{
    "segment", "segmentid", "segmentindex", "segmentnumber", "trial",   "path",      "pathid",     "line",
    "lineid",  "curve",     "curveid",      "letter",        "part",    "group",     "id",         "seg",
    "segid",   "trace",     "traceid",      "polyline",      "contour", "contourid", "polylineid", "penid"};
const Words pen_downs{"pen",       "penstate",  "pendown",    "ispendown", "penisdown",   "tipdown",
                      "tipswitch", "istipdown", "pencontact", "pentouch",  "pentouching", "stylusdown"};
const Words pen_ups{"penup", "ispenup", "penisup", "penlifted", "tipup", "stylusup"};
const Words perhaps_pen_downs{"contact", "incontact", "iscontact", "touch",  "touching", "istouching",
                              "button",  "button1",   "down",      "isdown", "state",    "penstatus",
                              "status",  "drawing",   "event",     "tip"};
const Words perhaps_pen_ups{"hover", "hovering", "ishovering", "up", "isup", "lifted", "islifted"};
// After other words these may say something else: "user_id", "x_pen", "not_pen_down".
const Words only_bare{"id", "up", "down", "tip"};
const Words short_names{"pen", "stroke", "strokes"};
const Words negations{"not", "no", "non"};

/// One word of a name, in small letters, and where it begins in the name.
struct Word {
  std::string text;
  std::size_t begin;
};

bool alnum(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }
bool digit(char c) { return c >= '0' && c <= '9'; }

int axis_of(char c) {
  const auto axis = std::string_view("xyzw").find(c);
  return axis == std::string_view::npos ? -1 : static_cast<int>(axis);
}

bool is_quantity(const std::string& word) {
  return position_words.contains(word) || velocity_words.contains(word) || force_words.contains(word) ||
         orientation_words.contains(word);
}

std::string trimmed(std::string_view text) { return std::string(without_blanks(text, " \t")); }

/// The words of a name: tip, pos, x of "tip_posX".
std::vector<Word> words_of(const std::string& bare) {
  std::vector<Word> words;
  for (std::size_t i = 0; i < bare.size(); ++i) {
    if (!alnum(bare[i])) continue;
    const bool hump = i > 0 && std::islower(static_cast<unsigned char>(bare[i - 1])) &&
                      std::isupper(static_cast<unsigned char>(bare[i]));
    if (i == 0 || !alnum(bare[i - 1]) || hump) words.push_back({"", i});
    words.back().text += small_letter(bare[i]);
  }
  return words;
}

bool ends_in_time(const std::string& name) {
  const std::vector<Word> words = words_of(name);
  return !words.empty() && time_words.contains(words.back().text);
}

/// True for minutes, hours and days, whose names mean other things, too: "x_min", "day".
bool is_coarse_time(std::string_view unit) {
  const auto known = known_unit(Quantity::time, unit);
  return known && known->factor > 1.0;
}

void take_unit(const std::string& name, ColumnName& column) {
  column.bare = name;
  const auto open = name.find_last_of("[(");
  if (open != std::string::npos && open > 0 && (name.ends_with(']') || name.ends_with(')'))) {
    const std::string inside = trimmed(name.substr(open + 1, name.size() - open - 2));
    const bool is_axis = inside.size() == 1 && axis_of(small_letter(inside[0])) >= 0;
    if (inside.empty() || digit(inside[0]) || is_axis) return;  // an index
    column.unit = unit_symbol(inside);
    column.bare = trimmed(name.substr(0, open));
    return;
  }
  for (const char mark : {'_', '/', ' '}) {
    const auto first = name.find(mark, 1);  // the unit of "v_m/s" follows the first mark
    if (first == std::string::npos) continue;
    for (const auto at : {name.rfind(mark), first}) {
      const std::string unit = name.substr(at + 1);
      if (at == 0 || !is_unit(unit) || unit == "second") continue;  // "x_second" follows "x_first"
      if (is_coarse_time(unit) && !ends_in_time(name.substr(0, at))) continue;
      column.unit = unit_symbol(unit);
      column.bare = trimmed(name.substr(0, at));
      return;
    }
  }
}

class NameReader {
 public:
  explicit NameReader(const std::string& name) {
    take_unit(name, column_);
    words_ = words_of(column_.bare);
    column_.shape = column_.bare;
  }

  ColumnName read() {
    using enum ColumnName::Means;
    if (words_.empty()) return column_;
    column_.rank = static_cast<int>(words_.size());
    if (take_time() || take_pen() || take_matrix() || take_pose_of_franka()) return finished();
    if (last() == "pressure" || number_words.contains(last())) {
      column_.means = last() == "pressure" ? pressure : number;
      return finished();
    }
    if (!take_number() && !take_last_axis() && !take_numbered_axis()) take_first_axis();
    if (column_.axis < 0 || any_in(other_words)) return finished();
    if (any_in(orientation_words)) {
      column_.means = orientation;
    } else if (any_in(force_words)) {
      column_.means = force;
    } else if (any_in(velocity_words)) {
      column_.means = velocity;
    } else {
      column_.means = position;
      column_.rank = words_.empty() ? 0 : any_in(position_words) ? 1 : 2;
    }
    return finished();
  }

 private:
  std::string& last() { return words_.back().text; }
  bool any_in(const Words& known) const {
    return std::any_of(words_.begin(), words_.end(),
                       [&](const Word& word) { return known.contains(word.text); });
  }

  ColumnName finished() {
    std::vector<std::string> texts;
    for (const Word& word : words_) texts.push_back(word.text);
    if (column_.group.empty()) column_.group = fmt::format("{}", fmt::join(texts, " "));
    column_.shape += " " + column_.unit;
    return column_;
  }

  /// Notes an axis, and takes its letters out of the shape, but for their case.
  void set_axis(int axis, std::size_t begin, std::size_t length = 1) {
    column_.axis = axis;
    const bool large = std::isupper(static_cast<unsigned char>(column_.shape[begin])) != 0;
    column_.shape.replace(begin, length, large ? "X" : "x");
  }

  /// A unit of time may be the whole name, or stand for "stamp_sec" and the like.
  bool take_time() {
    const bool is_unit_of_time = last().size() > 1 && last() != "second" &&
                                 known_unit(Quantity::time, last()) && !is_coarse_time(last());
    const bool has_time = words_.size() > 1 && time_words.contains(words_[words_.size() - 2].text);
    if (column_.unit.empty() && is_unit_of_time && (words_.size() == 1 || has_time)) {
      column_.unit = unit_symbol(last());
      if (words_.size() == 1) ++column_.rank;  // "t" is plainer than "ms"
      words_.pop_back();
    } else if (!time_words.contains(last())) {
      return false;
    }
    column_.means = Means::time;
    if (is_coarse_time(column_.unit)) ++column_.rank;  // seconds beside them say more
    return true;
  }

  /// The last words may tell of a pen: "tip.pen_down", "rec.stroke_id". The longest such name counts.
  bool take_pen() {
    const std::pair<const Words*, Means> lists[] = {{&stroke_numbers, Means::stroke_number},
                                                    {&perhaps_stroke_numbers, Means::perhaps_stroke_number},
                                                    {&pen_downs, Means::pen_down},
                                                    {&pen_ups, Means::pen_up},
                                                    {&perhaps_pen_downs, Means::perhaps_pen_down},
                                                    {&perhaps_pen_ups, Means::perhaps_pen_up}};
    for (std::size_t first = 0; first < words_.size(); ++first) {
      std::string name;
      for (std::size_t i = first; i < words_.size(); ++i) name += words_[i].text;
      for (const auto& [names, means] : lists) {
        if (!names->contains(name) || !may_precede(first, name)) continue;
        column_.means = means;
        return true;
      }
    }
    return false;
  }

  /// True if the words before that one leave the name of a pen's column what it is.
  bool may_precede(std::size_t first, const std::string& name) const {
    const bool bare_only = only_bare.contains(name), is_short = short_names.contains(name);
    const auto says_other = [&](const Word& word) {
      const std::string& text = word.text;
      if (bare_only || negations.contains(text) || other_words.contains(text)) return true;
      const bool is_axis = text.size() == 1 && axis_of(text[0]) >= 0;
      return is_short && (is_axis || text == "pressure" || velocity_words.contains(text) ||
                          force_words.contains(text) || orientation_words.contains(text));
    };
    return std::none_of(words_.begin(), words_.begin() + static_cast<std::ptrdiff_t>(first), says_other);
  }

  /// The position of "r11" to "r33", or "r00" to "r22", in a matrix, row by row.
  bool take_matrix() {
    const std::string& word = last();
    if (word.size() != 3 || word[0] != 'r') return false;
    for (const char first : {'1', '0'}) {
      const int row = word[1] - first, column = word[2] - first;
      if (row < 0 || row > 2 || column < 0 || column > 2) continue;
      column_.axis = 3 * row + column;
      column_.means = Means::matrix;
      column_.group = column_.shape = first;
      return true;
    }
    return false;
  }

  /// libfranka writes the tip's pose as a matrix of 4 x 4, column by column: "O_T_EE[0]" to "O_T_EE[15]".
  bool take_pose_of_franka() {
    const std::size_t count = words_.size();
    if (count < 4 || words_[count - 4].text != "o" || words_[count - 3].text != "t" ||
        words_[count - 2].text != "ee" || last().size() > 2 ||
        !std::all_of(last().begin(), last().end(), digit))
      return false;
    const int index = std::stoi(last()), row = index % 4, column = index / 4;
    if (row > 2 || column > 3) return true;  // 0, 0, 0, 1
    column_.means = column == 3 ? Means::position : Means::matrix;
    column_.rank = 1;
    column_.axis = column == 3 ? row : 3 * row + column;
    column_.group = column_.shape = "o t ee";
    return true;
  }

  /// The number of a matrix's column, "pos.1" to "pos.3" or "pos[0]" to "pos[2]". Numbers do not tell a
  /// quaternion's order: MATLAB has w first.
  bool take_number() {
    if (words_.size() < 2 || last().size() != 1 || !digit(last()[0])) return false;
    const std::string& before = words_[words_.size() - 2].text;
    if (!position_words.contains(before) && !velocity_words.contains(before) && !force_words.contains(before))
      return false;
    const std::size_t at = words_.back().begin;
    if (std::string_view("._[( ").find(column_.bare[at - 1]) == std::string_view::npos) return false;
    column_.numbered = true;
    column_.dotted = column_.bare[at - 1] == '.';
    set_axis(last()[0] - '0', at);
    words_.pop_back();
    return true;
  }

  /// Takes the axis off the last word: "x", "fx", "posx".
  bool take_last_axis() {
    const int axis = axis_of(last().back());
    const std::string before = last().substr(0, last().size() - 1);
    if (axis < 0 || (!before.empty() && !is_quantity(before))) return false;
    set_axis(axis, words_.back().begin + before.size());
    if (before.empty())
      words_.pop_back();
    else
      last() = before;
    return true;
  }

  /// "X1" of the first marker.
  bool take_numbered_axis() {
    const int axis = axis_of(last()[0]);
    if (axis < 0 || last().size() < 2 || !std::all_of(last().begin() + 1, last().end(), digit)) return false;
    set_axis(axis, words_.back().begin);
    last().erase(0, 1);
    return true;
  }

  /// An axis before its quantity: "x_pos", "X Position", "tip x velocity".
  bool take_first_axis() {
    std::size_t at = words_.size();
    while (at > 0 && is_quantity(words_[at - 1].text)) --at;
    if (at == 0 || at == words_.size() || words_[at - 1].text.size() != 1) return false;
    const int axis = axis_of(words_[--at].text[0]);
    if (axis < 0) return false;
    set_axis(axis, words_[at].begin);
    words_.erase(words_.begin() + static_cast<std::ptrdiff_t>(at));
    return true;
  }

  ColumnName column_;
  std::vector<Word> words_;
};

}  // namespace

ColumnName column_name(const std::string& name) { return NameReader(name).read(); }

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
