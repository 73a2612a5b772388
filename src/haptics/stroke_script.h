#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "haptics/stroke.h"
#include "rules/force.h"

namespace sandstroke {

/// How hard a segment presses along its way: values spread evenly over its arc length, the depth linear in
/// between (so {0.008, 0.001} ends weaker than it starts).
struct PressProfile {
  enum class Kind { depth, force };
  Kind kind = Kind::depth;
  /// depth: m below z = 0. force: N >= 0, the repulse force that is felt. If any segment presses by force,
  /// the stroke follows the sand (Stroke::follows_sand), and depths count from there, too.
  std::vector<double> values;
};

/// How the tool is turned while a segment is drawn. It leans by `tilt` about its own y axis, its upper end
/// towards its +x; then it turns by `turn` about z. Each is a list in deg, spread like a PressProfile's;
/// empty: 0.
struct ToolTurn {
  enum class Heading { fixed, path };
  Heading heading = Heading::fixed;  ///< path: its +x points along the path, and `turn` counts from there
  std::vector<double> turn = {};     ///< from +x towards +y
  std::vector<double> tilt = {};

  bool turns() const { return heading == Heading::path || !turn.empty() || !tilt.empty(); }
};

// Shapes that a segment draws, in the xy plane. All lengths in m, angles in deg counted from +x towards +y.
struct ScriptMove {
  Eigen::Vector2d to = Eigen::Vector2d::Zero();  ///< reached in the air
};
struct ScriptLine {
  std::optional<Eigen::Vector2d> from;  ///< none: the current point
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
};
struct ScriptArc {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0.0;
  double start_angle = 0.0, end_angle = 0.0;  ///< clockwise where end < start; more than one turn is fine
};
struct ScriptSpline {
  std::vector<Eigen::Vector2d> points;  ///< at least 2; a centripetal Catmull-Rom spline runs through them
};
struct ScriptText {
  std::string text, font = "futural";            ///< single-stroke letters, see hershey_text
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< left end of the base line
  double height = 0.0;                           ///< of capitals
  double angle = 0.0;                            ///< of the base line
  double spacing = 0.0;                          ///< added between letters
};

struct ScriptSegment {
  std::variant<ScriptMove, ScriptLine, ScriptArc, ScriptSpline, ScriptText> shape;
  PressProfile press = {};  ///< unused by a move; a text presses like this along each of its pen strokes
  double speed = 0.1;       ///< m/s, of the tip along its path in space; unused by a move
  double wait = 0.0;        ///< s, rest at the segment's end
  ToolTurn turn = {};       ///< like press; a move does not turn the tool
};

/// A stroke described by what it draws. The tool starts and ends in the air, at height `clearance`. If a
/// segment begins away from the current point, the tool goes there lifted: up, across, down. If the tool must
/// turn, at a segment's beginning or a corner that it follows, it turns where it stands.
struct StrokeScript {
  std::string name = "script";                      ///< for messages
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< m
  double clearance = 0.02;                          ///< m above z = 0
  double travel_speed = 0.2;                        ///< m/s, across
  double plunge_speed = 0.05;                       ///< m/s, up and down
  double turn_speed = 180.0;                        ///< deg/s, of turns where it stands
  double rate = 1000.0;                             ///< Hz, samples of the stroke
  int repeat = 1;                                   ///< times the segments are run
  std::vector<ScriptSegment> segments;
};

/// Whether any segment presses by force, so that the force constants decide its depth.
bool presses_by_force(const StrokeScript& script);

/// Samples a script at times i / rate. Lines and arcs are exact (an arc under a sloping depth is a helix).
/// The tip has the asked speed in space throughout a path, so between samples it is never faster. Error:
/// input, naming script and segment.
Stroke trace_script(const StrokeScript& script, const ForceSettings& force);

}  // namespace sandstroke
