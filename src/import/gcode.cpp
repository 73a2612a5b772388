#include "import/gcode.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/error.h"
#include "core/input_file.h"
#include "import/curve_points.h"
#include "import/finite_samples.h"
#include "import/gcode_words.h"
#include "import/text_parts.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

/// An arc in the plane, of which z and the radius change evenly.
struct GcodeArc {
  Vector2d centre;
  double radius = 0.0, end_radius = 0.0;  // mm
  double start = 0.0, sweep = 0.0;        // rad, above 0 counterclockwise

  double chords() const {
    const double share = std::max(gcode_arc_share, gcode_arc_tolerance / std::max(radius, end_radius));
    const double step = 2.0 * std::acos(std::max(1.0 - share, 0.0));
    return std::ceil(std::abs(sweep) / step);
  }
  double length(double climb) const {
    return std::hypot(0.5 * (radius + end_radius) * sweep, end_radius - radius, climb);
  }
  Vector2d at(double share) const {
    const double angle = start + share * sweep;
    return centre + std::lerp(radius, end_radius, share) * Vector2d(std::cos(angle), std::sin(angle));
  }
};

struct GcodeSample {
  Vector3d position;
  std::size_t line;
  double length, feed;     // of the way here: mm, mm/s; 0 where no speed was said
  bool down, lifts;        // as M words have it
  bool along_xy, along_z;  // the way here
};

class GcodeReader {
 public:
  explicit GcodeReader(const std::string& name) : name_(name) {}

  void take_line(std::string_view text, std::size_t number) {
    line_ = number;
    const GcodeWords words = gcode_words(text, place());
    take_speed(words);
    bool moves = true;
    for (const int code : words.g) moves = take_g(code, words) && moves;
    take_m(words);
    if (!moves || !words.has_any_of("XYZIJR")) return;
    if (motion_ >= 2) {
      arc(words);
    } else if (words.has_any_of("XYZ")) {
      const Vector3d end = target(words);
      if (!samples_.empty() || words.has_any_of("XY")) add(end, (end - position_).norm());
      position_ = end;
    }
  }

  SampleTable table();

 private:
  std::string place() const { return fmt::format("{}:{}", name_, line_); }

