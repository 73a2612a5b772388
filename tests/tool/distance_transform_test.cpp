#include "tool/distance_transform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sandstroke {
namespace {

TEST(SignedDistance, IsThatToTheNearestOtherSample) {
  constexpr int rows = 13, cols = 17;
  std::vector<unsigned char> covered(rows * cols);
  for (int i = 0; i < rows * cols; ++i) covered[i] = (i * 7919) % 11 < 8 && i / cols > 1;
  const std::vector<double> found = signed_distance(covered, rows, cols),
                            inside = distance_inside(covered, rows, cols);
  for (int i = 0; i < rows * cols; ++i) {
    double nearest = 1e9;
    for (int j = 0; j < rows * cols; ++j)
      if (covered[j] != covered[i])
        nearest = std::min(nearest, std::hypot(i % cols - j % cols, i / cols - j / cols));
    EXPECT_EQ(inside[i], std::max(found[i], 0.0));
    EXPECT_NEAR(found[i], covered[i] ? nearest - 0.5 : 0.5 - nearest, 1e-6);
  }
}

}  // namespace
}  // namespace sandstroke
