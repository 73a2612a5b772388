#include "pages/profiles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;

constexpr double cell = 0.01;

/// Rises along x, and by its square along y, so that left and right differ; the last surface is lower by 1 mm
/// where x > 0.
struct Surfaces {
  HeightField initial{60, 80, cell};
  LastSurface last{initial, "final surface"};
  Surfaces() {
    for (int row = 0; row < 60; ++row) {
      for (int col = 0; col < 80; ++col) {
        initial.set(row, col, height(col, row));
        last.surface.set(row, col, height(col, row) - (initial.x_of(col) > 0.0 ? 0.001 : 0.0));
      }
    }
  }
  double height(double col, double row) const { return 1e-3 * col + 1e-5 * row * row; }
};

/// A path through the centres of cells {col, row}; a piece begins at each index of `pieces`.
TipPath path_through(const std::vector<std::pair<int, int>>& cells, std::vector<std::size_t> pieces = {0}) {
  const BedGeometry bed(60, 80, cell);
  TipPath path;
  for (const auto& [col, row] : cells) path.points.emplace_back(bed.x_of(col), bed.y_of(row));
  path.pieces = std::move(pieces);
  return path;
}

std::vector<double> numbers(const Json& list) {
  std::vector<double> values;
  for (const Json& one : list) values.push_back(one.get<double>());
  return values;
}

TEST(ProfilesPart, HasTheCellsThatTheWayPasses) {
  const Surfaces s;
  // 20 cells to the right, 10 up; in steps of more than a cell, which are divided.
  const Json part =
      profiles_part(path_through({{30, 20}, {35, 20}, {50, 20}, {50, 30}}), 0.02, s.initial, s.last);
  const Json& along = part["profiles"][0];
  EXPECT_EQ(along["title"], "Along the stroke");
  const std::vector<double> at = numbers(along["curves"]["initial"]["at"]);
  const std::vector<double> initial = numbers(along["curves"]["initial"]["value"]);
  const std::vector<double> last = numbers(along["curves"]["last"]["value"]);
  EXPECT_NEAR(at.front(), 0.0, 1e-12);
  EXPECT_NEAR(at.back(), 0.30, 1e-12);
  ASSERT_GE(at.size(), 31u);
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (i > 0) {
      EXPECT_LE(at[i] - at[i - 1], cell + 1e-12);
    }
    const double way = at[i] / cell, whole = std::round(way);
    if (std::abs(way - whole) > 0.01) continue;  // between two cells
    const double col = 30 + std::min(whole, 20.0), row = 20 + std::max(0.0, whole - 20.0);
    EXPECT_NEAR(initial[i], s.height(col, row), 1e-12) << way;
    EXPECT_NEAR(initial[i] - last[i], col >= 40 ? 0.001 : 0.0, 1e-12) << way;
  }
}

TEST(ProfilesPart, TheLeftIsPositiveAcrossTheMiddleOfTheWay) {
  const Surfaces s;
  struct Case {
    std::vector<std::pair<int, int>> way;
    int col, row, left_col, left_row;  // the middle, and a cell further to the left of the way
  };
  for (const Case& one : {Case{{{30, 20}, {40, 20}, {50, 20}}, 40, 20, 0, 1},
                          Case{{{50, 20}, {40, 20}, {30, 20}}, 40, 20, 0, -1},
                          Case{{{40, 20}, {40, 30}, {40, 40}}, 40, 30, -1, 0}}) {
    const Json part = profiles_part(path_through(one.way), 0.02, s.initial, s.last);
    const Json& across = part["profiles"][1];
    EXPECT_EQ(across["title"], "Across the stroke");
    const std::vector<double> at = numbers(across["curves"]["last"]["at"]);
    const std::vector<double> initial = numbers(across["curves"]["initial"]["value"]);
    ASSERT_EQ(at.size(), 25u);  // 6 radii of 2 cells to either side
    for (int k = -12; k <= 12; ++k) {
      EXPECT_NEAR(at[static_cast<std::size_t>(k + 12)], k * cell, 1e-12);
      EXPECT_NEAR(initial[static_cast<std::size_t>(k + 12)],
                  s.height(one.col + k * one.left_col, one.row + k * one.left_row), 1e-12);
    }
  }
}

TEST(ProfilesPart, CurvesBreakOffAndTheWayDoesNotCountWhereTheTipWasLifted) {
  const Surfaces s;
  const Json part =
      profiles_part(path_through({{20, 20}, {30, 20}, {50, 40}, {60, 40}}, {0, 2}), 0.02, s.initial, s.last);
  const Json& initial = part["profiles"][0]["curves"]["initial"];
  EXPECT_NEAR(initial["at"].back().get<double>(), 0.20, 1e-12);
  int gaps = 0;
  for (const Json& value : initial["value"]) gaps += std::isnan(value.get<double>());
  EXPECT_EQ(gaps, 1);
  EXPECT_NE(part["text"].get<std::string>().find("moved 0.2 m"), std::string::npos) << part["text"];
}

TEST(ProfilesPart, APlungeIsOnlyCrossed) {
  const Surfaces s;
  const Json part = profiles_part(path_through({{40, 30}}), 0.02, s.initial, s.last);
  ASSERT_EQ(part["profiles"].size(), 1u);
  const std::vector<double> initial = numbers(part["profiles"][0]["curves"]["initial"]["value"]);
  for (int k = -12; k <= 12; ++k)
    EXPECT_NEAR(initial[static_cast<std::size_t>(k + 12)], s.height(40, 30 + k), 1e-12);
}

TEST(ProfilesPart, APathFarBeyondTheBedTakesNoMoreThanItMay) {
  const Surfaces s;
  TipPath path = path_through({{30, 20}, {50, 20}});
  path.points[1].x() = 1e12;
  const Json part = profiles_part(path, 1e9, s.initial, s.last);
  ASSERT_EQ(part["profiles"].size(), 2u);
  EXPECT_LE(part["profiles"][1]["curves"]["last"]["at"].size(), 281u);  // 60 + 80 cells to either side
  path.points[1].x() = HUGE_VAL;
  EXPECT_THROW(profiles_part(path, 0.02, s.initial, s.last), Error);
}

TEST(ProfilesPart, HasNothingOutsideTheBed) {
  const Surfaces s;
  const Json part = profiles_part(path_through({{30, 2}, {50, 2}}), 0.02, s.initial, s.last);
  const std::vector<double> initial = numbers(part["profiles"][1]["curves"]["initial"]["value"]);
  for (int k = -12; k <= 12; ++k)
    EXPECT_EQ(std::isnan(initial[static_cast<std::size_t>(k + 12)]), 2 + k < 0) << k;
}

}  // namespace
}  // namespace sandstroke
