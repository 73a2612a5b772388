// Beds that no one would draw: relaxation ends, conserves, stays in range, and is at rest in the end.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sand/relaxation.h"

namespace sandstroke {
namespace {

enum class Bed { checkerboard, spike, step, noise, at_talus_angle };

HeightGrid heights_of(Bed kind, int rows, int cols, double height, double dx, double talus_angle) {
  HeightGrid heights = HeightGrid::Zero(rows, cols);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-height, height);
  const double rise = dx * std::tan(talus_angle * std::acos(-1.0) / 180.0);
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < cols; ++col) {
      double& h = heights(row, col);
      if (kind == Bed::checkerboard) h = (row + col) % 2 ? height : -height;
      if (kind == Bed::spike) h = row == rows / 2 && col == cols / 2 ? height : 0.0;
      if (kind == Bed::step) h = col < cols / 2 ? height : 0.0;
      if (kind == Bed::noise) h = any(random);
      if (kind == Bed::at_talus_angle) h = col * rise;  // exact ties
    }
  return heights;
}

struct Method {
  RelaxationLaw law;
  RelaxationMethod method;
};

class Extremes : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, Extremes,
                         testing::Values(Method{RelaxationLaw::paper, RelaxationMethod::passes},
                                         Method{RelaxationLaw::isotropic, RelaxationMethod::passes},
                                         Method{RelaxationLaw::paper, RelaxationMethod::rkl},
                                         Method{RelaxationLaw::isotropic, RelaxationMethod::rkl}),
                         [](const auto& one) {
                           return std::string(one.param.law == RelaxationLaw::paper ? "paper" : "isotropic") +
                                  (one.param.method == RelaxationMethod::rkl ? "_rkl" : "_passes");
                         });

TEST_P(Extremes, EndConserveAndStayInRange) {
  const bool monotone =
      GetParam().law == RelaxationLaw::isotropic || GetParam().method == RelaxationMethod::rkl;
  for (const double talus_angle : {1.0, 30.0, 89.0})
    for (const double dx : {1e-6, 1.0, 1e3})
      for (const double height : {1e-310, 1e-12, 1e-3, 1.0, 1e3, 1e6})
        for (const auto& [rows, cols] :
             {std::pair(1, 1), std::pair(1, 50), std::pair(33, 31), std::pair(66, 66)})
          for (const Bed kind : {Bed::checkerboard, Bed::spike, Bed::step, Bed::noise, Bed::at_talus_angle}) {
            if (height / dx > 1e3) continue;  // towers of more cells than they have room to fall
            SCOPED_TRACE(testing::Message()
                         << "talus " << talus_angle << ", cells of " << dx << " m, height " << height
                         << " m, " << rows << " x " << cols << ", bed " << static_cast<int>(kind));
            const HeightGrid start = heights_of(kind, rows, cols, height, dx, talus_angle);
            HeightField bed(start, dx);
            const double before = bed.volume();
            RelaxationSettings settings;
            settings.law = GetParam().law;
            settings.method = GetParam().method;
            settings.talus_angle = talus_angle;
            const RelaxationOutcome outcome = make_relaxer(settings, dx)->relax(bed);
            const HeightGrid end = bed.grid();
            const double low = start.minCoeff(), high = start.maxCoeff(),
                         size = std::max(std::abs(low), std::abs(high));
            ASSERT_TRUE(outcome.converged);
            ASSERT_TRUE(end.isFinite().all());
            ASSERT_NEAR(bed.volume(), before,
                        1e-12 * outcome.moved_volume +
                            1e-14 * size * bed.cell_area() * static_cast<double>(end.size()));
            if (monotone) {
              ASSERT_GE(end.minCoeff(), low - 1e-12 * size);
              ASSERT_LE(end.maxCoeff(), high + 1e-12 * size);
            }
          }
}

}  // namespace
}  // namespace sandstroke
