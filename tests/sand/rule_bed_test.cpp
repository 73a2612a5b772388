// Beds that exist only as a rule: the rule's slopes and heights, and sand that flows on such a bed as if all
// of its tiles existed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "sand/active_sand.h"
#include "sand/all_laws.h"
#include "sand/initial_surface.h"
#include "sand/relaxation.h"

namespace sandstroke {
namespace {

constexpr double rule_cell = 0.002;

SurfaceSettings surface_of(SurfaceKind kind, double radius, double height) {
  SurfaceSettings s;
  s.kind = kind;
  s.radius = radius;
  s.height = height;
  return s;
}

std::vector<SurfaceSettings> all_kinds() {
  using enum SurfaceKind;
  std::vector<SurfaceSettings> kinds;
  for (const SurfaceKind kind : {flat, cylinder, cone, cliff})
    for (const double height : {0.05, -0.05}) kinds.push_back(surface_of(kind, 0.06, height));
  for (const double wavelength : {0.0, 0.03, 0.07}) {
    kinds.push_back(surface_of(noise, 0.0, 0.0));
    kinds.back().wavelength = wavelength;
  }
  kinds.push_back(surface_of(ripples, 0.0, 0.0));
  return kinds;
}

/// Calls body(height, one beside it, their distance [m]) for neighbours in a block of heights.
template <class Body>
void for_neighbours(const HeightGrid& h, const Body& body) {
  for (Eigen::Index r = 0; r < h.rows(); ++r)
    for (Eigen::Index c = 0; c < h.cols(); ++c) {
      if (c + 1 < h.cols()) body(h(r, c), h(r, c + 1), rule_cell);
      if (r + 1 < h.rows()) body(h(r, c), h(r + 1, c), rule_cell);
      if (r + 1 < h.rows() && c + 1 < h.cols()) {
        body(h(r, c), h(r + 1, c + 1), rule_cell * std::numbers::sqrt2);
        body(h(r, c + 1), h(r + 1, c), rule_cell * std::numbers::sqrt2);
      }
    }
}

TEST(SurfaceRule, NothingIsSteeperOrHigherThanItSays) {
  std::mt19937 random(5);
  for (const auto& [rows, cols] : {std::pair(101, 90), std::pair(64, 131)})
    for (const SurfaceSettings& settings : all_kinds()) {
      const HeightField bed = make_surface(settings, rows, cols, rule_cell);
      const HeightGrid heights = bed.grid();
      const SurfaceRule& rule = bed.untouched();
      EXPECT_LE(heights.maxCoeff(), rule.highest() + 1e-9);  // areas are rounded
      for (int i = 0; i < 300; ++i) {
        const auto range = [&](int count) {
          const int a = static_cast<int>(random() % count), most = i % 2 ? count : 6;
          return std::pair(a, std::min(count, a + 1 + static_cast<int>(random() % most)));
        };
        const auto [r0, r1] = range(rows);
        const auto [c0, c1] = range(cols);
        const CellRange cells{r0, r1, c0, c1};
        const HeightGrid block = heights.block(r0, c0, cells.rows(), cells.cols());
        double steepest = 0.0;
        for_neighbours(block, [&](double one, double other, double distance) {
          steepest = std::max(steepest, std::abs(one - other) / distance);
        });
        ASSERT_LE(steepest, rule.steepest(bed, cells) * (1.0 + 1e-9))
            << static_cast<int>(settings.kind) << ", rows " << r0 << " to " << r1 << ", cols " << c0 << " to "
            << c1;
        if (const auto level = rule.level(bed, cells)) {
          EXPECT_TRUE((block == *level).all());
        }
      }
    }
}

TEST(SurfaceRule, IsLevelBesideWhatItDraws) {
  // Far from the rim of a pile and the edge of a cliff nothing can move: that is what a huge bed rests on.
  for (const SurfaceKind kind : {SurfaceKind::cylinder, SurfaceKind::cone}) {
    const HeightField bed = make_surface(surface_of(kind, 20 * rule_cell, 0.05), 200, 200, rule_cell);
    EXPECT_EQ(bed.untouched().level(bed, {0, 200, 0, 78}), 0.0);
    EXPECT_FALSE(bed.untouched().level(bed, {99, 101, 78, 100}).has_value());
  }
  const HeightField cliff = make_surface(surface_of(SurfaceKind::cliff, 0.0, 0.05), 200, 200, rule_cell);
  EXPECT_EQ(cliff.untouched().level(cliff, {0, 200, 0, 99}), 0.05);
  EXPECT_EQ(cliff.untouched().level(cliff, {0, 200, 101, 200}), 0.0);
  EXPECT_FALSE(cliff.untouched().level(cliff, {0, 1, 99, 101}).has_value());
}

bool equal_bits(const HeightGrid& a, const HeightGrid& b) {
  return std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
}

/// Relaxes a bed by rule and one whose tiles all exist. Returns the outcome of both.
RelaxationOutcome relaxed_alike(HeightField& by_rule, const RelaxationSettings& settings) {
  HeightField whole(by_rule.grid(), rule_cell);
  const RelaxationOutcome a = make_relaxer(settings, rule_cell)->relax(by_rule),
                          b = make_relaxer(settings, rule_cell)->relax(whole);
  EXPECT_TRUE(equal_bits(by_rule.grid(), whole.grid()));
  EXPECT_EQ(a.passes, b.passes);
  EXPECT_EQ(a.super_steps, b.super_steps);
  EXPECT_EQ(a.residual, b.residual);
  EXPECT_EQ(a.converged, b.converged);
  EXPECT_EQ(a.moved_volume, b.moved_volume);
  EXPECT_LE(by_rule.allocated_tiles(), whole.allocated_tiles());
  return a;
}

class RuleBed : public testing::TestWithParam<RelaxationLaw> {
 protected:
  static RelaxationSettings settings(RelaxationMethod method) {
    RelaxationSettings settings;
    settings.law = GetParam();
    settings.method = method;
    settings.max_passes = 8;
    return settings;
  }
  static constexpr RelaxationMethod methods[] = {RelaxationMethod::passes, RelaxationMethod::rkl};
};
INSTANTIATE_TEST_SUITE_P(Laws, RuleBed, testing::ValuesIn(all_laws), law_name);

TEST_P(RuleBed, AConeThatIsAllButAsSteepAsTheTalusMovesAsTheReferenceSays) {
  // Cells near the apex may lie steeper than the cone: |g| adds up two drops.
  for (const double ratio : {0.65, 0.75, 0.85, 0.95}) {
    const double radius = 45.3 * rule_cell;
    SurfaceSettings cone = surface_of(SurfaceKind::cone, radius, ratio * talus_slope(30.0) * radius);
    const RelaxationSettings passes = settings(RelaxationMethod::passes);
    HeightField bed = make_surface(cone, 98, 101, rule_cell), by_reference(bed.grid(), rule_cell);
    const HeightGrid start = bed.grid();
    const RelaxationOutcome a = make_relaxer(passes, rule_cell)->relax(bed),
                            b = make_plain_relaxer(passes, rule_cell)->relax(by_reference);
    EXPECT_TRUE(equal_bits(bed.grid(), by_reference.grid())) << ratio;
    EXPECT_EQ(a.passes, b.passes) << ratio;
    EXPECT_EQ(a.converged, b.converged) << ratio;
    if (ratio < 0.7) {
      EXPECT_TRUE(equal_bits(bed.grid(), start));
    }
    for (const RelaxationMethod method : methods) {
      HeightField by_rule = make_surface(cone, 98, 101, rule_cell);
      relaxed_alike(by_rule, settings(method));
    }
  }
}

TEST_P(RuleBed, SandFlowsAcrossABorderOfTilesThatDoNotExistYet) {
  // 192 cells: tiles end 32 cells on either side of the centre, and so does what falls, more or less.
  for (const RelaxationMethod method : methods) {
    for (const double radius : {31.3, 31.6, 32.0, 32.5}) {
      HeightField pile = make_surface(surface_of(SurfaceKind::cylinder, radius * rule_cell, 5 * rule_cell),
                                      192, 192, rule_cell);
      EXPECT_GT(relaxed_alike(pile, settings(method)).passes, 0) << radius;
      HeightField pit = make_surface(surface_of(SurfaceKind::cylinder, radius * rule_cell, -5 * rule_cell),
                                     192, 192, rule_cell);
      EXPECT_GT(relaxed_alike(pit, settings(method)).passes, 0) << radius;
    }
    for (const int cols : {128, 129, 127, 130})  // the edge is on the tiles' border, or a cell beside it
      for (const double height : {4 * rule_cell, -4 * rule_cell}) {
        HeightField cliff = make_surface(surface_of(SurfaceKind::cliff, 0.0, height), 9, cols, rule_cell);
        EXPECT_GT(relaxed_alike(cliff, settings(method)).passes, 0) << cols;
      }
  }
}

/// A step right between two tiles, and level on either side: what it says of a range's slopes is exact.
class StepRule : public SurfaceRule {
 public:
  explicit StepRule(bool along_rows) : along_rows_(along_rows) {}
  void fill(const BedGeometry&, const CellRange& cells, double* out, std::ptrdiff_t stride) const override {
    for (int row = 0; row < cells.rows(); ++row)
      for (int col = 0; col < cells.cols(); ++col) {
        const int at = along_rows_ ? cells.row_begin + row : cells.col_begin + col;
        out[row * stride + col] = at < BedGeometry::tile_side ? height : 0.0;
      }
  }
  double steepest(const BedGeometry&, const CellRange& cells) const override {
    const int begin = along_rows_ ? cells.row_begin : cells.col_begin,
              end = along_rows_ ? cells.row_end : cells.col_end;
    return begin < BedGeometry::tile_side && BedGeometry::tile_side < end ? height / rule_cell : 0.0;
  }
  double highest() const override { return height; }
  static constexpr double height = 3.0 * rule_cell;

