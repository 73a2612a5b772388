#include "haptics/stroke_script.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/angle.h"
#include "core/elementary.h"
#include "core/error.h"
#include "lettering/hershey_text.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;

constexpr double most_samples = 2e7;   // over five hours at 1000 Hz, 640 MB
constexpr int most_legs = 20'000'000;  // lines or arcs: seconds of work, however few samples they give
constexpr double same_point = 1e-9;    // m

constexpr double smooth_turn = 10.0;  // deg: at corners up to here the tool turns without a stop

/// A straight line, or an arc about `centre`.
struct Curve {
  Vector2d from, to;
  Vector2d centre = Vector2d::Zero();
  double radius = 0.0;                        // 0: straight
  double start_angle = 0.0, end_angle = 0.0;  // rad
  double length = 0.0;

  static Curve line(const Vector2d& from, const Vector2d& to) {
    Curve curve;
    curve.from = from;
    curve.to = to;
    curve.length = (to - from).norm();
    return curve;
  }
  static Curve arc(const Vector2d& centre, double radius, double start_angle, double end_angle) {
    Curve curve;
    curve.centre = centre;
    curve.radius = radius;
    curve.start_angle = start_angle;
    curve.end_angle = end_angle;
    curve.length = radius * std::abs(end_angle - start_angle);
    curve.from = curve.at(0.0);
    curve.to = curve.at(1.0);
    return curve;
  }
  /// fraction of the length, 0 to 1
  Vector2d at(double fraction) const {
    if (radius == 0.0) return from + fraction * (to - from);
    const double angle = start_angle + fraction * (end_angle - start_angle);
    return centre + radius * Vector2d(elementary::cos(angle), elementary::sin(angle));
  }
  /// deg from +x towards +y; on an arc it goes on counting.
  double heading(double fraction) const {
    const Vector2d way = to - from;
    if (radius == 0.0) return to_degrees(elementary::atan2(way.y(), way.x()));
    const double angle = start_angle + fraction * (end_angle - start_angle);
    return to_degrees(angle) + (end_angle > start_angle ? 90.0 : -90.0);
  }
};
using Path = std::vector<Curve>;

double length_of(const Path& path) {
  double length = 0.0;
  for (const Curve& curve : path) length += curve.length;
  return length;
}

/// Values at evenly spaced fractions of a path's length, linear in between; none: 0.
class Profile {
 public:
  explicit Profile(std::vector<double> values) : values_(std::move(values)) {
    if (values_.empty()) values_.push_back(0.0);
  }
  double highest() const { return *std::max_element(values_.begin(), values_.end()); }
  double at(double fraction) const {
    const std::size_t knots = values_.size();
    if (knots == 1) return values_.front();
    const double at = fraction * static_cast<double>(knots - 1);
    const std::size_t knot = std::min(static_cast<std::size_t>(at), knots - 2);
    return values_[knot] + (at - static_cast<double>(knot)) * (values_[knot + 1] - values_[knot]);
  }
  /// The fractions at which the profile bends.
  void add_knots(std::vector<double>& found) const {
    for (std::size_t i = 1; i + 1 < values_.size(); ++i)
      found.push_back(static_cast<double>(i) / static_cast<double>(values_.size() - 1));
  }

 private:
  std::vector<double> values_;
};

Profile height_profile(const PressProfile& press, const ForceSettings& force) {
  std::vector<double> heights;
  for (const double value : press.values)
    heights.push_back(press.kind == PressProfile::Kind::depth ? -value
                                                              : -depth_of_repulse_force(value, force));
  return Profile(std::move(heights));
}

/// The posture of a pen: a height [m], and angles [deg] as in ToolTurn.
struct Posture {
  double z, turn = 0.0, tilt = 0.0;
  Posture towards(const Posture& other, double fraction) const {
    return {z + fraction * (other.z - z), turn + fraction * (other.turn - turn),
            tilt + fraction * (other.tilt - tilt)};
  }
  Eigen::Vector4d quaternion() const {
    const double half_turn = 0.5 * to_radians(turn), half_tilt = 0.5 * to_radians(tilt);
    const double ct = elementary::cos(half_turn), st = elementary::sin(half_turn),
                 cl = elementary::cos(half_tilt), sl = elementary::sin(half_tilt);
    return {-st * sl, ct * sl, st * cl, ct * cl};
  }
};

