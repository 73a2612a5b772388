#include "import/hpgl.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "core/elementary.h"
#include "core/error.h"
#include "core/input_file.h"
#include "import/drawn_lines.h"
#include "import/sample_checks.h"
#include "import/svg_geometry.h"
#include "import/text_parts.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

constexpr double units_per_mm = 40.0;

bool is_hpgl_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// Skips the rest of ESC.( or ESC.I81;;17: or ESC%0B or ESC E.
void skip_escape(std::string_view& rest) {
  if (rest.starts_with('.')) {
    rest.remove_prefix(std::min<std::size_t>(2, rest.size()));
    const std::size_t end = rest.find_first_not_of("; 0123456789");
    if (end != std::string_view::npos && rest[end] == ':') rest.remove_prefix(end + 1);
    return;
  }
  while (!rest.empty() && !is_hpgl_letter(rest[0])) rest.remove_prefix(1);
  rest.remove_prefix(std::min<std::size_t>(1, rest.size()));
}

/// The instructions of HPGL and HPGL/2, by which a plot is told from a table whose header begins with PU.
constexpr std::string_view hpgl_codes =
    "AA AC AD AF AH AP AR AS AT BL BP BR BZ CA CF CI CM CO CP CR CS CT DC DF DI DL DP DR DS DT DV EA EC EP "
    "ER "
    "ES EW FI FN FP FR FS FT GC GM IM IN IP IR IV IW KY LA LB LM LO LT MC MG MT NP NR OA OC OD OE OF OG OH "
    "OI "
    "OK OL OO OP OS OT OW PA PB PC PD PE PG PM PP PR PS PT PU PW QL RA RF RO RP RQ RR RT SA SB SC SD SI SL "
    "SM "
    "SO SP SR SS ST SV TD TL TR UC UF UL VA VN VS WD WG WU";

bool is_hpgl_code(std::string_view code) {
  for (std::size_t at = 0; at < hpgl_codes.size(); at += 3)
    if (hpgl_codes.substr(at, 2) == code) return true;
  return false;
}

/// True if the first line is instructions with their numbers. An instruction without numbers ends at ;, at
/// the next one, or at the line's end, if no row of numbers follows.
bool begins_with_instructions(std::string_view text) {
  constexpr std::string_view digits = "0123456789", between = " \t\r;";
  const std::string_view line = cut_before(text, '\n');
  bool has_numbers = true;
  for (std::string_view rest = line;;) {
    rest.remove_prefix(std::min(rest.find_first_not_of(between), rest.size()));
    if (rest.size() < 2) break;
    if (rest[0] == '\x1B') {
      rest.remove_prefix(1);
      skip_escape(rest);
      continue;
    }
    const std::string_view code = rest.substr(0, 2);
    if (!is_hpgl_code(code)) return false;
    for (const char* with_text : {"LB", "DT", "PE", "CO", "BP"})
      if (code == with_text) return true;
    rest.remove_prefix(2);
    const std::string_view numbers = rest.substr(0, rest.find_first_not_of(" \t\r,.+-0123456789"));
    rest.remove_prefix(numbers.size());
    has_numbers = numbers.find_first_of(digits) != std::string_view::npos;
    const bool ends = numbers.empty() || rest.empty() || rest[0] == ';';
    if (!has_numbers && (!ends || numbers.find(',') != std::string_view::npos)) return false;
    if (has_numbers && numbers.find(',') < numbers.find_first_of(digits)) return false;
  }
  const std::string_view next = cut_line(text);
  return has_numbers || next.empty() || digits.find(next[0]) == std::string_view::npos;
}

class HpglReader {
 public:
  HpglReader(std::string_view text, const std::string& name)
      : whole_(text), rest_(text), name_(name), lines_(name) {
    to_mm_ = Eigen::Scaling(1.0 / units_per_mm);
  }

  SampleTable table() {
    while (skip_to_instruction()) {
      std::string code;
      for (const char c : rest_.substr(0, 2))
        code += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      begin_ = rest_.data() - whole_.data();
      rest_.remove_prefix(std::min<std::size_t>(2, rest_.size()));
      follow(code);
    }
    SampleTable table = lines_.table("HPGL");
    table.description += ", 40 units per mm";
    std::vector<std::string> kinds;
    for (const auto& [kind, count] : not_drawn_) kinds.push_back(fmt::format("{} {}", count, kind));
    if (!kinds.empty())
      table.warnings.push_back(
          fmt::format("{}: {} not drawn; plot text and areas as lines", name_, fmt::join(kinds, ", ")));
    return table;
  }

 private:
  [[noreturn]] void complain(const std::string& what) const {
    const auto line = 1 + std::count(whole_.begin(), whole_.begin() + begin_, '\n');
    throw_input_error("{}:{}: {}", name_, line, what);
  }

  /// Skips what is between instructions, with the quoted texts of CO and BP. False at the end.
  bool skip_to_instruction() {
    while (!rest_.empty() && !is_hpgl_letter(rest_[0])) {
      const char skipped = rest_[0];
      begin_ = rest_.data() - whole_.data();
      rest_.remove_prefix(1);
      if (skipped == '\x1B') skip_escape(rest_);
      if (skipped != '"') continue;
      if (rest_.find('"') == std::string_view::npos) complain("a quoted text has no end; close it with \"");
      cut_before(rest_, '"');
    }
    return !rest_.empty();
  }

  std::vector<double> numbers() {
    std::vector<double> result;
    const std::string_view text = rest_.substr(0, rest_.find(';'));
    SvgNumbers list(text);
    while (const std::optional<double> number = list.cut()) result.push_back(*number);
    rest_.remove_prefix(text.size() - list.rest().size());
    return result;
  }

