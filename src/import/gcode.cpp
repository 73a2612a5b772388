#include "import/gcode.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/elementary.h"
#include "core/error.h"
#include "core/input_file.h"
#include "import/gcode_path.h"
#include "import/gcode_words.h"
#include "import/sample_checks.h"
#include "import/table_layout.h"
#include "import/text_parts.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

/// An arc in the plane. Z and the radius change evenly along it.
struct GcodeArc {
  Vector2d centre;
  double radius = 0.0, end_radius = 0.0;  // mm
  double start = 0.0, sweep = 0.0;        // rad, above 0 counterclockwise

  double chords() const {
    const double fraction = std::max(gcode_arc_fraction, gcode_arc_tolerance / std::max(radius, end_radius));
    const double step = 2.0 * elementary::acos(std::max(1.0 - fraction, 0.0));
    return std::ceil(std::abs(sweep) / step);
  }
  double length(double climb) const {
    return elementary::hypot(0.5 * (radius + end_radius) * sweep, end_radius - radius, climb);
  }
  Vector2d at(double fraction) const {
    const double angle = start + fraction * sweep;
    return centre +
           std::lerp(radius, end_radius, fraction) * Vector2d(elementary::cos(angle), elementary::sin(angle));
  }
};

class GcodeReader {
 public:
  GcodeReader(const std::string& name, const std::string& pen_up)
      : name_(name), pen_up_text_(pen_up), pen_up_(gcode_words(pen_up, "pen_up")) {
    if (!pen_up.empty() && pen_up_.m.size() != 1)
      throw_input_error(
          "pen_up = \"{}\" is not a G-code word that lifts a pen; give a word such as \"M280 S90\"", pen_up);
  }

  void take_line(std::string_view text, std::size_t number) {
    line_ = number;
    const GcodeWords words = gcode_words(text, location());
    take_speed(words);
    bool moves = true;
    for (const int code : words.g) moves = take_g(code, words) && moves;
    take_m(words);
    if (!moves || !words.has_any_of("XYZIJR")) return;
    if (motion_ >= 2) {
      arc(words);
    } else if (words.has_any_of("XYZ")) {
      const Vector3d end = target(words);
      if (!path_.samples.empty() || words.has_any_of("XY")) add(end, (end - position_).norm());
      position_ = end;
    }
  }

  SampleTable table() const {
    if (pen_up_.m.empty() && servo_angles_.size() > 1)
      throw_input_error(
          "{}:{}: M{} moves a pen to S {}, but it is not known which of them lifts it; set {} to the one "
          "that lifts, such as \"M{} S{}\"",
          name_, servo_line_, servo_ / 10, fmt::join(servo_angles_, " and "), option_and_key("pen_up"),
          servo_ / 10, *servo_angles_.rbegin());
    SampleTable table = table_of_gcode(path_, name_);
    if (!pen_up_.m.empty() && !pen_lifts_)
      table.warnings.push_back(fmt::format("{}: no line has {}, so the pen never lifts; correct {}", name_,
                                           pen_up_text_, option_and_key("pen_up")));
    return table;
  }

 private:
  std::string location() const { return fmt::format("{}:{}", name_, line_); }

  /// True if the line's other words still belong to a motion.
  bool take_g(int code, const GcodeWords& words) {
    switch (code) {
      case 0:
      case 10:
      case 20:
      case 30:
        motion_ = code / 10;
        return true;
      case 170:
      case 180:
      case 190:
        plane_ = code / 10;
        return true;
      case 200:
      case 210:
        scale_ = code == 200 ? 25.4 : 1.0;
        return true;
      case 900:
      case 910:
        relative_ = code == 910;
        return true;
      case 901:
      case 911:
        centre_relative_ = code == 911;
        return true;
      case 920:
        for (int axis = 0; axis < 3; ++axis)
          if (const auto& value = words["XYZ"[axis]]) origin_[axis] = position_[axis] - *value * scale_;
        return false;
      case 921:
        origin_.setZero();
        return false;
      case 40:
      case 100:
      case 280:
      case 281:
      case 300:
      case 301:  // the tool waits, or goes where only the machine knows
        path_.passed_over.insert(code);
        return false;
      case 400:
      case 430:
      case 490:
      case 540:
      case 610:
      case 640:
      case 800:
      case 940:
        return true;
      default:
        throw_input_error("{}: G{:g} is not supported; write the path with G0 to G3", location(),
                          code / 10.0);
    }
  }

