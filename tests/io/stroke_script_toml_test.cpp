#include "io/stroke_script_toml.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <map>

#include "core/error.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

StrokeScript parse(const std::string& text) { return parse_stroke_script(text, "s.toml"); }

std::string script_complaint(const std::string& text) {
  try {
    parse(text);
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::input);
    return failure.what();
  }
  return "";
}

/// A script with one segment, which begins in line 2.
std::string segment(const std::string& keys) { return "depth = 0.01\n[[segment]]\n" + keys; }

TEST(StrokeScriptToml, ReadsEveryKind) {
  const StrokeScript script = parse(R"(
start = [0.1, -0.2]
clearance = 0.03
speed = 0.15
travel_speed = 0.4
plunge_speed = 0.07
turn_speed = 60
heading = "path"
turn = 20
tilt = [0, 10]
rate = 500
repeat = 3
depth = [0.008, 0.001]
[[segment]]
kind = "move"
to = [1, 2]
wait = 0.5
[[segment]]
kind = "line"
from = [3, 4]
to = [5, 6]
force = 2.5
[[segment]]
kind = "line"
to = [7, 8]
depth = 0.004
speed = 0.05
[[segment]]
kind = "arc"
centre = [0, 1]
radius = 0.1
start_angle = 90
end_angle = -270.5
[[segment]]
kind = "spline"
points = [[0, 0], [1, 0.5], [2, 0]]
[[segment]]
kind = "text"
text = "Sand"
at = [-0.3, 0]
height = 0.12
angle = 15
spacing = 0.01
font = "cursive"
)");
  EXPECT_EQ(script.name, "s.toml");
  EXPECT_EQ(script.start, Vector2d(0.1, -0.2));
  EXPECT_EQ(script.clearance, 0.03);
  EXPECT_EQ(script.travel_speed, 0.4);
  EXPECT_EQ(script.plunge_speed, 0.07);
  EXPECT_EQ(script.turn_speed, 60.0);
  for (const ScriptSegment& segment : script.segments) {
    if (std::holds_alternative<ScriptMove>(segment.shape)) continue;
    EXPECT_EQ(segment.turn.heading, ToolTurn::Heading::path);
    EXPECT_EQ(segment.turn.turn, std::vector{20.0});
    EXPECT_EQ(segment.turn.tilt, (std::vector{0.0, 10.0}));
  }
  EXPECT_EQ(script.rate, 500.0);
  EXPECT_EQ(script.repeat, 3);
  ASSERT_EQ(script.segments.size(), 6u);

  EXPECT_EQ(std::get<ScriptMove>(script.segments[0].shape).to, Vector2d(1, 2));
  EXPECT_EQ(script.segments[0].wait, 0.5);

  const auto& line = std::get<ScriptLine>(script.segments[1].shape);
  EXPECT_EQ(line.from, Vector2d(3, 4));
  EXPECT_EQ(line.to, Vector2d(5, 6));
  EXPECT_EQ(script.segments[1].press.kind, PressProfile::Kind::force);
  EXPECT_THAT(script.segments[1].press.values, ElementsAre(2.5));
  EXPECT_EQ(script.segments[1].speed, 0.15);

  EXPECT_FALSE(std::get<ScriptLine>(script.segments[2].shape).from.has_value());
  EXPECT_EQ(script.segments[2].press.kind, PressProfile::Kind::depth);
  EXPECT_THAT(script.segments[2].press.values, ElementsAre(0.004));
  EXPECT_EQ(script.segments[2].speed, 0.05);

  const auto& arc = std::get<ScriptArc>(script.segments[3].shape);
  EXPECT_EQ(arc.centre, Vector2d(0, 1));
  EXPECT_EQ(arc.radius, 0.1);
  EXPECT_EQ(arc.start_angle, 90.0);
  EXPECT_EQ(arc.end_angle, -270.5);
  EXPECT_THAT(script.segments[3].press.values, ElementsAre(0.008, 0.001));  // the default for all

  EXPECT_THAT(std::get<ScriptSpline>(script.segments[4].shape).points,
              ElementsAre(Vector2d(0, 0), Vector2d(1, 0.5), Vector2d(2, 0)));

  const auto& text = std::get<ScriptText>(script.segments[5].shape);
  EXPECT_EQ(text.text, "Sand");
  EXPECT_EQ(text.font, "cursive");
  EXPECT_EQ(text.at, Vector2d(-0.3, 0));
  EXPECT_EQ(text.height, 0.12);
  EXPECT_EQ(text.angle, 15.0);
  EXPECT_EQ(text.spacing, 0.01);
}

