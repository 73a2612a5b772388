#include "io/stroke_script_toml.h"

#include <algorithm>

#include "io/key_reader.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;

constexpr Range speed_range{0.0, 100.0, true};
constexpr Range depth_range{-1.0, 1.0};
constexpr Range force_range{0.0, 1000.0};

/// The given depth and force; no numbers: not given.
struct PressKeys {
  std::vector<double> depth, force;
};

void show_press(KeyVisitor& v, PressKeys& press) {
  v.profile("depth", press.depth, depth_range, "m",
            "depth below z = 0; a list gives values evenly spaced along the segment");
  v.profile("force", press.force, force_range, "N",
            "repulse force on the hand, instead of depth; all heights then count from the surface of the "
            "sand; a list works as for depth");
}

void show_turn(KeyVisitor& v, ToolTurn& turn) {
  int heading = static_cast<int>(turn.heading);
  v.choice("heading", heading, {"fixed", "path"},
           "fixed: the tool keeps its heading; path: its +x points along the path");
  turn.heading = static_cast<ToolTurn::Heading>(heading);
  v.profile("turn", turn.turn, degrees, "deg",
            "rotation of the tool about z from its heading, from +x towards +y; a list works as for depth");
  v.profile("tilt", turn.tilt, degrees, "deg",
            "tilt of the tool: its upper end leans towards the tool's +x; a list works as for depth");
}

/// The script's values, which segments take if they have none of their own.
struct Defaults {
  double speed = ScriptSegment{}.speed;
  PressKeys press;
  ToolTurn turn;
};

void show_script(KeyVisitor& v, StrokeScript& script, Defaults& defaults) {
  v.numbers("start", script.start.data(), 2, any_number, "m", "where the tool starts, in the air");
  v.number("clearance", script.clearance, {0.0, 1.0}, "m", "height above z = 0 at which the tool travels");
  v.number("travel_speed", script.travel_speed, speed_range, "m/s", "speed between segments, in the air");
  v.number("plunge_speed", script.plunge_speed, speed_range, "m/s", "speed down into the sand and up again");
  v.number("turn_speed", script.turn_speed, {0.0, 1e5, true}, "deg/s",
           "speed at which the tool turns while it stays in place");
  v.number("rate", script.rate, {20.0, 1e6}, "Hz", "samples per second");  // slower ones would count as gaps
  v.integers("repeat", &script.repeat, 1, 1, 1000, "number of times that the segments are drawn");
  v.number("speed", defaults.speed, speed_range, "m/s", "speed of the tip while it draws");
  show_press(v, defaults.press);
  show_turn(v, defaults.turn);
}

void show_point(KeyVisitor& v, const char* key, Vector2d& point, const char* help) {
  v.require(key);
  v.numbers(key, point.data(), 2, any_number, "m", help);
}

void show_number(KeyVisitor& v, const char* key, double& value, Range range, const char* unit,
                 const char* help) {
  v.require(key);
  v.number(key, value, range, unit, help);
}

void show_shape(KeyVisitor& v, ScriptMove& move) { show_point(v, "to", move.to, "end point"); }

void show_shape(KeyVisitor& v, ScriptLine& line) {
  if (v.given("from"))
    v.numbers("from", line.from.emplace(0.0, 0.0).data(), 2, any_number, "m",
              "start point; default: where the tool is");
  show_point(v, "to", line.to, "end point");
}

void show_shape(KeyVisitor& v, ScriptArc& arc) {
  show_point(v, "centre", arc.centre, "centre of the circle");
  show_number(v, "radius", arc.radius, positive, "m", "radius of the circle");
  show_number(v, "start_angle", arc.start_angle, any_number, "deg", "start of the arc, from +x towards +y");
  show_number(v, "end_angle", arc.end_angle, any_number, "deg",
              "end of the arc; clockwise if below start_angle");
}

void show_shape(KeyVisitor& v, ScriptSpline& spline) {
  v.require("points");
  v.points("points", spline.points, "m", "2 or more points that the spline runs through: [[x, y], ...]");
}