  void take_speed(const GcodeWords& words) {
    for (const int code : words.g)
      if (code == 200 || code == 210) take_g(code, words);  // applies to its whole line
    if (const auto& feed = words['F']) {
      if (!(*feed > 0.0)) throw_input_error("{}: speed F{} is not above 0; correct it", location(), *feed);
      feed_ = *feed * scale_ / 60.0;
    }
  }

  void take_m(const GcodeWords& words) {
    const bool of_spindle = std::all_of(words.m.begin(), words.m.end(),
                                        [](int code) { return code == 30 || code == 40 || code == 50; });
    const auto& power = words['S'];
    if (power && of_spindle && !std::count(words.g.begin(), words.g.end(), 40)) power_ = *power;
    for (const int code : words.m) {
      take_servo(code, words);
      if (code == 30 || code == 40) {
        spindle_ = true;
        path_.pen_word = gcode_spindle;
      }
      if (code == 50) spindle_ = false;
    }
  }
  void take_servo(int code, const GcodeWords& words) {
    if (!pen_up_.m.empty()) {
      if (code != pen_up_.m.front()) return;
      bool is_up = true;
      for (std::size_t i = 0; i < words.value.size(); ++i)
        is_up = is_up && (!pen_up_.value[i] || words.value[i] == pen_up_.value[i]);
      spindle_ = !is_up;
      path_.pen_word = pen_up_text_;
      pen_lifts_ = pen_lifts_ || is_up;
      return;
    }
    constexpr double most_angle = 180.0;  // M300 with more is a tone
    if ((code != 2800 && code != 3000) || !words['S'] || *words['S'] > most_angle) return;
    if (servo_angles_.empty()) {
      servo_ = code;
      servo_line_ = line_;
    }
    if (code == servo_) servo_angles_.insert(*words['S']);
  }
  bool pen_down() const { return spindle_ && power_ != 0.0; }

  /// The end point of a motion.
  Vector3d target(const GcodeWords& words) const {
    Vector3d end = position_;
    for (int axis = 0; axis < 3; ++axis)
      if (const auto& value = words["XYZ"[axis]])
        end[axis] = *value * scale_ + (relative_ ? position_ : origin_)[axis];
    if (end.cwiseAbs().maxCoeff() <= most) return end;
    throw_input_error("{}: the move ends more than {:g} mm away; correct it", location(), most);
  }

  void arc(const GcodeWords& words) {
    if (plane_ != 17)
      throw_input_error("{}: the arc is not in the plane of X and Y (G17); write lines instead", location());
    if (words['P'] && *words['P'] != 1.0)
      throw_input_error("{}: the arc has several turns (P); write one line for each turn", location());
    const Vector3d begin = position_, end = target(words);
    GcodeArc curve;
    curve.centre =
        words['R'] ? centre_by_radius(end.head<2>(), *words['R'] * scale_) : centre_by_offset(words);
    const Vector2d from = begin.head<2>() - curve.centre, to = end.head<2>() - curve.centre;
    curve.radius = from.norm();
    curve.end_radius = to.norm();
    if (!(curve.radius >= 1e-6 && curve.radius <= most))
      throw_input_error("{}: the arc's radius is {:g} mm; correct I and J, or R", location(), curve.radius);
    const double off = std::abs(curve.radius - curve.end_radius);
    if (!(off <= 0.5 && off <= std::max(0.005, 0.001 * curve.radius))) {  // the limits of Grbl and LinuxCNC
      throw_input_error(
          "{}: the arc begins {:g} mm from its centre and ends {:g} mm from it; correct X, Y, I or J",
          location(), curve.radius, curve.end_radius);
    }
    curve.start = elementary::atan2(from.y(), from.x());
    curve.sweep = elementary::atan2(to.y(), to.x()) - curve.start;
    constexpr double nothing = 5e-7;  // rad; a smaller sweep means a whole turn
    if (motion_ == 3 && curve.sweep <= nothing) curve.sweep += 2.0 * pi;
    if (motion_ == 2 && curve.sweep >= -nothing) curve.sweep -= 2.0 * pi;
    const double count = curve.chords(), climb = end.z() - begin.z();
    check_curve_points(count, path_.samples.size(), name_, line_);
    if (path_.samples.empty()) add(begin, 0.0);
    for (double k = 1.0; k <= count; ++k) {
      Vector3d point = end;
      if (k < count) point << curve.at(k / count), begin.z() + climb * k / count;
      add(point, curve.length(climb) / count);
    }
    position_ = end;
  }

