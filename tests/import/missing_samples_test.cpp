#include "import/missing_samples.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include "complaint.h"
#include "import/merge_strokes.h"
#include "sample_tables.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

ImportedStroke at_10_hz(std::vector<SampleColumn> columns, TableSettings settings = {}) {
  settings.rate = 10.0;
  return stroke_of_table(table_of(std::move(columns)), settings, "in.csv");
}

TEST(MissingSamples, AreGapsInTimeThatTheClockCounts) {
  const ImportedStroke made = at_10_hz(
      {{"x", "m", {1, 2, nan_value, nan_value, 5, nan_value, 7}}, {"y", "m", {0, 0, nan_value, 0, 0, 0, 0}}});
  const Stroke& stroke = made.stroke;
  ASSERT_EQ(stroke.size(), 4u);
  const double times[] = {0.0, 0.1, 0.4, 0.6}, x[] = {1, 2, 5, 7};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(stroke.time[i], times[i], 1e-9);
    EXPECT_EQ(stroke.position[i], Vector3d(x[i], 0, 0));
  }
  EXPECT_THAT(stroke.contact, ElementsAre(pen_down, pen_lifts, pen_lifts, pen_down));
  EXPECT_THAT(made.warnings, ElementsAre("in.csv: 3 samples without a value in x, y left out in 2 gaps, "
                                         "where the tool lifts; the first is in.csv:4"));
}

TEST(MissingSamples, AtTheEndsLiftNothing) {
  const ImportedStroke made = at_10_hz({{"x", "m", {nan_value, 2, 3, nan_value}}, {"y", "m", {0, 0, 0, 0}}});
  EXPECT_THAT(made.stroke.contact, ElementsAre());
  EXPECT_NEAR(made.stroke.time[0], 0.1, 1e-9);
  EXPECT_EQ(warnings_with(made, "2 samples without a value in x left out in 2 gaps"), 1);
}

TEST(MissingSamples, OfColumnsThatAreNotUsedDoNotMatter) {
  const ImportedStroke made = at_10_hz({{"x", "m", {1, 2}},
                                        {"y", "m", {0, 0}},
                                        {"fx", "", {nan_value, 1}},  // without a unit
                                        {"fy", "", {0, 0}},
                                        {"note", "", {nan_value, nan_value}}});
  EXPECT_EQ(made.stroke.size(), 2u);
  EXPECT_THAT(made.stroke.contact, ElementsAre());
  EXPECT_EQ(warnings_with(made, "without a value"), 0);
}

TEST(MissingSamples, WithoutATimeAreLeftOut) {
  const ImportedStroke made = stroke_of_table(
      table_of({{"t", "s", {0, nan_value, 0.02, 0.03}}, {"x", "m", {0, 1, 2, 3}}, {"y", "m", {0, 0, 0, 0}}}),
      {}, "in.csv");
  EXPECT_THAT(made.stroke.time, ElementsAre(0.0, 0.02, 0.03));
  EXPECT_THAT(made.stroke.contact, ElementsAre(pen_lifts, pen_down, pen_down));
  EXPECT_EQ(warnings_with(made, "1 sample without a value in t left out in 1 gap"), 1);
}

TEST(MissingSamples, CountWhereEqualTimesAreSpread) {
  TableSettings settings;
  settings.equal_times = EqualTimes::spread;
  const ImportedStroke made = stroke_of_table(table_of({{"t", "ms", {0, 0, 0, 0, nan_value, 80}},
                                                        {"x", "m", {0, nan_value, 2, 3, 4, 5}},
                                                        {"y", "m", {0, 0, 0, 0, 0, 0}}}),
                                              settings, "in.csv");
  ASSERT_EQ(made.stroke.size(), 4u);
  const double times[] = {0.0, 0.04, 0.06, 0.08};  // four in 80 ms, the second without a position
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(made.stroke.time[i], times[i], 1e-9);
  EXPECT_THAT(made.stroke.contact, ElementsAre(pen_lifts, pen_down, pen_lifts, pen_down));
}

TEST(MissingSamples, WhoseTimeComesAgainMakeWayForTheOneWithAPosition) {
  TableSettings settings;
  settings.equal_times = EqualTimes::drop;
  const Stroke stroke = stroke_of_table(table_of({{"t", "s", {0, 0.01, 0.01, 0.02}},
                                                  {"x", "m", {0, nan_value, 2, 3}},
                                                  {"y", "m", {0, 0, 0, 0}}}),
                                        settings, "in.csv")
                            .stroke;
  EXPECT_THAT(stroke.time, ElementsAre(0.0, 0.01, 0.02));
  EXPECT_EQ(stroke.position[1].x(), 2.0);
}

TEST(MissingSamples, AreNoWayOfATipWithASpeed) {
  TableSettings settings;
  settings.speed = 0.5;
  const Stroke stroke =
      stroke_of_table(table_of({{"x", "m", {0, 1, nan_value, 3}}, {"y", "m", {0, 0, 0, 0}}}), settings,
                      "in.csv")
          .stroke;
  ASSERT_EQ(stroke.size(), 3u);
  EXPECT_NEAR(stroke.time[1], 2.0, 1e-9);
  EXPECT_FALSE(stroke.joined(1));
}