/// The posture of a pen along a path.
class PostureProfile {
 public:
  PostureProfile(Profile height, const ToolTurn& turn)
      : height_(std::move(height)),
        turn_(turn.turn),
        tilt_(turn.tilt),
        along_path_(turn.heading == ToolTurn::Heading::path) {}

  /// The posture at a fraction of the path, which is the fraction `of_curve` of that curve.
  Posture at(double fraction, const Curve& curve, double of_curve) const {
    return {height_.at(fraction), turn_.at(fraction) + (along_path_ ? curve.heading(of_curve) : 0.0),
            tilt_.at(fraction)};
  }
  double highest() const { return height_.highest(); }
  std::vector<double> knots() const {
    std::vector<double> found;
    for (const Profile* profile : {&height_, &turn_, &tilt_}) profile->add_knots(found);
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  Profile height_, turn_, tilt_;
  bool along_path_;
};

bool turns_tool(const StrokeScript& script) {
  return std::any_of(script.segments.begin(), script.segments.end(),
                     [](const ScriptSegment& segment) { return segment.turn.turns(); });
}

/// Moves the pen leg by leg, and takes samples on the way.
class Pen {
 public:
  explicit Pen(const StrokeScript& script)
      : script_(script), turns_(turns_tool(script)), point_(script.start), posture_{script.clearance} {}

  const Vector2d& point() const { return point_; }

  void wait(double seconds) { add(Curve::line(point_, point_), 0.0, 1.0, posture_, seconds); }
  void lift() { climb_to(script_.clearance); }
  void travel(const Vector2d& to) {
    lift();
    run(Curve::line(point_, to), 0.0, 1.0, posture_, script_.travel_speed);
  }
  /// Goes to the path's first point, lifted if that is elsewhere, and draws the path.
  void draw(const Path& path, const PostureProfile& profile, double speed) {
    const Vector2d& first = path.front().from;
    if ((first - point_).norm() > same_point) travel(first);
    const Posture begin = profile.at(0.0, path.front(), 0.0);
    turn_to(begin);
    climb_to(begin.z);
    if (first != point_)
      run(Curve::line(point_, first), 0.0, 1.0, posture_, speed);  // rounding of an arc's end

    const double length = length_of(path);
    const std::vector<double> knots = profile.knots();
    auto knot = knots.begin();
    double drawn = 0.0;  // m of the path, up to the current curve
    for (const Curve& curve : path) {
      turn_to(profile.at(std::min(drawn / length, 1.0), curve, 0.0));
      double fraction = 0.0;  // of the curve
      for (; knot != knots.end() && *knot * length < drawn + curve.length; ++knot) {
        const double next = std::max(fraction, (*knot * length - drawn) / curve.length);
        run(curve, fraction, next, profile.at(*knot, curve, next), speed);
        fraction = next;
      }
      drawn += curve.length;
      run(curve, fraction, 1.0,
          profile.at(&curve == &path.back() ? 1.0 : std::min(drawn / length, 1.0), curve, 1.0), speed);
    }
  }

  /// Takes one more sample, at which the pen has come to rest, and returns the stroke.
  Stroke finish() {
    sample(point_, posture_);
    stroke_.nominal_rate = script_.rate;
    stroke_.source = "script " + script_.name;
    return std::move(stroke_);
  }

 private:
  void climb_to(double z) {
    run(Curve::line(point_, point_), 0.0, 1.0, {z, posture_.turn, posture_.tilt}, script_.plunge_speed);
  }
  /// Turns the tool where it stands, the shorter way round. A turn of up to smooth_turn takes no time.
  void turn_to(const Posture& posture) {
    if (!turns_) return;
    const double whole_turns = 360.0 * std::round((posture.turn - posture_.turn) / 360.0);
    posture_.turn += whole_turns;
    const double most =
        std::max(std::abs(posture.turn - posture_.turn), std::abs(posture.tilt - posture_.tilt));
    const Posture turned{posture_.z, posture.turn, posture.tilt};
    if (most > smooth_turn)
      add(Curve::line(point_, point_), 0.0, 1.0, turned, most / script_.turn_speed);
    else
      posture_ = turned;
  }
  /// Moves along a curve from one fraction to another, at constant speed in space, while the posture changes
  /// linearly.
  void run(const Curve& curve, double begin, double end, const Posture& after, double speed) {
    add(curve, begin, end, after,
        elementary::hypot((end - begin) * curve.length, after.z - posture_.z) / speed);
  }
  void add(const Curve& curve, double begin, double end, const Posture& after, double seconds) {
    if (++legs_ > most_legs)
      throw_input_error("it has more than {} short lines; lower repeat, or draw less", most_legs);
    const double end_time = time_ + seconds;
    if (!(end_time * script_.rate < most_samples)) {
      throw_input_error(
          "it ends after {} s, which is more than {} samples at rate = {} Hz; raise the speeds or lower rate",
          end_time, most_samples, script_.rate);
    }
    while (next_time() < end_time) {
      const double u = std::clamp((next_time() - time_) / seconds, 0.0, 1.0);
      sample(curve.at(begin + u * (end - begin)), posture_.towards(after, u));
    }
    time_ = end_time;
    posture_ = after;
    point_ = end == 1.0 ? curve.to : curve.at(end);
  }
  double next_time() const { return static_cast<double>(stroke_.size()) / script_.rate; }
  void sample(const Vector2d& point, const Posture& posture) {
    stroke_.time.push_back(next_time());
    stroke_.position.emplace_back(point.x(), point.y(), posture.z);
    if (turns_) stroke_.orientation.push_back(posture.quaternion());
  }

