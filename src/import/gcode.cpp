#include "import/gcode.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/input_file.h"
#include "import/gcode_arc.h"
#include "import/gcode_bounds.h"
#include "import/gcode_codes.h"
#include "import/gcode_path.h"
#include "import/gcode_pen.h"
#include "import/gcode_program.h"
#include "import/sample_checks.h"
#include "import/text_parts.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

class GcodeReader {
 public:
  GcodeReader(const std::string& name, const std::string& pen_up, const std::string& pen_down)
      : name_(name), pen_(pen_up, pen_down), program_(name) {}

  void take_line(std::string_view text, std::size_t number) {
    line_ = number;
    bounds_.take(text);
    const std::optional<GcodeWords> words = program_.words_to_follow(text, number);
    if (!words) return;
    take_speed(*words);
    bool moves = true;
    for (const int code : words->g) moves = take_g(code, *words) && moves;
    pen_.take(*words, number);
    if (words->own != GcodeWords::Values{}) pass_over_axes_of(*words);
    if (moves && words->has_any_of("ABCUVW")) program_.pass_over_rotary_axes(number);
    if (!moves || !words->has_any_of("XYZIJR")) return;
    if (words->has_any_of("Z")) height_known_ = true;
    if (motion_ >= 2) {
      arc(*words);
    } else if (words->has_any_of("XYZ")) {
      const Vector3d end = target(*words);
      if (!path_.samples.empty() || words->has_any_of("XY")) add(end, (end - position_).norm());
      position_ = end;
    }
  }

  SampleTable table() {
    const bool z_may_lift = z_may_lift_a_pen(path_.samples);
    pen_.check_known(name_, z_may_lift);
    path_.pen_word = pen_.word();
    path_.pen_is_named = pen_.is_named();
    SampleTable table = table_of_gcode(path_, name_);
    for (const auto& warnings : {pen_.warnings(name_, z_may_lift), program_.warnings()})
      table.warnings.insert(table.warnings.end(), warnings.begin(), warnings.end());
    Eigen::AlignedBox3d all;
    for (const GcodeSample& sample : path_.samples) all.extend(sample.position);
    if (const auto sentence = bounds_.disagreement(box_of_gcode(table), all, scale_, name_))
      table.warnings.push_back(*sentence);
    return table;
  }

 private:
  std::string location() const { return fmt::format("{}:{}", name_, line_); }

  /// True if the line's other words still belong to a motion.
  bool take_g(int code, const GcodeWords& words) {
    switch (role_of_g(code, words, !path_.samples.empty(), location())) {
      case GcodeRole::read:
        return read_g(code, words);
      case GcodeRole::keeps_path:
        return true;
      case GcodeRole::goes_home:
        go_home(code, words);
        break;
      case GcodeRole::calls:
        program_.note_call(gcode_word_text('G', code), line_);
        break;
      case GcodeRole::waits:
        break;
    }
    path_.passed_over.insert({'G', code});
    return false;
  }

  bool read_g(int code, const GcodeWords& words) {
    if (code <= 30) {
      motion_ = code / 10;
    } else if (code <= 190) {
      plane_ = code / 10;
    } else if (code <= 210) {
      scale_ = code == 200 ? 25.4 : 1.0;
    } else if (code < 600) {
      choose_coordinates(code);
    } else if (code == 900 || code == 910) {
      relative_ = code == 910;
    } else if (code == 901 || code == 911) {
      centre_relative_ = code == 911;
    } else if (code == 920) {
      for (int axis = 0; axis < 3; ++axis)
        if (const auto& value = words["XYZ"[axis]]) origin_[axis] = position_[axis] - *value * scale_;
      return false;
    } else {
      origin_.setZero();
      return false;
    }
    return true;
  }

  /// G54 to G59.3: only the machine knows how far apart these coordinates are.
  void choose_coordinates(int code) {
    if (coordinates_ != code && !path_.samples.empty())
      throw_input_error(
          "{}: {} changes to coordinates whose distance from the earlier ones is not in the file; split the "
          "file before this line",
          location(), gcode_word_text('G', code));
    coordinates_ = code;
  }

  void go_home(int code, const GcodeWords& words) {
    const auto is_named = [&](char letter) {
      return words[letter].has_value() || words.axes.find(letter) != std::string::npos;
    };
    const bool cuts =
        words.has_g(10) || words.has_g(20) || words.has_g(30) || (motion_ > 0 && !words.has_g(0));
    if (code == 530 && cuts && words.has_any_of("XY")) program_.pass_over_machine_move(line_);
    const bool all = code != 530 && !is_named('X') && !is_named('Y') && !is_named('Z');
    if (path_.samples.empty()) return;  // where the path begins is not known either
    for (int axis = 0; axis < 3; ++axis) {
      if (!all && !is_named("XYZ"[axis])) continue;
      position_[axis] = 0.0;
      height_known_ = height_known_ && axis != 2;
      goes_home_ = true;
    }
    if (goes_home_) path_.homes.insert(line_);
  }