 private:
  bool along_rows_;
};

TEST_P(RuleBed, AStepBetweenTwoLevelTilesFalls) {
  for (const RelaxationMethod method : methods)
    for (const bool along_rows : {false, true}) {
      HeightField bed(along_rows ? 128 : 5, along_rows ? 5 : 128, rule_cell,
                      std::make_shared<StepRule>(along_rows));
      EXPECT_GT(relaxed_alike(bed, settings(method)).passes, 0);
    }
}

TEST_P(RuleBed, RipplesAndNoiseMoveWhereTheyAreTooSteep) {
  for (const RelaxationMethod method : methods)
    for (const double ratio : {0.95, 1.05}) {
      SurfaceSettings ripples = surface_of(SurfaceKind::ripples, 0.0, 0.0);
      ripples.wavelength = 50 * rule_cell;
      ripples.amplitude = ratio * talus_slope(30.0) * ripples.wavelength / (2.0 * std::numbers::pi);
      HeightField waves = make_surface(ripples, 20, 140, rule_cell);
      EXPECT_EQ(relaxed_alike(waves, settings(method)).passes > 0, ratio > 1.0);
      SurfaceSettings noise = surface_of(SurfaceKind::noise, 0.0, 0.0);
      noise.wavelength = 9 * rule_cell;
      noise.amplitude = ratio * 0.7 * noise.wavelength * talus_slope(30.0);
      HeightField rough = make_surface(noise, 70, 140, rule_cell);
      relaxed_alike(rough, settings(method));
    }
}

}  // namespace
}  // namespace sandstroke