  /// Whether the line's words still are those of a motion.
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
        passed_over_.insert(code);
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
        throw_input_error("{}: G{:g} is not read; write the path as G0 to G3", place(), code / 10.0);
    }
  }

  void take_speed(const GcodeWords& words) {
    for (const int code : words.g)
      if (code == 200 || code == 210) take_g(code, words);  // in force in its whole line
    if (const auto& feed = words['F']) {
      if (!(*feed > 0.0)) throw_input_error("{}: speed F{} is not above 0; correct it", place(), *feed);
      feed_ = *feed * scale_ / 60.0;
    }
  }

  void take_m(const GcodeWords& words) {
    if (const auto& power = words['S']; power && !std::count(words.g.begin(), words.g.end(), 40))
      power_ = *power;
    for (const int code : words.m) {
      if (code == 30 || code == 40) spindle_ = has_spindle_ = true;
      if (code == 50) spindle_ = false;
    }
  }
  bool pen_down() const { return spindle_ && power_ != 0.0; }

  /// Where a motion's words lead.
  Vector3d target(const GcodeWords& words) const {
    Vector3d end = position_;
    for (int axis = 0; axis < 3; ++axis)
      if (const auto& value = words["XYZ"[axis]])
        end[axis] = *value * scale_ + (relative_ ? position_ : origin_)[axis];
    if (end.cwiseAbs().maxCoeff() <= most) return end;
    throw_input_error("{}: the move ends more than {:g} mm away; correct it", place(), most);
  }

  void arc(const GcodeWords& words) {
    if (plane_ != 17)
      throw_input_error("{}: an arc that is not in the plane of X and Y (G17); write lines", place());
    if (words['P'] && *words['P'] != 1.0)
      throw_input_error("{}: an arc of several turns (P); write each turn in a line of its own", place());
    const Vector3d begin = position_, end = target(words);
    GcodeArc path;
    path.centre =
        words['R'] ? centre_by_radius(end.head<2>(), *words['R'] * scale_) : centre_by_offset(words);
    const Vector2d from = begin.head<2>() - path.centre, to = end.head<2>() - path.centre;
    path.radius = from.norm();
    path.end_radius = to.norm();
    if (!(path.radius >= 1e-6 && path.radius <= most))
      throw_input_error("{}: the arc's radius is {:g} mm; correct I and J, or R", place(), path.radius);
    const double off = std::abs(path.radius - path.end_radius);
    if (!(off <= 0.5 && off <= std::max(0.005, 0.001 * path.radius))) {  // as Grbl and LinuxCNC have it
      throw_input_error(
          "{}: the arc begins {:g} mm from its centre and ends {:g} mm from it; correct X, Y, I or J",
          place(), path.radius, path.end_radius);
    }
    path.start = std::atan2(from.y(), from.x());
    path.sweep = std::atan2(to.y(), to.x()) - path.start;
    constexpr double nothing = 5e-7;  // rad: a whole turn
    if (motion_ == 3 && path.sweep <= nothing) path.sweep += 2.0 * pi;
    if (motion_ == 2 && path.sweep >= -nothing) path.sweep -= 2.0 * pi;
    const double count = path.chords(), climb = end.z() - begin.z();
    check_curve_points(count, samples_.size(), name_, line_);
    if (samples_.empty()) add(begin, 0.0);
    for (double k = 1.0; k <= count; ++k) {
      Vector3d point = end;
      if (k < count) point << path.at(k / count), begin.z() + climb * k / count;
      add(point, path.length(climb) / count);
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

  /// R above 0 is the shorter of the two arcs.
  Vector2d centre_by_radius(const Vector2d& end, double radius) const {
    const Vector2d way = end - position_.head<2>();
    const double half = 0.5 * way.norm();
    if (half == 0.0) throw_input_error("{}: an arc by R ends where it begins; give I and J", place());
    if (half > std::abs(radius) * (1.0 + 1e-4) + 0.005)
      throw_input_error("{}: R is {:g} mm, too short for an arc over {:g} mm; correct it", place(),
                        std::abs(radius), 2.0 * half);
    const double height = std::sqrt(std::max(radius * radius - half * half, 0.0));
    const Vector2d left = Vector2d(-way.y(), way.x()) / (2.0 * half);
    const bool centre_left = (motion_ == 3) == (radius > 0.0);
    return position_.head<2>() + 0.5 * way + (centre_left ? height : -height) * left;
  }

  void add(const Vector3d& point, double length) {
    constexpr double least = 1e-6;  // mm: a shorter move takes no time that a sample could tell
    if (!samples_.empty() && length < least) return;
    if (samples_.empty() && relative_ && motion_ < 2 && length > 0.0) keep(position_, 0.0);
    keep(point, samples_.empty() ? 0.0 : length);
  }
  void keep(const Vector3d& point, double length) {
    const bool down = pen_down() && motion_ != 0;
    bool along_xy = false, along_z = false;
    if (!samples_.empty()) {
      GcodeSample& last = samples_.back();
      along_xy = point.head<2>() != last.position.head<2>();
      along_z = point.z() != last.position.z();
      last.lifts = !down;
      last.down = last.down || down;
    }
    samples_.push_back({point, line_, length, feed_, down, false, along_xy, along_z});
  }

  bool z_lifts_a_pen() const;
  std::vector<bool> pen_is_down(bool by_z) const;
  std::vector<double> times() const;

  static constexpr double most = 1e12;  // mm
  const std::string& name_;
  std::size_t line_ = 0;
  int motion_ = 0, plane_ = 17;
  double scale_ = 1.0;  // mm
  bool relative_ = false, centre_relative_ = true;
  bool has_spindle_ = false, spindle_ = false;
  double power_ = 1.0, feed_ = 0.0;
  Vector3d position_ = Vector3d::Zero(), origin_ = Vector3d::Zero();  // mm
  std::vector<GcodeSample> samples_;
  std::set<int> passed_over_;
};

/// Z moves, and never while X or Y do.
bool GcodeReader::z_lifts_a_pen() const {
  bool moves = false;
  for (const GcodeSample& sample : samples_) {
    if (sample.along_z && sample.along_xy) return false;
    moves = moves || sample.along_z;
  }
  return moves;
}

std::vector<bool> GcodeReader::pen_is_down(bool by_z) const {
  double lowest = std::numeric_limits<double>::infinity();  // that anything is drawn at
  for (const GcodeSample& sample : samples_)
    if (sample.along_xy) lowest = std::min(lowest, sample.position.z());
  std::vector<bool> down;
  for (const GcodeSample& sample : samples_)
    down.push_back((!has_spindle_ || sample.down) && (!by_z || sample.position.z() <= std::max(lowest, 0.0)));
  return down;
}

/// s. Empty where no speed is said; what comes before the first F goes as fast as what follows.
std::vector<double> GcodeReader::times() const {
  const auto said =
      std::find_if(samples_.begin(), samples_.end(), [](const auto& sample) { return sample.feed > 0.0; });
  std::vector<double> times;
  if (said == samples_.end()) return times;
  double time = 0.0;
  for (const GcodeSample& sample : samples_)
    times.push_back(time += sample.length / (sample.feed > 0.0 ? sample.feed : said->feed));
  return times;
}

SampleTable GcodeReader::table() {
  if (samples_.empty())
    throw_input_error("{}: has no moves (G0 to G3 with X, Y or Z); give a file with a path", name_);
  const bool by_z = z_lifts_a_pen();
  const bool has_z = by_z || std::any_of(samples_.begin(), samples_.end(),
                                         [](const auto& sample) { return sample.position.z() != 0.0; });
  const std::vector<bool> down = pen_is_down(by_z);
  const std::vector<double> time = times();

  SampleTable table;
  table.columns = {{"x", "mm", {}}, {"y", "mm", {}}};
  if (has_z) table.columns.push_back({"z", "mm", {}});
  if (!time.empty()) table.columns.push_back({"time", "s", {}});
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (!down[i]) continue;
    const Vector3d& at = samples_[i].position;
    table.columns[0].values.push_back(at.x());
    table.columns[1].values.push_back(at.y());
    if (has_z) table.columns[2].values.push_back(at.z());
    if (!time.empty()) table.columns.back().values.push_back(time[i]);
    table.lines.push_back(samples_[i].line);
    if (by_z || has_spindle_)
      table.lifts.push_back((has_spindle_ && samples_[i].lifts) || (i + 1 < down.size() && !down[i + 1]));
  }
  if (table.size() == 0)
    throw_input_error("{}: the pen is never down; let M3 (S above 0) or Z lower it before a move by G1",
                      name_);

  std::vector<std::string> passed;
  for (const int code : passed_over_) passed.push_back(fmt::format("G{:g}", code / 10.0));
  table.description =
      fmt::format("G-code: {} points{}{}{}", table.size(),
                  by_z    ? ", the pen is up where Z is high"
                  : has_z ? ", Z is a height"
                          : "",
                  has_spindle_ ? ", the pen is down after M3" : "",
                  passed.empty() ? "" : fmt::format(", {} passed over", fmt::join(passed, ", ")));
  return table;
}

}  // namespace

SampleTable parse_gcode(std::string_view text, const std::string& name) {
  text = without_byte_order_mark(text);
  GcodeReader reader(name);
  for (std::size_t number = 1; !text.empty(); ++number) reader.take_line(cut_line(text), number);
  return finite_samples(reader.table(), name);
}

SampleTable read_gcode(const std::filesystem::path& path) {
  return parse_gcode(read_text_file(path, most_sample_text_bytes), path.string());
}

}  // namespace sandstroke
