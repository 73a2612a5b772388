#include "sand/map_means.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace sandstroke {
namespace {

HeightGrid random_values(int rows, int cols) {
  std::mt19937 random(3);
  return HeightGrid::NullaryExpr(rows, cols, [&] { return 0.3 + 1e-9 * static_cast<double>(random()); });
}

HeightGrid sums(const HeightGrid& values, int rows, int cols) {
  MapMeans means(static_cast<int>(values.rows()), static_cast<int>(values.cols()), rows, cols);
  for (Eigen::Index row = 0; row < values.rows(); ++row)
    means.add({values.row(row).begin(), values.row(row).end()}, false);
  return means.means();
}

constexpr int cells[][2] = {{1, 1}, {3, 5}, {7, 9}, {10, 15}, {20, 30}, {23, 31}, {60, 90}, {71, 97}};

TEST(MapMeans, RunningMeansAreTheMeans) {
  const HeightGrid values = random_values(20, 30);
  for (const auto& [rows, cols] : cells) {
    const HeightGrid means = running_means(values, rows, cols);
    EXPECT_LT((means - sums(values, rows, cols)).abs().maxCoeff(), 1e-14) << rows;
    EXPECT_NEAR(means.mean() / values.mean(), 1.0, 1e-14) << rows;
  }
  EXPECT_TRUE((running_means(values, 20, 30) == values).all());
  EXPECT_TRUE((running_means(running_means(values, 60, 90), 20, 30) == values).all());  // split, and joined
}

TEST(MapMeans, RunningMeansOfEqualValuesAreTheseToTheBit) {
  for (const double value : {0.1, std::tan(0.5), 1.0 / 3.0, 57.0})
    for (const auto& [rows, cols] : cells)
      ASSERT_TRUE((running_means(HeightGrid::Constant(20, 30, value), rows, cols) == value).all())
          << value << " " << rows;
  // Of two parts, each keeps its own value beside the seam.
  HeightGrid halves = HeightGrid::Constant(21, 30, 0.1);
  halves.rightCols(15).setConstant(0.7);
  const HeightGrid means = running_means(halves, 7, 10);
  EXPECT_TRUE((means.leftCols(5) == 0.1).all() && (means.rightCols(5) == 0.7).all());
}

TEST(MapMeans, RunningMeansOfWhatIsNoNumberAreNone) {
  HeightGrid values = random_values(6, 6);
  values(2, 3) = std::numeric_limits<double>::quiet_NaN();
  const HeightGrid means = running_means(values, 3, 3);
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 3; ++col) EXPECT_EQ(std::isnan(means(row, col)), row == 1 && col == 1);
}

}  // namespace
}  // namespace sandstroke
