#include "import/gcode_pen.h"

#include <algorithm>

#include "core/error.h"
#include "haptics/table_settings.h"
#include "import/table_option.h"

namespace sandstroke {
namespace {

GcodePenWord pen_word(const std::string& text, const char* key) {
  GcodePenWord word;
  word.text = text;
  if (text.empty()) return word;
  const GcodeWords words = gcode_words(text, key);
  if (words.m.size() == 1 && words.g.empty() && !words.has_text) {
    word.m = words.m.front();
    for (std::size_t i = 0; i < word.values.size(); ++i)
      word.values[i] = words.own[i] ? words.own[i] : words.value[i];
  } else if (words.m.empty() && words.g == std::vector<int>{0} && !words.has_any_of("XYZS")) {
    word.rapid = true;
  } else if (words.m.empty() && words.g == std::vector<int>{10} && !words.has_any_of("XYZS") &&
             std::string_view(key) == "pen_down") {
    word.draws = true;
  } else {
    throw_input_error(
        "{} = \"{}\" is not a G-code word that moves a pen; give a word such as \"M280 S90\", "
        "\"M3 S30\", \"M5\", \"G0\" or none",
        key, text);
  }
  return word;
}

bool has_m(const GcodeWords& words, int code) {
  return std::find(words.m.begin(), words.m.end(), code) != words.m.end();
}
bool has_spindle_word(const GcodeWords& words) {
  return std::any_of(words.m.begin(), words.m.end(), is_spindle_word);
}

std::string m_and_s(int m, double s) { return fmt::format("{} S{}", gcode_word_text('M', m), s); }

}  // namespace

GcodePen::GcodePen(const std::string& pen_up, const std::string& pen_down)
    : never_lifts_(is_none(pen_up)),
      up_(pen_word(never_lifts_ ? "" : pen_up, "pen_up")),
      down_(pen_word(pen_down, "pen_down")) {
  if (down_.draws && (up_.rapid || !up_.given())) {
    up_ = pen_word("G0", "pen_up");
    down_ = {};
  }
  if (down_.draws)
    throw_input_error("pen_up = \"{}\" and pen_down = \"{}\" are two ways to move a pen; leave out one",
                      pen_up, pen_down);
  if (down_.rapid) throw_input_error("pen_down = \"G0\": G0 never draws with a pen; give an M word");
  if (up_.given() && down_.given() && up_.m == down_.m && up_.values == down_.values)
    throw_input_error("pen_up and pen_down are the same word, \"{}\"; give two different ones", pen_up);
  is_down_ = up_.rapid && !down_.given();
}

bool GcodePen::concerns(const GcodePenWord& word, const GcodeWords& words) const {
  if (word.m < 0) return false;
  if (word.of_spindle()) return has_spindle_word(words) || words['S'];
  for (const char letter : {'P', 'E'}) {
    const auto &named = GcodeWords::of(word.values, letter), &own = GcodeWords::of(words.own, letter);
    if (named && own && named != own) return false;  // another pin or servo
  }
  return std::any_of(words.m.begin(), words.m.end(),
                     [&](int m) { return gcode_output_of(m) == gcode_output_of(word.m); });
}

bool GcodePen::matches(const GcodePenWord& word, const GcodeWords& words) const {
  const std::optional<double>& power = GcodeWords::of(word.values, 'S');
  if (word.of_spindle())  // a servo may be moved by S alone
    return (spindle_ == word.m || (spindle_ < 0 && power)) && (!power || power_ == power);
  if (switches_fan_off({word.m}, word.values)) return switches_fan_off(words.m, words.own);
  if (!has_m(words, word.m)) return false;
  for (std::size_t i = 0; i < word.values.size(); ++i)
    if (word.values[i] && words.own[i] != word.values[i] && words.value[i] != word.values[i]) return false;
  return true;
}

void GcodePen::take(const GcodeWords& words, std::size_t line) {
  take_spindle(words, line);
  take_servo(words, line);
  outputs_.take(words, line);
  const bool lifts = concerns(up_, words) && matches(up_, words);
  const bool lowers = concerns(down_, words) && matches(down_, words);
  has_up_ = has_up_ || lifts || (up_.rapid && words.has_g(0));
  has_down_ = has_down_ || lowers;
  if (lifts) {
    is_down_ = false;
  } else if (lowers) {
    is_down_ = true;
  } else if (concerns(down_, words) && !up_.given()) {
    is_down_ = false;
  } else if (concerns(up_, words) && !down_.given()) {
    is_down_ = !up_.of_spindle() || spindle_ != 50;
  }
}

void GcodePen::take_spindle(const GcodeWords& words, std::size_t line) {
  const bool switches = has_spindle_word(words);
  for (const int code : words.m)
    if (is_spindle_word(code)) spindle_ = code;
  if (switches && spindle_ != 50 && !has_spindle_) {
    has_spindle_ = true;
    first_spindle_ = spindle_;
    spindle_line_ = line;
  }
  const bool waits = words.has_g(40) || has_m(words, 0) || has_m(words, 10);
  if (!words['S'] || waits || words.has_g(960) || words.has_g(500)) return;  // S has another meaning
  power_ = words['S'];
  if (spindle_ < 0) outputs_.take_power(*power_, line);
  if (!switches && words.has_any_of("XYZ")) power_in_moves_ = true;
}

void GcodePen::take_servo(const GcodeWords& words, std::size_t line) {
  constexpr double most_angle = 180.0;  // M300 with more is a tone
  const std::optional<double>& angle = GcodeWords::of(words.own, 'S');
  for (const int code : words.m) {
    if ((code != 2800 && code != 3000) || !angle || *angle > most_angle) continue;
    if (servo_angles_.empty()) {
      servo_ = code;
      servo_line_ = line;
    }
    if (code == servo_) servo_angles_.insert(*angle);
  }
}

void GcodePen::note_move(int motion) {
  outputs_.note_move();
  if (!has_spindle_) return;
  if (spindle_ == 50 || power_ == 0.0)
    off_in_moves_ = true;
  else if (motion != 0 && power_)
    drawn_powers_.insert(*power_);
}

bool GcodePen::down(int motion) const {
  if (never_lifts_) return true;
  if (is_named()) return is_down_ && !(up_.rapid && motion == 0);
  return has_spindle_ && spindle_ != 50 && power_ != 0.0 && motion != 0;
}

std::string GcodePen::word() const {
  if (never_lifts_) return "";
  if (up_.given()) return up_.text;
  if (down_.given()) return down_.text;
  return has_spindle_ ? gcode_spindle : "";
}

std::vector<std::string> GcodePen::warnings(const std::string& name, bool z_may_lift) const {
  std::vector<std::string> sentences;
  if (up_.given() && !has_up_)
    sentences.push_back(fmt::format("{}: no line has {}, so the pen never lifts; correct {}", name, up_.text,
                                    option_and_key("pen_up")));
  if (is_named() || has_spindle_ || z_may_lift) return sentences;
  for (const GcodeOutputs::Question& question : outputs_.questions())
    if (question.is_coolant)
      sentences.push_back(fmt::format(
          "{}:{}: {} change between moves, and all of these draw; if one lifts the pen, set {} to it", name,
          question.line, fmt::join(question.states, " and "), option_and_key("pen_up")));
  return sentences;
}

void GcodePen::check_known(const std::string& name, bool z_may_lift) const {
  if (down_.given() && !has_down_)
    throw_input_error("{}: no line has {}, so the pen is never down; correct {}", name, down_.text,
                      option_and_key("pen_down"));
  if (is_named()) return;
  if (servo_angles_.size() > 1)
    throw_input_error(
        "{}:{}: {} moves a pen to S {}, but it is not known which of them lifts it; set {} to the one that "
        "lifts, such as \"{}\"",
        name, servo_line_, gcode_word_text('M', servo_), fmt::join(servo_angles_, " and "),
        option_and_key("pen_up"), m_and_s(servo_, *servo_angles_.rbegin()));
  if (!z_may_lift && !has_spindle_) ask_about_outputs(name);
  constexpr std::size_t most = 4;  // a servo has few positions; more are a laser's shades
  if (z_may_lift || power_in_moves_ || off_in_moves_ || drawn_powers_.size() < 2 ||
      drawn_powers_.size() > most)
    return;
  throw_input_error(
      "{}:{}: moves are made at S {} of {}, and none at M5 or S0, so it is not known which of them lifts the "
      "pen; set {} to the one that lifts, such as \"{}\", or to none if all of them draw",
      name, spindle_line_, fmt::join(drawn_powers_, " and "), gcode_word_text('M', first_spindle_),
      option_and_key("pen_up"), m_and_s(first_spindle_, *drawn_powers_.begin()));
}

void GcodePen::ask_about_outputs(const std::string& name) const {
  for (const GcodeOutputs::Question& question : outputs_.questions())
    if (!question.is_coolant)
      throw_input_error(
          "{}:{}: moves are made after {}, so it is not known which of them lifts the pen; set {} to the one "
          "that lifts, such as \"{}\", or to none if all of them draw",
          name, question.line, fmt::join(question.states, " and after "), option_and_key("pen_up"),
          question.states.front());
}

}  // namespace sandstroke