  void take_speed(const GcodeWords& words) {
    for (const int code : words.g)
      if (code == 200 || code == 210) take_g(code, words);  // applies to its whole line
    const bool waits = words.has_g(40);                     // F is then a time
    if (const auto& feed = words['F']; feed && !waits) {
      if (!(*feed > 0.0)) throw_input_error("{}: speed F{} is not above 0; correct it", location(), *feed);
      feed_ = *feed * scale_ / 60.0;
    }
  }

  void pass_over_axes_of(const GcodeWords& words) {
    const auto has = [&](char letter) { return GcodeWords::of(words.own, letter).has_value(); };
    if (has('X') || has('Y') || has('Z')) path_.passed_over.insert({'M', words.m.back()});
  }

  /// The end point of a motion.
  Vector3d target(const GcodeWords& words) const {
    Vector3d end = position_;
    for (int axis = 0; axis < 3; ++axis)
      if (const auto& value = words["XYZ"[axis]])
        end[axis] = *value * scale_ + (relative_ ? position_ : origin_)[axis];
    if (end.cwiseAbs().maxCoeff() <= gcode_farthest) return end;
    throw_input_error("{}: the move ends more than {:g} mm away; correct it", location(), gcode_farthest);
  }

  void arc(const GcodeWords& words) {
    if (plane_ != 17)
      throw_input_error("{}: the arc is not in the plane of X and Y (G17); write lines instead", location());
    if (words['P'] && *words['P'] != 1.0)
      throw_input_error("{}: the arc has several turns (P); write one line for each turn", location());
    const Vector3d begin = position_, end = target(words);
    const bool clockwise = motion_ == 2;
    const Vector2d from = begin.head<2>(), to = end.head<2>();
    const Vector2d centre = words['R']
                                ? centre_by_radius(from, to, *words['R'] * scale_, clockwise, location())
                                : centre_by_offset(words);
    const GcodeArc curve = arc_between(from, to, centre, clockwise, location());
    const double count = curve.chords(), climb = end.z() - begin.z();
    check_curve_points(count, path_.samples.size(), name_, line_);
    if (path_.samples.empty() || goes_home_) add(begin, 0.0);
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

  /// Adds the end of a move of that length. The first move, and the first one from home, come from a place
  /// that is not known: the path begins, or goes on, where they end.
  void add(const Vector3d& point, double length) {
    const bool begins = path_.samples.empty() || goes_home_;
    if (begins && relative_ && motion_ < 2 && length > 0.0) place(position_, 0.0);
    place(point, length);
  }

  /// Keeps a point, unless the tool is there already: then it only tells the height.
  void place(const Vector3d& point, double length) {
    constexpr double least = 1e-6;  // mm; a shorter move takes no time that shows in a sample
    if (path_.samples.empty()) return keep(point, 0.0);
    GcodeSample& last = path_.samples.back();
    if (goes_home_) length = (point - last.position).norm();
    if (length >= least) return keep(point, length);
    last.height_known = last.height_known || height_known_;
    goes_home_ = false;
  }

  void keep(const Vector3d& point, double length) {
    const bool down = pen_.down(motion_) && !goes_home_;
    bool along_xy = false, along_z = false;
    if (!path_.samples.empty()) {
      GcodeSample& last = path_.samples.back();
      along_xy = !goes_home_ && point.head<2>() != last.position.head<2>();
      along_z = !goes_home_ && point.z() != last.position.z() &&
                (last.height_known || !along_xy);  // no slope is known
      last.lifts = !down;
      last.down = last.down || down;
    }
    if (along_xy) pen_.note_move(motion_);
    path_.moves_rapidly = path_.moves_rapidly || (motion_ == 0 && along_xy);
    path_.draws_rapidly = path_.draws_rapidly || (motion_ == 0 && along_xy && down);
    path_.samples.push_back(
        {point, line_, length, feed_, down, false, along_xy, along_z, goes_home_, height_known_});
    goes_home_ = false;
  }

  const std::string& name_;
  GcodePen pen_;
  GcodeProgram program_;
  GcodeBounds bounds_;
  std::size_t line_ = 0;
  int motion_ = 0, plane_ = 17, coordinates_ = 540;
  double scale_ = 1.0;  // mm
  bool relative_ = false, centre_relative_ = true;
  bool goes_home_ = false;    // before the next move
  bool height_known_ = true;  // no home has changed Z since it was given
  double feed_ = 0.0;
  Vector3d position_ = Vector3d::Zero(), origin_ = Vector3d::Zero();  // mm
  GcodePath path_;
};

}  // namespace

SampleTable parse_gcode(std::string_view text, const std::string& name, const std::string& pen_up,
                        const std::string& pen_down) {
  text = without_byte_order_mark(text);
  GcodeReader reader(name, pen_up, pen_down);
  for (std::size_t number = 1; !text.empty(); ++number) reader.take_line(cut_line(text), number);
  return finite_samples(reader.table(), name);
}

SampleTable read_gcode(const std::filesystem::path& path, const std::string& pen_up,
                       const std::string& pen_down) {
  return parse_gcode(read_text_file(path, most_sample_text_bytes), path.string(), pen_up, pen_down);
}

}  // namespace sandstroke
