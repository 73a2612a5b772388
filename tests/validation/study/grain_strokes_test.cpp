#include "validation/study/grain_strokes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "validation/study/study.h"

namespace sandstroke {
namespace {

/// The columns of tests/accuracy/grains/`name`, by stroke without its bed ("sphere-4" of "sphere-4-a"): row
/// by row.
std::map<std::string, std::vector<std::vector<double>>> table(const std::string& name) {
  std::map<std::string, std::vector<std::vector<double>>> rows;
  std::ifstream file(SANDSTROKE_SOURCE "/tests/accuracy/grains/" + name);
  std::string line, field;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::getline(fields, field, ',');
    std::vector<double>& row = rows[field.substr(0, field.rfind('-'))].emplace_back();
    while (std::getline(fields, field, ',')) row.push_back(std::stod(field));
  }
  return rows;
}

/// "sphere-4", "again-4", "plunge-6", "blade-4", ...
std::string name_in_table(const GrainStroke& stroke) {
  const std::map<ToolShape, const char*> names = {{ToolShape::sphere, stroke.way == 0.0   ? "plunge-"
                                                                      : stroke.passes > 1 ? "again-"
                                                                                          : "sphere-"},
                                                  {ToolShape::plate, "blade-"},
                                                  {ToolShape::cylinder, "plate-"},
                                                  {ToolShape::cone, "cone-"}};
  return names.at(stroke.shape) + std::to_string(std::lround(1e3 * stroke.depth));
}

TEST(GrainStrokes, AreTheMeansOfTheTables) {
  const auto sections = table("sections.csv"), forces = table("forces.csv");
  ASSERT_EQ(sections.size(), grain_strokes.size());
  for (const GrainStroke& stroke : grain_strokes) {
    const auto& section = sections.at(name_in_table(stroke));
    const auto& force = forces.at(name_in_table(stroke));
    const double beds = static_cast<double>(force.size());
    for (std::size_t bin = 0; bin < stroke.change.size(); ++bin) {
      double sum = 0.0;
      for (std::size_t row = bin; row < section.size(); row += stroke.change.size()) {
        EXPECT_NEAR(1e-3 * section[row][0], (static_cast<double>(bin) + 0.5) * grain_bin, 1e-9);
        sum += 1e-3 * section[row][1];
      }
      EXPECT_NEAR(stroke.change[bin], sum / beds, 1e-6) << stroke.name << bin;
    }
    double against = 0.0, up = 0.0;
    for (const std::vector<double>& row : force) {
      against += row[0];
      up += row[2];
    }
    if (stroke.way > 0.0) {
      EXPECT_NEAR(stroke.against, against / beds, 1e-5) << stroke.name;
    }
    EXPECT_NEAR(stroke.up, up / beds, 1e-5) << stroke.name;
  }
}

TEST(GrainStrokes, CountDepthFromFirstTouch) {
  for (GrainStroke stroke : grain_strokes) {
    stroke.depth = 0.0;
    const GrainReply still = reply_to(stroke, grain_scene(stroke, ModelPreset::accurate, 5));
    for (const double change : still.change) EXPECT_EQ(change, 0.0) << stroke.name;
    stroke.depth = 0.0005;
    const GrainReply touched = reply_to(stroke, grain_scene(stroke, ModelPreset::accurate, 5));
    EXPECT_LT(touched.change[0], 0.0) << stroke.name;
    EXPECT_GT(touched.up, 0.0) << stroke.name;
  }
}

TEST(GrainStrokes, FeelAFurrowOfTheirOwnAsGrainsDo) {
  std::map<std::string, const GrainStroke*> by_name;
  for (const GrainStroke& stroke : grain_strokes) by_name[name_in_table(stroke)] = &stroke;
  const GrainStroke &first = *by_name.at("sphere-4"), &again = *by_name.at("again-4");
  const auto drag = [](const GrainStroke& stroke) {
    return reply_to(stroke, grain_scene(stroke, ModelPreset::accurate, 10)).against;
  };
  EXPECT_NEAR(drag(again) / drag(first), again.against / first.against, 0.05);
}

TEST(SectionError, IsNoneOfTheGrainsOwnSectionAndAllOfUntouchedSand) {
  for (const GrainStroke& stroke : grain_strokes) {
    EXPECT_EQ(section_error(stroke.change, stroke), 0.0);
    EXPECT_NEAR(section_error(std::vector<double>(stroke.change.size(), 0.0), stroke), 1.0, 1e-12);
  }
}

TEST(GrooveOf, IsBothSidesUpToTheLevee) {
  const Groove groove = groove_of({-0.003, -0.001, 0.0005, 0.002, -0.001});
  EXPECT_NEAR(groove.area, 2.0 * 0.002 * 0.004, 1e-12);
  EXPECT_EQ(groove.levee, 0.002);
}

/// The largest errors that the validation page's lines allow, of section and force.
struct Bound {
  double section, force;
};
const std::map<std::string, Bound> bounds = {
    {"sphere, 2 mm deep", {0.30, 0.45}},
    {"sphere, 4 mm deep", {0.27, 0.25}},
    {"sphere, 6 mm deep", {0.27, 0.45}},
    {"sphere plunged, 6 mm deep", {0.60, 1.40}},
    {"sphere, 4 mm deep, second pass", {0.35, 0.35}},
    {"blade, 4 mm deep", {0.90, 0.75}},
    {"plate plunged, 4 mm deep", {0.75, 0.30}},
};

TEST(GrainsProblem, AccurateStaysAsNearToGrainsAsTheValidationPageSays) {
  StudyOptions options;
  options.quick = true;
  options.problems = {"grains"};
  options.repeats = 1;
  std::map<std::string, double> accurate, paper;  // of 10 cells per radius
  for (const StudyRun& run : run_study(options).runs) {
    const std::string name = run.series.substr(run.series.find(", ") + 2);
    if (run.series.starts_with("paper")) {
      paper[name] = run.error;
      continue;
    }
    accurate[name] = run.error;
    EXPECT_LT(run.error, bounds.at(name).section) << name << ", " << run.label;
    EXPECT_LT(run.score.force_error, bounds.at(name).force) << name << ", " << run.label;
  }
  EXPECT_EQ(accurate.size(), grain_strokes.size());
  for (const char* deep : {"sphere, 4 mm deep", "sphere, 6 mm deep"})
    EXPECT_LT(accurate.at(deep), 0.7 * paper.at(deep));  // which fills its own furrow
}

}  // namespace
}  // namespace sandstroke
