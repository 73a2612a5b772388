#include "haptics/stroke_coverage.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

/// 101 samples, 10 ms apart, and then one at each of these times [s].
Stroke a_second_and_then(const std::vector<double>& times) {
  Stroke stroke;
  for (int i = 0; i <= 100; ++i) stroke.time.push_back(0.01 * i);
  for (const double time : times) stroke.time.push_back(time);
  stroke.position.assign(stroke.size(), Eigen::Vector3d::Zero());
  return stroke;
}

TEST(StrokeCoverage, ATimeThatIsWrongIsToldWithItsPosition) {
  const std::string said = coverage_warning(a_second_and_then({1.5, 1e9}), "hand.h5");
  for (const char* part :
       {"hand.h5", "cover 1 s of 1000000000 s", "999999998.5 s, from 1.5 s to 1000000000 s"})
    EXPECT_NE(said.find(part), std::string::npos) << said;
}

TEST(StrokeCoverage, MillisecondsTakenForSecondsAreTold) {
  Stroke stroke;
  for (int i = 0; i < 1000; ++i) stroke.time.push_back(5.0 * i);
  stroke.position.assign(stroke.size(), Eigen::Vector3d::Zero());
  EXPECT_NE(coverage_warning(stroke, "").find("cover 0 s of 4995 s"), std::string::npos)
      << coverage_warning(stroke, "");
}

TEST(StrokeCoverage, AHandThatRestsIsNothingToTell) {
  EXPECT_EQ(coverage_warning(a_second_and_then({}), ""), "");
  EXPECT_EQ(coverage_warning(a_second_and_then({60.9}), ""), "") << "less than a minute";
  EXPECT_EQ(coverage_warning(a_second_and_then({95.0}), ""), "") << "more than a hundredth is sampled";
  EXPECT_NE(coverage_warning(a_second_and_then({105.0}), ""), "");
  Stroke dots = a_second_and_then({2.0, 3.0, 4.0});
  dots.contact.assign(dots.size(), pen_lifts);
  EXPECT_EQ(coverage_warning(dots, ""), "");
}

TEST(StrokeCoverage, WhatIsPlayedIsWhatLiesOutsideOfGaps) {
  const PlayedPart part = played_part(StrokeSampler(a_second_and_then({1.5, 1.55, 4.0})));
  EXPECT_DOUBLE_EQ(part.played, 1.05);
  EXPECT_EQ(part.whole, 4.0);
  EXPECT_EQ(part.gaps, 2);
  EXPECT_EQ(played_text(part), "plays 1.05 s of 4 s: the tool is lifted in 2 gaps");
}

TEST(StrokeCoverage, WhatAStarvedRecorderLeftIsTold) {
  Stroke stroke = a_second_and_then({1.5});
  stroke.starved = true;
  const std::string said = coverage_warning(stroke, "hand.h5");
  for (const char* part : {"hand.h5", "plays 1 s of 1.5 s: the tool is lifted in 1 gap;", "--check"})
    EXPECT_NE(said.find(part), std::string::npos) << said;
}

TEST(StrokeCoverage, SamplesThatNoLineJoinsAreTold) {
  Stroke corners;
  corners.time = {0.0, 4.0, 8.0, 12.0, 16.0};
  corners.position.assign(5, Eigen::Vector3d::Zero());
  EXPECT_NE(
      coverage_warning(corners, "square.csv").find("5 of its 5 samples are more than 0.1 s from the next"),
      std::string::npos)
      << coverage_warning(corners, "");
  corners.gap_threshold = 4.0;
  EXPECT_EQ(coverage_warning(corners, ""), "");
  corners.gap_threshold = 0.1;
  corners.time = {0.0, 0.05, 8.0, 8.05, 12.0};
  EXPECT_EQ(coverage_warning(corners, ""), "") << "most are joined";
  corners.contact.assign(5, pen_lifts);
  EXPECT_EQ(coverage_warning(corners, ""), "") << "dots of a pen";
}

}  // namespace
}  // namespace sandstroke