  const StrokeScript& script_;
  bool turns_;
  Vector2d point_;
  Posture posture_;
  double time_ = 0.0;
  int legs_ = 0;
  Stroke stroke_;
};

/// Centripetal Catmull-Rom (Barry & Goldman's pyramid): no loops and no overshoot between uneven points.
Path spline_path(const std::vector<Vector2d>& points) {
  const std::size_t count = points.size();
  double length = 0.0;  // m, about
  for (std::size_t i = 0; i + 1 < count; ++i) length += (points[i + 1] - points[i]).norm();
  if (!std::isfinite(length)) throw_input_error("its points lie infinitely far apart; move them closer");
  // The target length of a leg: the way of a tool at 0.1 m/s within a servo tick of 1 ms; more if there would
  // be millions of legs.
  const double fine = std::max(1e-4, 1e-6 * length);  // m
  Path path;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const Vector2d &p1 = points[i], &p2 = points[i + 1];
    const Vector2d p0 = i > 0 ? points[i - 1] : Vector2d(2.0 * p1 - p2);
    const Vector2d p3 = i + 2 < count ? points[i + 2] : Vector2d(2.0 * p2 - p1);
    const double t1 = std::sqrt((p1 - p0).norm()), t2 = t1 + std::sqrt((p2 - p1).norm());
    const double t3 = t2 + std::sqrt((p3 - p2).norm());
    const int steps = static_cast<int>(std::clamp((p2 - p1).norm() / fine, 16.0, 1e5));
    Vector2d before = p1;
    for (int k = 1; k <= steps; ++k) {
      const double t = t1 + (t2 - t1) * k / steps;
      const Vector2d a1 = ((t1 - t) * p0 + t * p1) / t1;
      const Vector2d a2 = ((t2 - t) * p1 + (t - t1) * p2) / (t2 - t1);
      const Vector2d a3 = ((t3 - t) * p2 + (t - t2) * p3) / (t3 - t2);
      const Vector2d b1 = ((t2 - t) * a1 + t * a2) / t2;
      const Vector2d b2 = ((t3 - t) * a2 + (t - t1) * a3) / (t3 - t1);
      const Vector2d next = k == steps ? p2 : Vector2d(((t2 - t) * b1 + (t - t1) * b2) / (t2 - t1));
      path.push_back(Curve::line(before, next));
      before = next;
    }
  }
  return path;
}

/// The way along a letter's line, whose curves a font stores as a few short lines: a spline runs through
/// them. Corners stay, and so do lines much longer than the next.
Path letter_path(const std::vector<Vector2d>& line) {
  constexpr double sharpest = 0.64;  // cosine of 50 deg: a curve's lines turn by less, corners by more
  constexpr double longest = 2.5;    // times the next line
  Path path;
  std::vector<Vector2d> smooth = {line.front()};
  const auto end_smooth = [&] {
    Path part;
    if (smooth.size() > 2)
      part = spline_path(smooth);
    else if (smooth.size() == 2)
      part = {Curve::line(smooth[0], smooth[1])};
    path.insert(path.end(), part.begin(), part.end());
    smooth = {smooth.back()};
  };
  for (std::size_t i = 1; i < line.size(); ++i) {
    smooth.push_back(line[i]);
    if (i + 1 == line.size()) break;
    const Vector2d before = line[i] - line[i - 1], after = line[i + 1] - line[i];
    const double ratio = before.norm() / after.norm();
    if (before.dot(after) < sharpest * before.norm() * after.norm() || ratio > longest ||
        ratio < 1.0 / longest)
      end_smooth();
  }
  end_smooth();
  return path;
}