TEST(StrokeScriptToml, HasSensibleDefaults) {
  const StrokeScript script = parse(segment("kind = \"line\"\nto = [0.1, 0]\n"));
  EXPECT_EQ(script.start, Vector2d(0, 0));
  EXPECT_EQ(script.clearance, 0.02);
  EXPECT_EQ(script.rate, 1000.0);
  EXPECT_EQ(script.repeat, 1);
}

TEST(StrokeScriptToml, TheKeysOfTheHelpAreReadWithTheirDefaults) {
  const std::vector<KeySection> sections = script_keys();
  ASSERT_EQ(sections.size(), 2u);
  for (const KeyRow& row : sections[0].keys) {
    const std::string value = row.value.empty() ? "0.01" : row.value;
    EXPECT_THAT(script_complaint(row.name + " = " + value + "\n[[segment]]\nkind = \"move\"\nto = [0, 0]\n"),
                "");
  }
  const std::map<std::string, std::string> shapes = {
      {"move", "to = [1, 0]\n"},
      {"line", "to = [1, 0]\n"},
      {"arc", "centre = [0, 0]\nradius = 1\nstart_angle = 0\nend_angle = 90\n"},
      {"spline", "points = [[0, 0], [1, 1]]\n"},
      {"text", "text = \"a\"\nat = [0, 0]\nheight = 0.1\n"}};
  for (const auto& [kind, shape] : shapes) {
    for (const KeyRow& row : sections[1].keys) {
      if (("\n" + shape).find("\n" + row.key() + " ") != std::string::npos || row.key() == "kind") continue;
      const bool applies = row.condition.empty() || row.condition.find(" " + kind) != std::string::npos;
      const std::string value = row.key() == "from" ? "[0, 0]" : row.value.empty() ? "0.01" : row.value;
      const std::string complaint = script_complaint((row.key() == "force" ? "" : "depth = 0.01\n") +
                                                     ("[[segment]]\nkind = \"" + kind + "\"\n") + shape +
                                                     row.key() + " = " + value + "\n");
      if (applies)
        EXPECT_EQ(complaint, "") << kind << " " << row.name;
      else
        EXPECT_THAT(complaint, HasSubstr(row.name + " applies only where " + row.condition)) << kind;
    }
  }
  EXPECT_THAT(
      script_complaint(segment("kind = \"line\"\nto = [0, 0]\nradius = 1\n")),
      HasSubstr("s.toml:5: segment.radius applies only where segment.kind is arc; remove it, or change "
                "that"));
}