void show_shape(KeyVisitor& v, ScriptText& text) {
  v.require("text");
  v.text("text", text.text, "text to draw, in ASCII letters");
  v.text("font", text.font, "a single-stroke (Hershey) font");
  show_point(v, "at", text.at, "left end of the baseline");
  show_number(v, "height", text.height, positive, "m", "height of capital letters");
  v.number("angle", text.angle, any_number, "deg", "direction of the baseline, from +x towards +y");
  v.number("spacing", text.spacing, any_number, "m", "space added between letters");
}

void show_segment(KeyVisitor& v, ScriptSegment& segment, PressKeys& press) {
  int kind = 0;
  v.require("kind");
  v.choice("kind", kind, {"move", "line", "arc", "spline", "text"},
           "what the segment draws; move draws nothing: the tool travels in the air");
  const decltype(segment.shape) shapes[] = {ScriptMove{}, ScriptLine{}, ScriptArc{}, ScriptSpline{},
                                            ScriptText{}};
  segment.shape = shapes[kind];
  v.number("wait", segment.wait, not_negative, "s", "pause at the end of the segment");
  if (kind > 0) {
    v.number("speed", segment.speed, speed_range, "m/s", "speed of the tip; default: that of the script");
    show_press(v, press);
    show_turn(v, segment.turn);
  }
  std::visit([&](auto& shape) { show_shape(v, shape); }, segment.shape);
}

/// The depth or force of a table, else the fallback.
PressProfile press_of(const TomlReader& toml, const PressKeys& given, const PressProfile& fallback) {
  if (!given.depth.empty() && !given.force.empty())
    toml.fail("force", "cannot be given together with depth; give only one of them");
  if (!given.depth.empty()) return {PressProfile::Kind::depth, given.depth};
  if (!given.force.empty()) return {PressProfile::Kind::force, given.force};
  return fallback;
}

void check_letters(const TomlReader& toml, const std::string& text) {
  if (text.empty()) toml.fail("text", "is empty; give it at least one letter");
  const auto foreign = [](char letter) { return static_cast<unsigned char>(letter) >= 0x80; };
  if (std::any_of(text.begin(), text.end(), foreign))
    toml.fail("text", "has a letter that the fonts lack; use ASCII letters only");
}

ScriptSegment read_segment(const TomlReader& toml, const PressProfile& default_press,
                           const Defaults& defaults) {
  ScriptSegment segment;
  segment.speed = defaults.speed;
  segment.turn = defaults.turn;
  PressKeys press;
  read_keys(toml, [&](KeyVisitor& visitor) { show_segment(visitor, segment, press); });
  segment.press = press_of(toml, press, default_press);
  if (segment.press.values.empty() && !std::holds_alternative<ScriptMove>(segment.shape))
    toml.fail("kind", "needs a depth or a force; give one, in the segment or for the whole script");
  if (const auto* spline = std::get_if<ScriptSpline>(&segment.shape); spline && spline->points.size() < 2)
    toml.fail("points", "needs at least 2 points; add more");
  if (const auto* text = std::get_if<ScriptText>(&segment.shape)) check_letters(toml, text->text);
  return segment;
}

StrokeScript read(const TomlReader& toml) {
  StrokeScript script;
  script.name = toml.name();
  Defaults defaults;
  read_keys(toml, [&](KeyVisitor& visitor) { show_script(visitor, script, defaults); });
  const PressProfile default_press = press_of(toml, defaults.press, {});
  toml.require("segment");
  for (const TomlReader& table : toml.tables("segment"))
    script.segments.push_back(read_segment(table, default_press, defaults));
  toml.reject_unread([] { return conditions(script_keys()); });
  return script;
}

}  // namespace

std::vector<KeySection> script_keys() {
  return all_keys([](KeyVisitor& visitor) {
    StrokeScript script;
    ScriptSegment segment;
    Defaults defaults;
    PressKeys press;
    visitor.section("", "Keys of the whole script; speed and the keys below it are defaults of the segments");
    show_script(visitor, script, defaults);
    visitor.section("segment", "the parts of the stroke, drawn in order; each begins with [[segment]]");
    show_segment(visitor, segment, press);
  });
}

StrokeScript read_stroke_script(const std::filesystem::path& path) {
  return read(TomlReader::from_file(path));
}

StrokeScript parse_stroke_script(std::string_view text, const std::string& name) {
  return read(TomlReader::from_text(text, name));
}

}  // namespace sandstroke
