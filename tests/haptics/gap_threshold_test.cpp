#include "haptics/gap_threshold.h"

#include <gtest/gtest.h>

#include "haptics/stroke_coverage.h"

namespace sandstroke {
namespace {

Stroke at(double spacing, std::size_t samples) {
  Stroke stroke;
  for (std::size_t i = 0; i < samples; ++i) {
    stroke.time.push_back(spacing * static_cast<double>(i));
    stroke.position.emplace_back(static_cast<double>(i), 0, 0);
  }
  return stroke;
}

TEST(GapThreshold, FollowsTheUsualSpacing) {
  EXPECT_EQ(usual_gap_threshold(at(0.001, 100)), 0.1);
  EXPECT_NEAR(usual_gap_threshold(at(0.02, 100)), 0.1, 1e-9);
  EXPECT_NEAR(usual_gap_threshold(at(0.1, 100)), 0.5, 1e-9);
  EXPECT_NEAR(usual_gap_threshold(at(1.0, 100)), 5.0, 1e-9);
  EXPECT_EQ(usual_gap_threshold({}), 0.1);
  EXPECT_EQ(usual_gap_threshold(at(1.0, 1)), 0.1);
}

TEST(GapThreshold, PausesOfALiftedPenDoNotCount) {
  Stroke stroke = at(0.01, 9);
  for (std::size_t i = 3; i < 9; ++i) stroke.time[i] += static_cast<double>(i / 3);
  stroke.contact = {1, 1, pen_lifts, 1, 1, pen_lifts, 1, 1, 1};
  EXPECT_EQ(usual_gap_threshold(stroke), 0.1);
  Stroke dots = at(2.0, 9);
  dots.contact.assign(9, pen_lifts);
  EXPECT_EQ(usual_gap_threshold(dots), 0.1);
}

TEST(GapThreshold, ALogThatIsCutIntoDashesIsTold) {
  Stroke stroke = at(0.1, 200);
  for (std::size_t i = 0; i < 200; ++i)
    stroke.time[i] += i % 2 == 0 ? 0.001 : 0.0;  // about half are over 0.1 s
  EXPECT_NE(coverage_warning(stroke, "log.h5").find("log.h5: the tool is lifted in 99 of the 199 steps"),
            std::string::npos)
      << coverage_warning(stroke, "log.h5");
  stroke.gap_threshold = usual_gap_threshold(stroke);
  EXPECT_EQ(coverage_warning(stroke, "log.h5"), "");
}

}  // namespace
}  // namespace sandstroke
