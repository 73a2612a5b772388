#include "io/stroke_script_toml.h"

#include <algorithm>

#include "io/toml_reader.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;

constexpr Range speed_range{0.0, 100.0, true};
constexpr Range depth_range{-1.0, 1.0};
constexpr Range force_range{0.0, 1000.0};

Vector2d point(const TomlReader& toml, std::string_view key, const Vector2d& fallback) {
  const std::vector<double> xy = toml.numbers(key, {fallback.x(), fallback.y()});
  return {xy[0], xy[1]};
}

Vector2d required_point(const TomlReader& toml, std::string_view key) {
  toml.require(key);
  return point(toml, key, Vector2d::Zero());
}

double required_number(const TomlReader& toml, std::string_view key, Range range = any_number) {
  toml.require(key);
  return toml.number(key, 0.0, range);
}

std::string letters(const TomlReader& toml, std::string_view key) {
  toml.require(key);
  std::string text = toml.text(key, "");
  if (text.empty()) toml.fail(key, "is empty; give it at least one letter");
  const auto foreign = [](char letter) { return static_cast<unsigned char>(letter) >= 0x80; };
  if (std::any_of(text.begin(), text.end(), foreign))
    toml.fail(key,
              "has a letter outside ASCII, which the single-stroke fonts lack; write it with ASCII letters");
  return text;
}

/// depth or force of a table, or else the fallback.
PressProfile press(const TomlReader& toml, const PressProfile& fallback) {
  const bool has_depth = toml.has("depth"), has_force = toml.has("force");
  if (has_depth && has_force) toml.fail("force", "is given beside depth; give only one of them");
  if (has_depth) return {PressProfile::Kind::depth, toml.profile("depth", {}, depth_range)};
  if (has_force) return {PressProfile::Kind::force, toml.profile("force", {}, force_range)};
  return fallback;
}

ScriptLine line(const TomlReader& toml) {
  ScriptLine line;
  if (toml.has("from")) line.from = required_point(toml, "from");
  line.to = required_point(toml, "to");
  return line;
}

ScriptArc arc(const TomlReader& toml) {
  return {required_point(toml, "centre"), required_number(toml, "radius", positive),
          required_number(toml, "start_angle"), required_number(toml, "end_angle")};
}

ScriptSpline spline(const TomlReader& toml) {
  ScriptSpline spline;
  toml.require("points");
  for (const std::vector<double>& xy : toml.points("points")) spline.points.emplace_back(xy[0], xy[1]);
  if (spline.points.size() < 2) toml.fail("points", "needs at least 2 points; add more");
  return spline;
}

ScriptText text(const TomlReader& toml) {
  return {letters(toml, "text"),      toml.text("font", "futural"),
          required_point(toml, "at"), required_number(toml, "height", positive),
          toml.number("angle", 0.0),  toml.number("spacing", 0.0)};
}

ScriptSegment segment(const TomlReader& toml, const PressProfile& default_press, double default_speed) {
  ScriptSegment segment;
  segment.wait = toml.number("wait", 0.0, not_negative);
  toml.require("kind");
  const int kind = toml.choice("kind", 0, {"move", "line", "arc", "spline", "text"});
  if (kind == 0) {
    segment.shape = ScriptMove{required_point(toml, "to")};
    return segment;
  }
  segment.speed = toml.number("speed", default_speed, speed_range);
  segment.press = press(toml, default_press);
  if (segment.press.values.empty())
    toml.fail("kind", "has neither depth nor force; give one, here or for all");
  switch (kind) {
    case 1:
      segment.shape = line(toml);
      break;
    case 2:
      segment.shape = arc(toml);
      break;
    case 3:
      segment.shape = spline(toml);
      break;
    default:
      segment.shape = text(toml);
  }
  return segment;
}

StrokeScript read(const TomlReader& toml) {
  StrokeScript script;
  script.name = toml.name();
  script.start = point(toml, "start", script.start);
  script.clearance = toml.number("clearance", script.clearance, {0.0, 1.0});
  script.travel_speed = toml.number("travel_speed", script.travel_speed, speed_range);
  script.plunge_speed = toml.number("plunge_speed", script.plunge_speed, speed_range);
  script.rate = toml.number("rate", script.rate, {20.0, 1e6});  // slower samples would count as gaps
  script.repeat = toml.integer("repeat", script.repeat, 1, 1000);
  const double speed = toml.number("speed", ScriptSegment{}.speed, speed_range);
  const PressProfile default_press = press(toml, {});
  toml.require("segment");
  for (const TomlReader& table : toml.tables("segment"))
    script.segments.push_back(segment(table, default_press, speed));
  toml.reject_unread();
  return script;
}

}  // namespace

std::string script_help() {
  return R"(A script (TOML; m, m/s, degrees, N, s):
  start = [-0.2, 0.0]           # where the tool begins, in the air
  depth = 0.006                 # below z = 0; or force. Here for all segments, or in each
  speed = 0.1                   # of the tip while it draws; likewise
  clearance = 0.02              # height above z = 0 at which it travels ...
  travel_speed = 0.2            #   at this speed
  plunge_speed = 0.05           # up and down
  repeat = 1                    # times that the segments are run
  rate = 1000                   # samples a second
  [[segment]]
  kind = "line"                 # also: move, arc, spline, text
  to = [0.2, 0.0]
  depth = [0.008, 0.001]        # a list is spread along the segment: it ends weaker than it begins
  wait = 0.5                    # rest at its end
Keys of a segment: kind, speed, depth or force, wait; and for
  move    to
  line    to; from (default: where the tool is)
  arc     centre, radius, start_angle, end_angle (clockwise where that is less)
  spline  points = [[x, y], ...]
  text    text, at, height; font ("futural"), angle, spacing
)";
}

StrokeScript read_stroke_script(const std::filesystem::path& path) {
  return read(TomlReader::from_file(path));
}

StrokeScript parse_stroke_script(std::string_view text, const std::string& name) {
  return read(TomlReader::from_text(text, name));
}

}  // namespace sandstroke
