// Planes a little flatter and a little steeper than the steepest that rests, in every direction, for each law
// and method. This shows which of a cell's eight slopes a law compares, and with what.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/angle.h"
#include "sand/all_laws.h"
#include "sand/relaxation.h"
#include "sand/steep_tiles.h"

namespace sandstroke {
namespace {

constexpr double plane_cell = 0.003;

/// A plane that rises by `slope` (rise over run) towards `direction` [deg, from +x towards +y].
class PlaneRule : public SurfaceRule {
 public:
  PlaneRule(double slope, double direction)
      : slope_(slope),
        along_x_(slope * std::cos(to_radians(direction))),
        along_y_(slope * std::sin(to_radians(direction))) {}
  void fill(const BedGeometry& bed, const CellRange& cells, double* out,
            std::ptrdiff_t stride) const override {
    for (int row = 0; row < cells.rows(); ++row)
      for (int col = 0; col < cells.cols(); ++col)
        out[row * stride + col] =
            along_x_ * bed.x_of(cells.col_begin + col) + along_y_ * bed.y_of(cells.row_begin + row);
  }
  double steepest(const BedGeometry&, const CellRange&) const override { return slope_; }
  double highest() const override { return 1e9; }

 private:
  double slope_, along_x_, along_y_;
};

struct Rules {
  RelaxationLaw law;
  RelaxationMethod method;
};
class TiltedPlane : public testing::TestWithParam<Rules> {
 protected:
  static RelaxationSettings settings(double talus_angle, double tolerance) {
    RelaxationSettings settings;
    settings.law = GetParam().law;
    settings.method = GetParam().method;
    settings.talus_angle = talus_angle;
    settings.tolerance = tolerance;
    settings.max_passes = 3;
    return settings;
  }

  /// The largest slope that the law compares on a plane of slope 1: the paper's takes those
  /// along rows, columns and diagonals, others the plane's own.
  static double compared(double direction) {
    if (GetParam().law != RelaxationLaw::paper) return 1.0;
    const double x = std::abs(std::cos(to_radians(direction))), y = std::abs(std::sin(to_radians(direction)));
    return std::max({x, y, (x + y) / std::numbers::sqrt2});
  }

  /// Four tiles; no whole groups of cells either way.
  static HeightField plane(double slope, double direction, bool by_rule) {
    HeightField bed(70, 75, plane_cell, std::make_shared<PlaneRule>(slope, direction));
    return by_rule ? std::move(bed) : HeightField(bed.grid(), plane_cell);
  }
};
INSTANTIATE_TEST_SUITE_P(Rules, TiltedPlane,
                         testing::Values(Rules{RelaxationLaw::paper, RelaxationMethod::passes},
                                         Rules{RelaxationLaw::paper, RelaxationMethod::rkl},
                                         Rules{RelaxationLaw::isotropic, RelaxationMethod::passes},
                                         Rules{RelaxationLaw::isotropic, RelaxationMethod::rkl},
                                         Rules{RelaxationLaw::faces, RelaxationMethod::passes},
                                         Rules{RelaxationLaw::faces, RelaxationMethod::rkl}),
                         [](const auto& rules) {
                           return name_of(rules.param.law) +
                                  (rules.param.method == RelaxationMethod::rkl ? "Rkl" : "Passes");
                         });

constexpr double directions[] = {0, 20, 45, 70, 90, 135, 180, 225, 270, 290, 315};

TEST_P(TiltedPlane, RestsUpToTheToleranceAndNoFurther) {
  for (const double direction : directions)
    for (const double talus : {30.0, 12.0})
      for (const double tolerance : {1e-3, 0.05})
        for (const bool by_rule : {false, true}) {
          SCOPED_TRACE(testing::Message() << direction << " deg, talus " << talus << " deg, tolerance "
                                          << tolerance << (by_rule ? ", by rule" : ""));
          for (const double excess : {-tolerance, 0.95 * tolerance, 1.05 * tolerance}) {
            HeightField bed =
                plane((1.0 + excess) * talus_slope(talus) / compared(direction), direction, by_rule);
            const HeightGrid before = bed.grid();
            const RelaxationOutcome outcome =
                make_relaxer(settings(talus, tolerance), plane_cell)->relax(bed);
            if (excess < tolerance) {
              EXPECT_EQ(outcome.passes, 0);
              EXPECT_EQ(outcome.super_steps, 0);
              EXPECT_EQ(outcome.moved_volume, 0.0);
              EXPECT_TRUE(outcome.converged);
              EXPECT_NEAR(outcome.residual, std::max(0.0, excess), 1e-10);
              EXPECT_TRUE((bed.grid() == before).all());
            } else {
              EXPECT_EQ(outcome.passes, 3);
              EXPECT_GT(outcome.moved_volume, 0.0);
              EXPECT_LT(bed.grid().square().sum(), before.square().sum());  // energy
              EXPECT_NEAR(bed.volume(), 0.0, 1e-15);
            }
          }
        }
}

TEST_P(TiltedPlane, SaysHowSteepItIsWhereNothingMayMove) {
  for (const double direction : directions) {
    RelaxationSettings none = settings(30.0, 1e-3);
    none.max_passes = 0;
    HeightField bed = plane(talus_slope(37.0), direction, false);
    const RelaxationOutcome outcome = make_relaxer(none, plane_cell)->relax(bed);
    EXPECT_NEAR(outcome.residual, talus_slope(37.0) * compared(direction) / talus_slope(30.0) - 1.0, 1e-10);
    EXPECT_FALSE(outcome.converged);
  }
}

TEST_P(TiltedPlane, ComesToRestWithinTheTolerance) {
  for (const double direction : {0.0, 45.0, 110.0}) {
    RelaxationSettings to_the_end = settings(30.0, 1e-3);
    to_the_end.max_passes = 100'000;
    HeightField bed(20, 27, plane_cell,
                    std::make_shared<PlaneRule>(talus_slope(31.0) / compared(direction), direction));
    const HeightGrid before = bed.grid();
    const RelaxationOutcome outcome = make_relaxer(to_the_end, plane_cell)->relax(bed);
    EXPECT_GT(outcome.passes, 0);
    EXPECT_TRUE(outcome.converged);
    EXPECT_LE(outcome.residual, 1e-3 * (1.0 + 1e-9));
    EXPECT_NEAR(bed.volume(), before.sum() * plane_cell * plane_cell, 1e-12 * outcome.moved_volume + 1e-20);
    EXPECT_LT(bed.grid().square().sum(), before.square().sum());
  }
}

TEST_P(TiltedPlane, MadeByARuleIsLookedAtWhereItMayMove) {
  // Laws rest for sure where no slope is above tan(talus) / sqrt 2, or by faces above 3/5 of it.
  const double least = GetParam().law == RelaxationLaw::faces ? 0.6 : 1.0 / std::numbers::sqrt2;
  for (const double ratio : {0.95, 1.05}) {
    HeightField bed = plane(ratio * talus_slope(30.0) * least, 45.0, true);
    const RelaxationSettings relaxation = settings(30.0, 1e-3);
    const std::int64_t tiles = ratio > 1.0 ? 4 : 0;
    EXPECT_EQ(tiles_to_relax(bed, relaxation), tiles);
    const RelaxationOutcome outcome = make_relaxer(relaxation, plane_cell)->relax(bed);
    EXPECT_EQ(bed.allocated_tiles(), tiles);
    EXPECT_EQ(outcome.cells_visited, 0);  // it rests, as the look shows
    EXPECT_EQ(outcome.passes, 0);
    EXPECT_TRUE(outcome.converged);
  }
}

}  // namespace
}  // namespace sandstroke