/// One path per pen stroke.
std::vector<Path> text_paths(const ScriptText& text) {
  const double angle = to_radians(text.angle);
  const Vector2d along(elementary::cos(angle), elementary::sin(angle)), up(-along.y(), along.x());
  const HersheyFont font(text.font);
  std::vector<Path> paths;
  double x = 0.0;  // m along the base line
  for (const char letter : text.text) {
    const SingleStrokeText drawn = font.draw({&letter, 1});
    const auto place = [&](const Vector2d& p) -> Vector2d {
      return text.at + (x + p.x() * text.height) * along + p.y() * text.height * up;
    };
    for (const std::vector<Vector2d>& line : drawn.polylines) {
      std::vector<Vector2d> points;
      for (const Vector2d& point : line)
        if (points.empty() || place(point) != points.back()) points.push_back(place(point));
      if (points.size() > 1) paths.push_back(letter_path(points));
    }
    x += drawn.width * text.height + text.spacing;
  }
  return paths;
}

/// The pen strokes of a segment that draws; `point` is where the pen is.
struct ToPaths {
  Vector2d point;
  std::vector<Path> operator()(const ScriptMove&) const { return {}; }
  std::vector<Path> operator()(const ScriptLine& line) const {
    return {{Curve::line(line.from.value_or(point), line.to)}};
  }
  std::vector<Path> operator()(const ScriptArc& arc) const {
    return {{Curve::arc(arc.centre, arc.radius, to_radians(arc.start_angle), to_radians(arc.end_angle))}};
  }
  std::vector<Path> operator()(const ScriptSpline& spline) const {
    for (std::size_t i = 1; i < spline.points.size(); ++i) {
      if (spline.points[i] == spline.points[i - 1])
        throw_input_error("points {} and {} are the same; give each spline point once", i, i + 1);
    }
    return {spline_path(spline.points)};
  }
  std::vector<Path> operator()(const ScriptText& text) const { return text_paths(text); }
};

void run_segment(Pen& pen, const ScriptSegment& segment, const StrokeScript& script,
                 const ForceSettings& force) {
  if (const auto* move = std::get_if<ScriptMove>(&segment.shape)) {
    pen.travel(move->to);
  } else {
    if (segment.press.values.empty()) throw_input_error("neither depth nor force is given; give one of them");
    const PostureProfile profile(height_profile(segment.press, force), segment.turn);
    if (profile.highest() > script.clearance) {
      throw_input_error("it rises to {} m, above the clearance of {} m; raise clearance or press deeper",
                        profile.highest(), script.clearance);
    }
    const std::vector<Path> paths = std::visit(ToPaths{pen.point()}, segment.shape);
    if (paths.empty()) throw_input_error("it draws nothing; give it at least one visible letter");
    for (const Path& path : paths) {
      if (!(length_of(path) > 0.0))
        throw_input_error("it has no length; give it an end that differs from its start");
      pen.draw(path, profile, segment.speed);
    }
  }
  if (segment.wait > 0.0) pen.wait(segment.wait);
}

}  // namespace

bool presses_by_force(const StrokeScript& script) {
  return std::any_of(script.segments.begin(), script.segments.end(), [](const ScriptSegment& segment) {
    return segment.press.kind == PressProfile::Kind::force;
  });
}

Stroke trace_script(const StrokeScript& script, const ForceSettings& force) {
  if (presses_by_force(script) && force.law != ForceLaw::paper)
    throw_input_error(
        "{}: the script gives forces, but only the paper's law can turn forces into depths; give depths, or "
        "set force.law = \"paper\"",
        script.name);
  if (script.segments.empty()) throw_input_error("{}: it has no segments; add at least one", script.name);
  Pen pen(script);
  for (int turn = 0; turn < script.repeat; ++turn) {
    for (std::size_t i = 0; i < script.segments.size(); ++i) {
      try {
        run_segment(pen, script.segments[i], script, force);
      } catch (const Error& failure) {
        throw Error(failure.kind(), fmt::format("{}: segment {}: {}", script.name, i + 1, failure.what()));
      }
    }
  }
  pen.lift();
  Stroke stroke = pen.finish();
  stroke.follows_sand = presses_by_force(script);
  check_stroke(stroke, script.name);
  return stroke;
}

}  // namespace sandstroke
