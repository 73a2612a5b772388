#include "import/redundancy.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "sample_tables.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;

/// A circle of 0.1 m at 100 Hz in 6.28 s, with its velocity.
Stroke circle() {
  Stroke stroke;
  for (int i = 0; i <= 628; ++i) {
    const double t = 0.01 * i;
    stroke.time.push_back(t);
    stroke.position.emplace_back(0.1 * std::cos(t), 0.1 * std::sin(t), 1e-5 * std::sin(50.0 * i));
    stroke.velocity.emplace_back(-0.1 * std::sin(t), 0.1 * std::cos(t), 0.0);
  }
  return stroke;
}

std::string velocity_sentence(const Stroke& stroke) {
  return velocity_disagreement(stroke, {"x", "y", "z"}, {"vx", "vy", "vz"});
}

TEST(Redundancy, AVelocityThatFitsIsQuiet) {
  EXPECT_EQ(velocity_sentence(circle()), "");
  Stroke noisy = circle();
  for (std::size_t i = 0; i < noisy.size(); ++i)
    noisy.velocity[i] += Vector3d(0.1, -0.1, 0.1) * std::sin(7.0 * static_cast<double>(i * i));
  EXPECT_EQ(velocity_sentence(noisy), "");
  Stroke still = circle();
  still.position.assign(still.size(), Vector3d::Zero());
  EXPECT_EQ(velocity_sentence(still), "") << "there is nothing to compare";
}

TEST(Redundancy, AVelocityInAWrongUnitIsToldWithBothColumns) {
  for (const double factor : {1e-3, 1e3}) {
    Stroke stroke = circle();
    for (Vector3d& velocity : stroke.velocity) velocity *= factor;
    EXPECT_THAT(velocity_sentence(stroke),
                AllOf(HasSubstr(fmt::format("velocity vx, vy, vz is {:.4g} times", factor)),
                      HasSubstr("position x, y, z")));
  }
}

TEST(Redundancy, AVelocityWithAWrongAxisIsTold) {
  Stroke turned = circle(), swapped = circle();
  for (Vector3d& velocity : turned.velocity) velocity.y() *= -1.0;
  EXPECT_THAT(velocity_sentence(turned), HasSubstr("velocity vy goes against the motion of position y"));
  for (Vector3d& velocity : swapped.velocity) std::swap(velocity.x(), velocity.y());
  EXPECT_THAT(velocity_sentence(swapped), HasSubstr("velocity vx does not go with the motion of position x"));
}

SampleColumn counted(std::vector<double> values) { return {"count", "", std::move(values)}; }

TEST(Redundancy, TimesAreComparedWithWhatReplacesThem) {
  const SampleColumn times = counted({0, 4, nan_value, 8});
  EXPECT_EQ(time_disagreement(times, "s", 7.9, "a rate", 1.05), "");
  EXPECT_THAT(time_disagreement(times, "s", 1.6, "a rate", 1.05),
              HasSubstr("column count last 8 s, but a rate makes 1.6 s"));
  EXPECT_THAT(time_disagreement(times, "ms", 8.0, "a rate", 1.05), HasSubstr("last 0.008 s"));
  EXPECT_EQ(time_disagreement(times, "", 0.008, "a rate", 1.05), "") << "ms, perhaps";
  EXPECT_THAT(time_disagreement(times, "", 1.6, "a rate", 1.05), HasSubstr("in s, ms, us and ns differs"));
  EXPECT_EQ(time_disagreement(counted({nan_value, 1}), "s", 1.0, "a rate", 1.05), "");
}

TEST(Redundancy, LostSamplesAreSeenInTheirNumbers) {
  EXPECT_EQ(number_disagreement(counted({5, 6, 7, 8}), {0, 0.1, 0.2, 0.3}), "");
  EXPECT_EQ(number_disagreement(counted({5, 6, 17, 18}), {0, 0.1, 1.2, 1.3}), "") << "the times know it";
  EXPECT_THAT(number_disagreement(counted({5, 6, 17, 18}), {0, 0.1, 0.2, 0.3}),
              AllOf(HasSubstr("column count skips numbers"), HasSubstr("last 1.1 s"), HasSubstr("by 0.1 s")));
  EXPECT_EQ(number_disagreement(counted({5, 7, 9, 11}), {0, 0.1, 0.2, 0.3}), "") << "every other sample";
  EXPECT_EQ(number_disagreement(counted({5, 6, 6, 9}), {0, 0.1, 0.2, 0.3}), "") << "no numbers of samples";
  EXPECT_EQ(number_disagreement(counted({0.5, 1.5, 9.5, 10.5}), {0, 0.1, 0.2, 0.3}), "");
}

