#include "measure/force_agreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace sandstroke {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A force that turns and grows; `late` ticks of 1 ms late, and so many times as large.
Eigen::Vector3d spiral(int tick, int late = 0, double scale = 1.0) {
  const double t = 0.01 * (tick - late);
  return scale * t * Eigen::Vector3d(std::cos(t), std::sin(t), 0.3 * std::cos(3.0 * t));
}

TEST(ForceAgreement, IsNoneWithoutARecordedForce) {
  EXPECT_FALSE(force_agreement({}));
  EXPECT_FALSE(force_agreement({{0.0, {1.0, 0.0, 0.0}, {unknown, unknown, unknown}}}));
}

TEST(ForceAgreement, IsOfTheTicksThatHaveBoth) {
  const std::optional<ForceAgreement> found =
      force_agreement({{0.0, {0.0, 0.0, 0.0}, {3.0, 0.0, 4.0}},
                       {1.0, {9.0, 0.0, 0.0}, {unknown, unknown, unknown}},
                       {2.0, {0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->ticks, 2);
  EXPECT_EQ(found->max, 5.0);
  EXPECT_DOUBLE_EQ(found->rms, 5.0 / std::sqrt(2.0));
}

TEST(ForceAgreement, CorrelationIsOfShapeAndNotOfSizeOrOffset) {
  const Eigen::Vector3d offset(0.5, -1.0, 2.0);
  std::vector<ForcePair> alike, opposite, still;
  for (int k = 0; k < 300; ++k) {
    alike.push_back({1e-3 * k, spiral(k, 0, 2.0) + offset, spiral(k)});
    opposite.push_back({1e-3 * k, spiral(k, 0, -0.7) + offset, spiral(k)});
    still.push_back({1e-3 * k, offset, spiral(k)});
  }
  EXPECT_NEAR(force_agreement(alike)->correlation, 1.0, 1e-12);
  EXPECT_EQ(force_agreement(alike)->lag, 0.0);
  EXPECT_NEAR(force_agreement(opposite)->correlation, -1.0, 1e-12);
  EXPECT_TRUE(std::isnan(force_agreement(still)->correlation));
}

TEST(ForceAgreement, FindsByWhatTheRunComesLater) {
  for (const int late : {-40, -1, 0, 7, 120}) {
    std::vector<ForcePair> ticks;
    for (int k = 0; k < 1000; ++k) ticks.push_back({1e-3 * k, spiral(k, late), spiral(k)});
    const std::optional<ForceAgreement> found = force_agreement(ticks);
    EXPECT_NEAR(found->lag, 1e-3 * late, 1e-12);
    EXPECT_NEAR(found->best_correlation, 1.0, 1e-12);
  }
}

TEST(ForceAgreement, FindsALagInALongTrace) {
  std::vector<ForcePair> ticks;
  for (int k = 0; k < 300'000; ++k) ticks.push_back({1e-3 * k, spiral(k, 23), spiral(k)});
  EXPECT_NEAR(force_agreement(ticks)->lag, 23e-3, 1e-12);
  EXPECT_NEAR(force_agreement(ticks)->best_correlation, 1.0, 1e-9);
}

TEST(ForceAgreement, HasNoLagWhereTheyAgreeEverBetterFurtherApart) {
  std::vector<ForcePair> ticks;  // 1.25 s apart, of a period of 5 s
  for (int k = 0; k < 3000; ++k) {
    const double phase = 1e-3 * k * 2.0 * std::numbers::pi / 5.0;
    ticks.push_back({1e-3 * k, {std::cos(phase), 0.0, 0.0}, {std::sin(phase), 0.0, 0.0}});
  }
  const std::optional<ForceAgreement> found = force_agreement(ticks);
  EXPECT_EQ(found->lag, 0.0);
  EXPECT_EQ(found->best_correlation, found->correlation);
}

TEST(ForceAgreement, DoesNotPairAcrossTicksThatAreLeftOut) {
  std::vector<ForcePair> ticks;  // 3 ms late, in two parts 10 s apart
  for (int part = 0; part < 2; ++part)
    for (int k = 0; k < 300; ++k) ticks.push_back({10.0 * part + 1e-3 * k, spiral(k, 3), spiral(k)});
  EXPECT_NEAR(force_agreement(ticks)->lag, 3e-3, 1e-12);
  EXPECT_NEAR(force_agreement(ticks)->best_correlation, 1.0, 1e-12);
}

}  // namespace
}  // namespace sandstroke