TEST(MissingSamples, AreRefusedWithTheirLineIfThatIsAsked) {
  TableSettings settings;
  settings.missing = Missing::error;
  const auto refusal = [&](std::vector<SampleColumn> columns) {
    return complaint_of([&] { at_10_hz(std::move(columns), settings); });
  };
  EXPECT_THAT(refusal({{"x", "m", {1, 2, 3}}, {"y", "m", {0, 0, nan_value}}}),
              AllOf(HasSubstr("in.csv:4: column 'y' has no value"), HasSubstr("--missing) to gap")));
  EXPECT_THAT(
      refusal({{"x", "m", {1, 2}}, {"y", "m", {0, 0}}, {"fx", "N", {1, nan_value}}, {"fy", "N", {0, 0}}}),
      HasSubstr("in.csv:3: column 'fx' has no value"));
  EXPECT_EQ(refusal({{"x", "m", {1, 2}}, {"y", "m", {0, 0}}, {"note", "", {1, nan_value}}}), "");
}

TEST(MissingSamples, OfAllSamplesAreRefused) {
  EXPECT_THAT(complaint_of([] {
                at_10_hz({{"x", "m", {1, 2}}, {"y", "m", {nan_value, nan_value}}});
              }),
              HasSubstr("in.csv: column 'y' has no value in any sample"));
  EXPECT_THAT(complaint_of([] {
                at_10_hz({{"x", "m", {1, nan_value}}, {"y", "m", {nan_value, 2}}});
              }),
              HasSubstr("in.csv: no sample has a value in each column"));
}

TEST(MissingSamples, OfAForceThatNobodyNamedLeaveTheForceOut) {
  const std::vector<SampleColumn> columns = {{"x", "m", {1, 2, 3}},
                                             {"y", "m", {0, nan_value, 0}},
                                             {"fx", "N", {1, nan_value, nan_value}},
                                             {"fy", "N", {0, nan_value, 0}}};
  const ImportedStroke found = at_10_hz(columns);
  EXPECT_EQ(found.stroke.size(), 2u);
  EXPECT_TRUE(found.stroke.force.empty());
  EXPECT_EQ(warnings_with(found,
                          "fx, fy left out, because a sample lacks a value in it (the first is "
                          "in.csv:4); to use it, set stroke.table.force (stroke convert: --force) to "
                          "\"fx,fy\""),
            1);
  TableSettings named;
  named.force = "fx,fy";
  named.force_sign = ForceSign::on_device;
  const Stroke stroke = at_10_hz(columns, named).stroke;
  ASSERT_EQ(stroke.size(), 1u);
  EXPECT_EQ(stroke.force[0], Vector3d(1, 0, 0));
  // A force that was never there is no loss.
  const ImportedStroke never = at_10_hz({{"x", "m", {1, 2}},
                                         {"y", "m", {0, 0}},
                                         {"fx", "N", {nan_value, nan_value}},
                                         {"fy", "N", {nan_value, nan_value}}});
  EXPECT_THAT(never.warnings, ElementsAre());
  EXPECT_THAT(never.description, HasSubstr("fx, fy left out: no values"));
}

TEST(MissingSamples, OfTheOrientationAreNoBrokenQuaternions) {
  TableSettings settings;
  settings.orientation = "qx,qy,qz,qw";
  const Stroke stroke = at_10_hz({{"x", "m", {1, 2, 3}},
                                  {"y", "m", {0, 0, 0}},
                                  {"qx", "", {0, nan_value, 0}},
                                  {"qy", "", {0, 0, 0}},
                                  {"qz", "", {0, 0, 1}},
                                  {"qw", "", {1, 1, 0}}},
                                 settings)
                            .stroke;
  ASSERT_EQ(stroke.size(), 2u);
  EXPECT_EQ(stroke.orientation[1], Eigen::Vector4d(0, 0, 1, 0));
}

TEST(MissingSamples, OfThePressureLiftThePen) {
  const Stroke stroke =
      at_10_hz({{"x", "m", {1, 2, 3}}, {"y", "m", {0, 0, 0}}, {"pressure", "", {5, nan_value, 7}}}).stroke;
  EXPECT_THAT(stroke.pressure, ElementsAre(5.0, 7.0));
  EXPECT_FALSE(stroke.joined(0));
  EXPECT_TRUE(
      at_10_hz({{"x", "m", {1}}, {"y", "m", {0}}, {"pressure", "", {nan_value}}}).stroke.pressure.empty());
}

/// A second table with a hole gives no force there.
TEST(MissingSamples, OfASecondTableLeaveAGapInTheFirst) {
  ImportedStroke first = stroke_of_table(
      table_of({{"t", "s", {0, 0.01, 0.02, 0.03}}, {"x", "m", {0, 1, 2, 3}}, {"y", "m", {0, 0, 0, 0}}}), {},
      "first.csv");
  TableSettings settings;
  settings.force_sign = ForceSign::on_device;
  const ImportedStroke second = stroke_of_table(table_of({{"t", "s", {0, 0.009, 0.015, 0.021, 0.03}},
                                                          {"fx", "N", {0, 9, nan_value, 21, 30}},
                                                          {"fy", "N", {0, 0, 0, 0, 0}}}),
                                                settings, "second.csv", first.axes);
  merge_strokes(first, second, 0.0, "first.csv", "second.csv");
  ASSERT_EQ(first.stroke.size(), 2u);
  EXPECT_FALSE(first.stroke.joined(0));
  EXPECT_NEAR(first.stroke.force[1].x(), 30.0, 1e-9);
  EXPECT_EQ(warnings_with(first, "second.csv: 2 samples of the first table are left out"), 1);
}

}  // namespace
}  // namespace sandstroke