TEST(StrokeScriptToml, ErrorsNameFileLineAndKey) {
  EXPECT_THAT(script_complaint("start = [0, 0]\n"),
              AllOf(HasSubstr("s.toml"), HasSubstr("segment"), HasSubstr("missing")));
  EXPECT_EQ(script_complaint("[[segmnt]]\nkind = \"line\"\n"),
            "s.toml: segment is missing; add it, or is segmnt meant to be segment?");
  EXPECT_EQ(script_complaint(segment("knid = \"line\"\n")),
            "s.toml:2: segment.kind is missing; add it, or is knid meant to be kind?");
  EXPECT_THAT(script_complaint(segment("to = [0, 0]\n")), AllOf(HasSubstr("s.toml:2:"), HasSubstr("kind")));
  EXPECT_THAT(script_complaint(segment("kind = \"circle\"\n")),
              AllOf(HasSubstr("s.toml:3:"), HasSubstr("circle"), HasSubstr("arc")));
  EXPECT_THAT(script_complaint(segment("kind = \"line\"\n")),
              AllOf(HasSubstr("segment.to"), HasSubstr("missing")));
  EXPECT_THAT(script_complaint(segment("kind = \"line\"\nto = [1, 2, 3]\n")),
              AllOf(HasSubstr("s.toml:4:"), HasSubstr("segment.to")));
  EXPECT_THAT(script_complaint(segment("kind = \"line\"\nto = [1, nan]\n")), HasSubstr("s.toml:4:"));
  EXPECT_THAT(script_complaint(segment("kind = \"line\"\nto = [1, 2]\nspeed = 0\n")),
              AllOf(HasSubstr("s.toml:5:"), HasSubstr("segment.speed")));
  EXPECT_THAT(script_complaint(segment("kind = \"line\"\nto = [1, 2]\ndepth = inf\n")),
              AllOf(HasSubstr("s.toml:5:"), HasSubstr("depth")));
  EXPECT_THAT(script_complaint(segment("kind = \"line\"\nto = [1, 2]\ndepth = []\n")),
              AllOf(HasSubstr("s.toml:5:"), HasSubstr("depth")));
  EXPECT_THAT(script_complaint(segment("kind = \"line\"\nto = [1, 2]\nforce = -1\n")),
              AllOf(HasSubstr("s.toml:5:"), HasSubstr("force")));
  EXPECT_THAT(script_complaint(segment("kind = \"line\"\nto = [1, 2]\nforce = 1\ndepth = 0.01\n")),
              AllOf(HasSubstr("s.toml:5:"), HasSubstr("only one")));
  EXPECT_THAT(script_complaint("depth = 0.01\nforce = 1\n[[segment]]\n"),
              AllOf(HasSubstr("s.toml:2:"), HasSubstr("only one")));
  EXPECT_THAT(script_complaint("[[segment]]\nkind = \"line\"\nto = [1, 2]\n"),
              AllOf(HasSubstr("s.toml:2:"), HasSubstr("needs a depth or a force")));
  EXPECT_THAT(script_complaint(segment("kind = \"spline\"\npoints = [[0, 0]]\n")),
              AllOf(HasSubstr("s.toml:4:"), HasSubstr("2 points")));
  EXPECT_THAT(script_complaint(segment("kind = \"arc\"\ncentre = [0, 0]\nradius = -1\n")),
              AllOf(HasSubstr("s.toml:5:"), HasSubstr("radius")));
  EXPECT_THAT(script_complaint(segment("kind = \"text\"\ntext = \"\"\nat = [0, 0]\nheight = 1\n")),
              AllOf(HasSubstr("s.toml:4:"), HasSubstr("text")));
  EXPECT_THAT(script_complaint(segment("kind = \"text\"\ntext = \"S\u00e4nd\"\nat = [0, 0]\nheight = 1\n")),
              AllOf(HasSubstr("s.toml:4:"), HasSubstr("ASCII")));
  EXPECT_THAT(script_complaint(segment("kind = \"line\"\nto = [1, 2]\nwait = -1\n")),
              AllOf(HasSubstr("s.toml:5:"), HasSubstr("wait")));
  EXPECT_THAT(script_complaint("rate = 1\n"), AllOf(HasSubstr("s.toml:1:"), HasSubstr("rate")));
  EXPECT_THAT(script_complaint("repeat = 0\n"), AllOf(HasSubstr("s.toml:1:"), HasSubstr("repeat")));
  EXPECT_THAT(script_complaint("clearance = -0.1\n"), AllOf(HasSubstr("s.toml:1:"), HasSubstr("clearance")));
}

TEST(StrokeScriptToml, UnknownKeysAreErrors) {
  EXPECT_THAT(script_complaint(segment("kind = \"line\"\nto = [1, 2]\ndept = 0.01\n")),
              AllOf(HasSubstr("s.toml:5:"), HasSubstr("segment.dept")));
  EXPECT_THAT(script_complaint(segment("kind = \"line\"\nto = [1, 2]\nradius = 0.01\n")),
              AllOf(HasSubstr("s.toml:5:"), HasSubstr("radius")));
  EXPECT_THAT(script_complaint("travle_speed = 1\n" + segment("kind = \"line\"\nto = [1, 2]\n")),
              AllOf(HasSubstr("s.toml:1:"), HasSubstr("travel_speed")));
}

TEST(StrokeScriptToml, RunsAsWritten) {
  const Stroke stroke = trace_script(parse("start = [0.1, 0]\nplunge_speed = 0.06\nspeed = 0.05\n" +
                                           segment("kind = \"line\"\nto = [0.2, 0]\n")),
                                     {});
  EXPECT_EQ(stroke.size(), 3001u);  // 0.5 s down, 2 s of 0.1 m, 0.5 s up
  EXPECT_NEAR(stroke.position[1500].x(), 0.15, 1e-14);
  EXPECT_THAT(stroke.source, HasSubstr("s.toml"));
}

}  // namespace
}  // namespace sandstroke
