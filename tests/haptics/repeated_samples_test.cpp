#include "haptics/repeated_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sandstroke {
namespace {

using Eigen::Vector3d;

/// The position of a hand at a time [s]: it goes along x at 1 m/s, rests from 1 to 2 s, and goes on.
Vector3d pausing_hand(double t) { return {t < 1.0 ? t : std::max(1.0, t - 1.0), 0.0, 0.0}; }

/// The same hand for 3 s, read at 200 Hz from a device that measures every `period` seconds.
Stroke read_at_200_hz(double period) {
  Stroke stroke;
  for (int i = 0; i <= 600; ++i) {
    const double t = 0.005 * i;
    stroke.time.push_back(t);
    stroke.position.push_back(pausing_hand(period * std::floor(t / period + 1e-9)));
  }
  return stroke;
}

double fastest_step(const Stroke& stroke) {
  double top = 0.0;
  for (std::size_t i = 0; i + 1 < stroke.size(); ++i)
    top = std::max(
        top, (stroke.position[i + 1] - stroke.position[i]).norm() / (stroke.time[i + 1] - stroke.time[i]));
  return top;
}

TEST(RepeatedSamples, AreDroppedSoThatTheHandIsAsFastAsItWas) {
  for (const double period : {0.01, 0.015, 0.0167}) {
    const Stroke stroke = read_at_200_hz(period), thinned = without_repeated_samples(stroke);
    EXPECT_GT(fastest_step(stroke), 1.9) << period;
    EXPECT_LT(fastest_step(thinned), 1.7) << period;  // times are those of reading: up to 5 ms late
    EXPECT_EQ(thinned.time.back(), stroke.time.back());
    for (std::size_t i = 0; i + 1 < thinned.size(); ++i)
      EXPECT_LE(thinned.time[i + 1] - thinned.time[i], stroke.gap_threshold);
    // The rest is still one: its samples are where the hand rested.
    const auto resting = std::count_if(thinned.position.begin(), thinned.position.end(),
                                       [](const Vector3d& p) { return std::abs(p.x() - 1.0) < 0.02; });
    EXPECT_GT(resting, 40) << period;
  }
  EXPECT_NEAR(fastest_step(without_repeated_samples(read_at_200_hz(0.015))), 1.0, 1e-9);
}

TEST(RepeatedSamples, AreCounted) {
  const Repeats repeats = repeats_of(read_at_200_hz(0.015));
  EXPECT_EQ(repeats.period, 3u);
  EXPECT_NEAR(repeats.fraction, 1.0 - 2.0 / 3.0 / 3.0, 0.01);  // one in three in motion, none at rest
  EXPECT_EQ(repeats_of(read_at_200_hz(0.005)).period, 1u);
}

TEST(RepeatedSamples, ARestOfADeviceThatRepeatsNothingStays) {
  const Stroke stroke = read_at_200_hz(0.005);
  EXPECT_EQ(without_repeated_samples(stroke).time, stroke.time);
}

TEST(RepeatedSamples, AllColumnsAndPenStatesGoWithThem) {
  Stroke stroke;
  for (int i = 0; i < 12; ++i) {
    stroke.time.push_back(0.01 * i);
    stroke.position.emplace_back(i / 3, 0, 0);
    stroke.velocity.emplace_back(i, 0, 0);
    stroke.force.emplace_back(0, i, 0);
    stroke.switches.push_back(static_cast<std::uint32_t>(i));
    stroke.flags.push_back(static_cast<std::uint32_t>(i));
    stroke.contact.push_back(i == 4 ? pen_lifts : pen_down);
  }
  const Stroke thinned = without_repeated_samples(stroke);
  const std::vector<std::uint32_t> kept = {0, 3, 4, 5, 6, 9, 11};
  EXPECT_EQ(thinned.switches, kept);
  EXPECT_EQ(thinned.flags, kept);
  ASSERT_EQ(thinned.size(), kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_EQ(thinned.time[i], stroke.time[kept[i]]);
    EXPECT_EQ(thinned.velocity[i], stroke.velocity[kept[i]]);
    EXPECT_EQ(thinned.force[i], stroke.force[kept[i]]);
    EXPECT_EQ(thinned.contact[i], stroke.contact[kept[i]]);
  }
}

TEST(RepeatedSamples, NothingIsTornApart) {
  Stroke stroke = read_at_200_hz(0.06);
  stroke.gap_threshold = 0.02;
  const Stroke thinned = without_repeated_samples(stroke);
  EXPECT_LT(thinned.size(), stroke.size() / 2);
  for (std::size_t i = 0; i + 1 < thinned.size(); ++i) EXPECT_TRUE(thinned.joined(i));
}

TEST(RepeatedSamples, AreLeftOutOfEveryColumn) {
  Stroke stroke = read_at_200_hz(0.01);
  const std::size_t count = stroke.size();
  stroke.velocity.assign(count, Vector3d::Zero());
  stroke.force.assign(count, Vector3d::Zero());
  stroke.orientation.assign(count, Eigen::Vector4d::UnitW());
  stroke.pressure.assign(count, 0.5);
  stroke.switches.assign(count, 0);
  stroke.flags.assign(count, 0);
  stroke.contact.assign(count, pen_down);
  const Stroke thinned = without_repeated_samples(stroke);
  EXPECT_LT(thinned.size(), count);
  visit_columns(thinned, [&](const char* name, const auto& column) {
    EXPECT_EQ(column.size(), thinned.size()) << name;
  });
  EXPECT_NO_THROW(check_stroke(thinned, "thinned"));
}

}  // namespace
}  // namespace sandstroke
