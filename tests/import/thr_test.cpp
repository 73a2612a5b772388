#include "import/thr.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "complaint.h"

namespace sandstroke {
namespace {

using std::numbers::pi;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

SampleTable thr_table(const std::string& text) { return parse_thr(text, "track.thr"); }

TEST(Thr, ThetaTurnsClockwiseFromTheYAxis) {
  const SampleTable table = thr_table("0 1\n0 0\n1.5707963267948966 0\n1.5707963267948966 0.5\n");
  EXPECT_EQ(column(table, "x").unit, "radius");
  EXPECT_DOUBLE_EQ(table.columns[0].values.front(), 0.0);
  EXPECT_DOUBLE_EQ(table.columns[1].values.front(), 1.0);
  EXPECT_DOUBLE_EQ(table.columns[0].values.back(), 0.5);
  EXPECT_NEAR(table.columns[1].values.back(), 0.0, 1e-16);
  EXPECT_THAT(table.description, HasSubstr("theta grows clockwise from the top"));
}

TEST(Thr, TurningAtTheCentreAndStandingGiveNoPoints) {
  const SampleTable table = thr_table("0 0\n6.28 0\n6.28 0\n6.28 1\n6.28 1\n");
  EXPECT_EQ(table.size(), 2u);
  EXPECT_THAT(table.lines, ElementsAre(1u, 4u));
}

/// rho = theta / (2 pi turns), from the centre to the rim.
TEST(Thr, OneLineIsAnArchimedeanSpiral) {
  for (const double turns : {0.1, 1.0, -20.0}) {
    const SampleTable table = thr_table(fmt::format("0 0\n{} 1\n", 2.0 * pi * turns));
    // Each point lies on the spiral, and none of the lines between them leaves it by more than the tolerance.
    const double angle = std::abs(2.0 * pi * turns), a = 1.0 / angle;
    const std::vector<double>&x = column(table, "x").values, &y = column(table, "y").values;
    for (std::size_t i = 0; i < table.size(); ++i) {
      const double theta = 2.0 * pi * turns * static_cast<double>(i) / static_cast<double>(table.size() - 1);
      const double rho = a * std::abs(theta);
      EXPECT_NEAR(x[i], rho * std::sin(theta), 1e-12);
      EXPECT_NEAR(y[i], rho * std::cos(theta), 1e-12);
      if (i == 0) continue;
      const double half = theta - pi * turns / static_cast<double>(table.size() - 1);
      const double off = std::hypot(0.5 * (x[i] + x[i - 1]) - a * std::abs(half) * std::sin(half),
                                    0.5 * (y[i] + y[i - 1]) - a * std::abs(half) * std::cos(half));
      EXPECT_LE(off, thr_tolerance);
    }
    const double length = 0.5 * a * (angle * std::sqrt(1.0 + angle * angle) + std::asinh(angle));
    EXPECT_NEAR(path_length(table), length, 1e-4 * length);
    EXPECT_LE(path_length(table), length);
    EXPECT_LE(static_cast<double>(table.size()),
              2.0 + std::sqrt((angle * angle + 2.0 * angle) / (8.0 * thr_tolerance)));
  }
}

TEST(Thr, CommentsBlanksAndByteOrderMarksArePassedOver) {
  const SampleTable table = thr_table("\xEF\xBB\xBF# rose\r\n\r\n  0.0\t+0.25 # start\r\n// end\n0,1");
  EXPECT_EQ(table.size(), 2u);
  EXPECT_THAT(table.lines, ElementsAre(3u, 5u));
  EXPECT_THAT(column(table, "y").values, ElementsAre(0.25, 1.0));
  EXPECT_THAT(table.description, HasSubstr("2 points"));
}

TEST(Thr, SaysWhatIsWrong) {
  EXPECT_THAT(complaint_of([] { thr_table("0 0\n1 0.5 2\n"); }),
              AllOf(HasSubstr("track.thr:2"), HasSubstr("theta and rho")));
  EXPECT_THAT(complaint_of([] { thr_table("0 nan\n"); }), HasSubstr("track.thr:1"));
  EXPECT_THAT(complaint_of([] { thr_table("0\n"); }), HasSubstr("track.thr:1"));
  EXPECT_THAT(complaint_of([] { thr_table("0 250\n"); }), HasSubstr("divide all rho"));
  EXPECT_THAT(complaint_of([] { thr_table("# nothing\n"); }), HasSubstr("no points"));
  EXPECT_THAT(complaint_of([] { thr_table("0 0\n1e9 1\n"); }), HasSubstr("more than 5e+06 points"));
  EXPECT_THAT(complaint_of([] { thr_table("0 0\n1e300 1\n"); }), HasSubstr("more than 5e+06 points"));
}

}  // namespace
}  // namespace sandstroke