  Vector2d centre_by_offset(const GcodeWords& words) const {
    Vector2d centre = position_.head<2>();
    for (int axis = 0; axis < 2; ++axis)
      if (const auto& value = words["IJ"[axis]])
        centre[axis] = *value * scale_ + (centre_relative_ ? position_ : origin_)[axis];
    return centre;
  }

  /// radius > 0 means the shorter of the two arcs.
  Vector2d centre_by_radius(const Vector2d& end, double radius) const {
    const Vector2d way = end - position_.head<2>();
    const double half = 0.5 * way.norm();
    if (half == 0.0) throw_input_error("{}: the arc with R ends where it begins; give I and J", location());
    if (half > std::abs(radius) * (1.0 + 1e-4) + 0.005)
      throw_input_error("{}: R is {:g} mm, too small for an arc between points {:g} mm apart; correct it",
                        location(), std::abs(radius), 2.0 * half);
    const double height = std::sqrt(std::max(radius * radius - half * half, 0.0));
    const Vector2d left = Vector2d(-way.y(), way.x()) / (2.0 * half);
    const bool centre_left = (motion_ == 3) == (radius > 0.0);
    return position_.head<2>() + 0.5 * way + (centre_left ? height : -height) * left;
  }

  void add(const Vector3d& point, double length) {
    constexpr double least = 1e-6;  // mm; a shorter move takes no time that shows in a sample
    if (!path_.samples.empty() && length < least) return;
    if (path_.samples.empty() && relative_ && motion_ < 2 && length > 0.0) keep(position_, 0.0);
    keep(point, path_.samples.empty() ? 0.0 : length);
  }
  void keep(const Vector3d& point, double length) {
    const bool down = pen_down() && motion_ != 0;
    bool along_xy = false, along_z = false;
    if (!path_.samples.empty()) {
      GcodeSample& last = path_.samples.back();
      along_xy = point.head<2>() != last.position.head<2>();
      along_z = point.z() != last.position.z();
      last.lifts = !down;
      last.down = last.down || down;
    }
    path_.draws_rapidly = path_.draws_rapidly || (motion_ == 0 && along_xy);
    path_.samples.push_back({point, line_, length, feed_, down, false, along_xy, along_z});
  }

  static constexpr double most = 1e12;  // mm
  const std::string& name_;
  const std::string pen_up_text_;
  const GcodeWords pen_up_;  // empty: not named
  int servo_ = 0;            // the M word that moves a pen
  std::size_t servo_line_ = 0;
  std::set<double> servo_angles_;
  bool pen_lifts_ = false;  // a line had the words of pen_up_
  std::size_t line_ = 0;
  int motion_ = 0, plane_ = 17;
  double scale_ = 1.0;  // mm
  bool relative_ = false, centre_relative_ = true;
  bool spindle_ = false;
  double power_ = 1.0, feed_ = 0.0;
  Vector3d position_ = Vector3d::Zero(), origin_ = Vector3d::Zero();  // mm
  GcodePath path_;
};

}  // namespace

SampleTable parse_gcode(std::string_view text, const std::string& name, const std::string& pen_up) {
  text = without_byte_order_mark(text);
  GcodeReader reader(name, pen_up);
  for (std::size_t number = 1; !text.empty(); ++number) reader.take_line(cut_line(text), number);
  return finite_samples(reader.table(), name);
}

SampleTable read_gcode(const std::filesystem::path& path, const std::string& pen_up) {
  return parse_gcode(read_text_file(path, most_sample_text_bytes), path.string(), pen_up);
}

}  // namespace sandstroke