  void follow(const std::string& code) {
    if (code == "LB" || code == "BL" || code == "DT") return skip_label(code);
    if (code == "PE") complain("PE holds encoded lines, which are not read; plot with PD instead");
    const std::vector<double> n = numbers();
    const std::string not_read = reason_not_read(code, n);
    if (!not_read.empty()) complain(fmt::format("{} {}", code, not_read));
    if (code == "IN" || code == "DF") {
      relative_ = down_ = false;
    } else if (code == "PA" || code == "PR") {
      relative_ = code == "PR";
      move(n);
    } else if (code == "PU" || code == "PD") {
      down_ = code == "PD";
      if (down_ && n.empty()) lines_.line_to(lines_.at());
      move(n);
    } else if (code == "AA" || code == "AR") {
      need(n, 3, code);
      const Vector2d centre = Vector2d(n[0], n[1]) + (code == "AR" ? at_ : Vector2d(0.0, 0.0));
      arc(centre, n[2] * pi / 180.0, down_);
    } else if (code == "CI") {
      need(n, 1, code);
      const Vector2d centre = at_;
      jump(centre + Vector2d(n[0], 0.0));
      arc(centre, 2.0 * pi, true);
      jump(centre);
    } else if (code == "EA" || code == "ER") {
      need(n, 2, code);
      const Vector2d a = at_, b = Vector2d(n[0], n[1]) + (code == "ER" ? at_ : Vector2d(0.0, 0.0));
      lines_.move_to(to_mm_ * a);
      for (const Vector2d& corner : {Vector2d(b.x(), a.y()), b, Vector2d(a.x(), b.y()), a})
        lines_.line_to(to_mm_ * corner);
    } else if (code == "RA" || code == "RR" || code == "WG") {
      ++not_drawn_["filled areas"];
    }
  }

  /// Why an instruction would change the path in a way that is not read; empty: it would not.
  static std::string reason_not_read(const std::string& code, const std::vector<double>& n) {
    if (code == "SC" && !n.empty())
      return "scales the plot, which is not read; plot in plotter units (1/40 mm)";
    if (code == "RO" && !n.empty() && n[0] != 0.0)
      return "turns the plot, which is not read; plot without it";
    if (code == "PM") return "begins a polygon, which is not read; plot its outline as lines";
    if (code == "EW" || code == "AT" || code == "RT" || code == "BZ" || code == "BR")
      return "is a curve that is not read; plot it as lines";
    return "";
  }

  void need(const std::vector<double>& n, std::size_t count, const std::string& code) const {
    if (n.size() < count) complain(fmt::format("{} needs {} numbers; correct or remove it", code, count));
  }

  /// A label goes on until ETX, or the character that DT names.
  void skip_label(const std::string& code) {
    if (code == "DT") {
      label_end_ = rest_.empty() || rest_[0] == ';' ? '\x03' : rest_[0];
      rest_.remove_prefix(std::min<std::size_t>(1, rest_.size()));
      return;
    }
    if (code == "LB") ++not_drawn_["labels"];
    cut_before(rest_, label_end_);
  }

  void jump(const Vector2d& point) {
    at_ = point;
    lines_.move_to(to_mm_ * at_);
  }

  void move(const std::vector<double>& n) {
    if (n.size() % 2 != 0) complain("a point has only one coordinate; correct or remove it");
    for (std::size_t i = 0; i + 1 < n.size(); i += 2) {
      const Vector2d point = Vector2d(n[i], n[i + 1]) + (relative_ ? at_ : Vector2d(0.0, 0.0));
      if (down_)
        lines_.line_to(to_mm_ * (at_ = point));
      else
        jump(point);
    }
    if (!down_) lines_.move_to(to_mm_ * at_);
  }

  void arc(const Vector2d& centre, double sweep, bool draws) {
    if (!(std::abs(sweep) <= 2.0 * pi * (1.0 + 1e-9)))
      complain("an arc has more than 360 degrees; correct it");
    const Vector2d from = at_ - centre, across(-from.y(), from.x());
    at_ = centre + elementary::cos(sweep) * from + elementary::sin(sweep) * across;
    if (draws)
      draw_ellipse_arc({centre, from, across, 0.0, sweep}, at_, to_mm_, lines_);
    else
      lines_.move_to(to_mm_ * at_);
  }

  std::string_view whole_, rest_;
  const std::string& name_;
  DrawnLines lines_;
  Eigen::Affine2d to_mm_;
  std::ptrdiff_t begin_ = 0;  // of the instruction
  bool down_ = false, relative_ = false;
  char label_end_ = '\x03';
  Vector2d at_ = Vector2d::Zero();  // plotter units
  std::map<std::string, std::size_t> not_drawn_;
};

}  // namespace

SampleTable parse_hpgl(std::string_view text, const std::string& name) {
  return finite_samples(HpglReader(without_byte_order_mark(text), name).table(), name);
}

SampleTable read_hpgl(const std::filesystem::path& path) {
  return parse_hpgl(read_text_file(path, most_sample_text_bytes), path.string());
}

bool looks_like_hpgl(std::string_view text) {
  bool begins = false;
  for (const char* begin : {"\x1B.", "\x1B%", "IN;", "DF;", "SP", "PU", "PA", "PD", "BP"})
    begins = begins || text.starts_with(begin);
  if (!begins || !begins_with_instructions(text)) return false;
  for (std::size_t at = text.find('P'); at != std::string_view::npos; at = text.find('P', at + 1)) {
    const std::string_view rest = text.substr(at);
    if ((rest.starts_with("PD") || rest.starts_with("PU")) && rest.size() > 2 &&
        std::string_view(" ;-0123456789").find(rest[2]) != std::string_view::npos)
      return true;
  }
  return false;
}

}  // namespace sandstroke
