#include "haptics/stroke_script.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/angle.h"
#include "core/elementary.h"
#include "core/error.h"
#include "picture/hershey_text.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;

constexpr double most_samples = 2e7;   // over five hours at 1000 Hz, 640 MB
constexpr int most_legs = 20'000'000;  // straight or round: seconds of work, however few samples they give
constexpr double same_point = 1e-9;    // m

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
};
using Path = std::vector<Curve>;

double length_of(const Path& path) {
  double length = 0.0;
  for (const Curve& curve : path) length += curve.length;
  return length;
}

/// Heights at evenly spaced fractions of a path's length, linear in between.
class HeightProfile {
 public:
  HeightProfile(const PressProfile& press, const ForceSettings& force) {
    for (const double value : press.values)
      heights_.push_back(press.kind == PressProfile::Kind::depth ? -value
                                                                 : -depth_of_repulse_force(value, force));
  }
  double highest() const { return *std::max_element(heights_.begin(), heights_.end()); }
  double at(double fraction) const {
    const std::size_t knots = heights_.size();
    if (knots == 1) return heights_.front();
    const double place = fraction * static_cast<double>(knots - 1);
    const std::size_t knot = std::min(static_cast<std::size_t>(place), knots - 2);
    return heights_[knot] + (place - static_cast<double>(knot)) * (heights_[knot + 1] - heights_[knot]);
  }
  /// The fractions at which the profile bends.
  std::vector<double> knots() const {
    std::vector<double> found;
    for (std::size_t i = 1; i + 1 < heights_.size(); ++i)
      found.push_back(static_cast<double>(i) / static_cast<double>(heights_.size() - 1));
    return found;
  }

 private:
  std::vector<double> heights_;
};

/// The pen, moved leg by leg; samples are taken as it goes.
class Pen {
 public:
  explicit Pen(const StrokeScript& script) : script_(script), point_(script.start), z_(script.clearance) {}

  const Vector2d& point() const { return point_; }

  void wait(double seconds) { add(Curve::line(point_, point_), 0.0, 1.0, z_, seconds); }
  void lift() { climb_to(script_.clearance); }
  void travel(const Vector2d& to) {
    lift();
    run(Curve::line(point_, to), 0.0, 1.0, z_, script_.travel_speed);
  }
  /// Goes to the path's first point, lifted where that is elsewhere, and draws the path.
  void draw(const Path& path, const HeightProfile& profile, double speed) {
    const Vector2d& first = path.front().from;
    if ((first - point_).norm() > same_point) travel(first);
    climb_to(profile.at(0.0));
    if (first != point_) run(Curve::line(point_, first), 0.0, 1.0, z_, speed);  // rounding of an arc's end

    const double length = length_of(path);
    const std::vector<double> knots = profile.knots();
    auto knot = knots.begin();
    double drawn = 0.0;  // m of the path, up to the current curve
    for (const Curve& curve : path) {
      double fraction = 0.0;  // of the curve
      for (; knot != knots.end() && *knot * length < drawn + curve.length; ++knot) {
        const double next = std::max(fraction, (*knot * length - drawn) / curve.length);
        run(curve, fraction, next, profile.at(*knot), speed);
        fraction = next;
      }
      drawn += curve.length;
      run(curve, fraction, 1.0, profile.at(&curve == &path.back() ? 1.0 : std::min(drawn / length, 1.0)),
          speed);
    }
  }

  /// The samples so far and one more, at which the pen has come to rest.
  Stroke finish() {
    sample(point_, z_);
    stroke_.nominal_rate = script_.rate;
    stroke_.source = "script " + script_.name;
    return std::move(stroke_);
  }

 private:
  void climb_to(double z) { run(Curve::line(point_, point_), 0.0, 1.0, z, script_.plunge_speed); }
  /// Along a curve from one fraction to another while the height changes linearly: constant speed in space.
  void run(const Curve& curve, double begin, double end, double end_z, double speed) {
    add(curve, begin, end, end_z, elementary::hypot((end - begin) * curve.length, end_z - z_) / speed);
  }
  void add(const Curve& curve, double begin, double end, double end_z, double seconds) {
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
      sample(curve.at(begin + u * (end - begin)), z_ + u * (end_z - z_));
    }
    time_ = end_time;
    z_ = end_z;
    point_ = end == 1.0 ? curve.to : curve.at(end);
  }
  double next_time() const { return static_cast<double>(stroke_.size()) / script_.rate; }
  void sample(const Vector2d& point, double z) {
    stroke_.time.push_back(next_time());
    stroke_.position.emplace_back(point.x(), point.y(), z);
  }

  const StrokeScript& script_;
  Vector2d point_;
  double z_;
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
  // Aimed at for a leg: as far as a tool at 0.1 m/s gets within a servo tick of 1 ms; farther where there
  // would be millions of legs.
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
      Path path;
      for (std::size_t i = 0; i + 1 < line.size(); ++i)
        path.push_back(Curve::line(place(line[i]), place(line[i + 1])));
      if (length_of(path) > 0.0) paths.push_back(std::move(path));
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
    const HeightProfile profile(segment.press, force);
    if (profile.highest() > script.clearance) {
      throw_input_error("it rises to {} m, above the clearance of {} m; raise clearance or press deeper",
                        profile.highest(), script.clearance);
    }
    const std::vector<Path> paths = std::visit(ToPaths{pen.point()}, segment.shape);
    if (paths.empty()) throw_input_error("it draws nothing; give it letters that leave a mark");
    for (const Path& path : paths) {
      if (!(length_of(path) > 0.0))
        throw_input_error("it has no length; let it end elsewhere than it begins");
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
        "{}: it presses by force, which is known for the paper's law only; give depths, or set force.law = "
        "\"paper\"",
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