TEST(Redundancy, ATeleportIsFound) {
  Stroke stroke = circle();
  EXPECT_TRUE(jumps_of(stroke).empty());
  stroke.position[100] += Vector3d(0.1, 0, 0);  // one wrong sample
  const std::vector<Jump> jumps = jumps_of(stroke);
  ASSERT_EQ(jumps.size(), 2u);
  EXPECT_EQ(jumps[0].sample, 100u);
  EXPECT_NEAR(jumps[0].time, 0.01, 1e-9);
  EXPECT_NEAR(jumps[0].distance, 0.1, 2e-3);
  EXPECT_GT(jumps[0].ratio, 20.0);
  stroke.contact.assign(stroke.size(), pen_down);
  stroke.contact[99] = stroke.contact[100] = pen_lifts;
  EXPECT_TRUE(jumps_of(stroke).empty()) << "the pen is lifted there";
}

TEST(Redundancy, ATeleportIsFoundInAShortStroke) {
  for (int size = 5; size < 30; ++size)
    for (int wrong = 0; wrong < size; ++wrong) {
      Stroke stroke;
      for (int i = 0; i < size; ++i) {
        stroke.time.push_back(0.01 * i);
        stroke.position.emplace_back(0.001 * i, 0.0005 * i * i, 0.0);
      }
      EXPECT_TRUE(jumps_of(stroke).empty()) << size;
      stroke.position[static_cast<std::size_t>(wrong)] = Vector3d(-9.999, -9.999, 0.0);
      const std::vector<Jump> jumps = jumps_of(stroke);
      ASSERT_EQ(jumps.size(), wrong == 0 || wrong + 1 == size ? 1u : 2u) << wrong << " of " << size;
      EXPECT_EQ(jumps[0].sample, static_cast<std::size_t>(std::max(wrong, 1)));
    }
}

TEST(Redundancy, SamplesThatStandAloneAreFoundHoweverManyTheyAre) {
  for (const int size : {21, 24, 40, 100, 400})
    for (const int every : {9, 16, 37}) {
      Stroke stroke;
      std::size_t wrong = 0;
      for (int i = 0; i < size; ++i) {
        stroke.time.push_back(0.01 * i);
        const bool is_wrong = i % every == every / 2 && i + 1 < size;
        wrong += is_wrong;
        stroke.position.push_back(is_wrong
                                      ? Vector3d(-9.999, -9.999, 0.0)
                                      : Vector3d(0.05 * std::cos(0.1 * i), 0.05 * std::sin(0.1 * i), 0.0));
      }
      EXPECT_EQ(jumps_of(stroke).size(), 2 * wrong) << size << " samples, every " << every;
    }
  Stroke taps;  // there and back in three samples each: fast, but no sample stands alone
  for (int i = 0; i < 200; ++i) {
    taps.time.push_back(0.01 * i);
    const int phase = i % 40;
    taps.position.emplace_back(0.0001 * i, phase > 6 ? 0.0 : 0.02 * (phase < 3 ? phase : 6 - phase), 0.0);
  }
  EXPECT_TRUE(jumps_of(taps).empty());
}

TEST(Redundancy, TheSentencesNameTheFileAndTheLine) {
  SampleColumn t{"t", "s", {}}, x{"x", "m", {}}, y{"y", "m", {}}, v{"vx", "mm/s", {}}, w{"vy", "mm/s", {}};
  for (int i = 0; i < 200; ++i) {
    t.values.push_back(0.04 * i);
    x.values.push_back(0.001 * i + (i >= 50 ? 0.5 : 0.0));
    y.values.push_back(0.0);
    v.values.push_back(25e3);  // 25 mm/s in um/s
    w.values.push_back(0.0);
  }
  const SampleTable table = table_of({t, x, y, v, w});
  const ImportedStroke made = stroke_of_table(table, {}, "in.csv");
  EXPECT_EQ(warnings_with(made, "in.csv: velocity vx, vy is 1000 times the speed of position x, y"), 1);
  EXPECT_EQ(warnings_with(made, "in.csv:52: the tip jumps by 0.501 m in 0.04 s"), 1);
  TableSettings at_rate;
  at_rate.rate = 125.0;
  EXPECT_EQ(warnings_with(stroke_of_table(table, at_rate, "in.csv"),
                          "in.csv: the times in column t last 7.96 s, but stroke.table.rate (stroke convert: "
                          "--rate) of 125 Hz makes 1.592 s"),
            1);
  TableSettings at_speed;
  at_speed.speed = 1.0;
  EXPECT_EQ(warnings_with(stroke_of_table(table, at_speed, "in.csv"), "--speed) of 1 m/s makes 0.699 s"), 1);
}

/// Line 40 is the wrong sample, whatever is left out before it.
TEST(Redundancy, AJumpIsInItsLineAfterOthersAreDropped) {
  SampleColumn t{"t", "s", {}}, x{"x", "m", {}}, y{"y", "m", {}};
  for (int i = 0; i < 60; ++i) {
    t.values.push_back(0.04 * (i < 10 ? i / 2 : i));
    x.values.push_back(i == 38 ? 5.0 : 0.001 * i);
    y.values.push_back(i == 20 ? nan_value : 0.0);
  }
  TableSettings drop;
  drop.equal_times = EqualTimes::drop;
  EXPECT_EQ(warnings_with(stroke_of_table(table_of({t, x, y}), drop, "in.csv"), "in.csv:40: the tip jumps"),
            1);
}

}  // namespace
}  // namespace sandstroke
