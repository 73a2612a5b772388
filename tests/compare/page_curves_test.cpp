#include "compare/page_curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace sandstroke {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Curve curve_of(std::size_t points, const std::function<double(std::size_t)>& value) {
  Curve curve;
  for (std::size_t i = 0; i < points; ++i) {
    curve.time.push_back(0.001 * static_cast<double>(i));
    curve.value.push_back(value(i));
  }
  return curve;
}

TEST(ThinnedCurve, LeavesAShortOneAlone) {
  const Curve curve = curve_of(100, [](std::size_t i) { return std::sin(static_cast<double>(i)); });
  const Curve kept = thinned_curve(curve, 100);
  EXPECT_EQ(kept.time, curve.time);
  EXPECT_EQ(kept.value, curve.value);
}

TEST(ThinnedCurve, OfARampKeepsTheEndsOfEachStretch) {
  // 1000 points in 10 stretches: the least of stretch k is point 100 k, the greatest point 100 k + 99.
  const Curve kept = thinned_curve(curve_of(1000, [](std::size_t i) { return static_cast<double>(i); }), 20);
  ASSERT_EQ(kept.value.size(), 20u);
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_EQ(kept.value[2 * k], 100.0 * static_cast<double>(k));
    EXPECT_EQ(kept.value[2 * k + 1], 100.0 * static_cast<double>(k) + 99.0);
    EXPECT_EQ(kept.time[2 * k], 0.001 * static_cast<double>(100 * k));
  }
}

TEST(ThinnedCurve, KeepsASpikeOfOneTickWhereverItIs) {
  for (const double height : {1.0, -1.0}) {
    for (std::size_t spike = 0; spike < 997; ++spike) {
      const Curve kept =
          thinned_curve(curve_of(997,
                                 [&](std::size_t i) {
                                   return i == spike ? height : 1e-3 * std::sin(0.1 * static_cast<double>(i));
                                 }),
                        50);
      EXPECT_LE(kept.value.size(), 50u);
      const auto found = std::find(kept.value.begin(), kept.value.end(), height);
      ASSERT_NE(found, kept.value.end()) << spike;
      EXPECT_EQ(kept.time[static_cast<std::size_t>(found - kept.value.begin())],
                0.001 * static_cast<double>(spike));
      EXPECT_TRUE(std::is_sorted(kept.time.begin(), kept.time.end()));
    }
  }
}

TEST(ThinnedCurve, KeepsGapsAndTheExtremesBesideThem) {
  const Curve kept = thinned_curve(curve_of(1000,
                                            [](std::size_t i) {
                                              if (i == 500) return nan;
                                              if (i == 503) return HUGE_VAL;
                                              return i == 501 ? 7.0 : i == 502 ? -7.0 : 0.0;
                                            }),
                                   20);
  EXPECT_EQ(std::count_if(kept.value.begin(), kept.value.end(), [](double v) { return !std::isfinite(v); }),
            1);
  EXPECT_EQ(std::count(kept.value.begin(), kept.value.end(), 7.0), 1);
  EXPECT_EQ(std::count(kept.value.begin(), kept.value.end(), -7.0), 1);
}

TEST(ThinnedCurve, OfGapsAloneIsGaps) {
  const Curve kept = thinned_curve(curve_of(100, [](std::size_t) { return nan; }), 10);
  EXPECT_EQ(kept.value.size(), 5u);
}

CountedTrace trace_of(std::size_t ticks, const Eigen::Vector3d& force, double depth) {
  CountedTrace trace{ticks, {}};
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    TickRecord& record = trace.rows.emplace_back();
    record.time = 0.5 * static_cast<double>(tick);
    record.device_force = force;
    record.depth = depth;
  }
  return trace;
}

using Json = nlohmann::ordered_json;

TEST(TracesPart, HasEachQuantityOfBothAndTheirDifferenceWhereBothHaveTicks) {
  const Json part = traces_part(trace_of(3, {0.0, 3.0, 4.0}, 0.5), trace_of(2, {0.0, 4.0, 3.0}, 0.75), {});
  std::vector<std::string> names;
  for (const Json& quantity : part["quantities"]) names.push_back(quantity["name"]);
  EXPECT_EQ(names,
            (std::vector<std::string>{"magnitude", "along x", "along y", "along z", "depth", "sand level"}));
  const auto expect = [&](std::size_t i, double golden, double run, double difference) {
    const Json& quantity = part["quantities"][i];
    EXPECT_EQ(quantity["golden"]["value"], Json(std::vector(3, golden)));
    EXPECT_EQ(quantity["run"]["value"], Json(std::vector(2, run)));
    EXPECT_EQ(quantity["difference"]["value"], Json(std::vector(2, difference)));
    EXPECT_EQ(quantity["difference"]["time"], Json({0.0, 0.5}));
  };
  expect(0, 5.0, 5.0, std::sqrt(2.0));  // of the magnitude, the length of the difference
  expect(2, 3.0, 4.0, 1.0);
  expect(3, 4.0, 3.0, -1.0);
  expect(4, 0.5, 0.75, 0.25);
  EXPECT_EQ(Json::parse(part["quantities"][5]["golden"]["value"].dump()), Json({nullptr, nullptr, nullptr}))
      << "a gap while the tool is lifted";
}

TEST(TracesPart, WhoeverHasNoTraceHasNoCurves) {
  const Json part = traces_part(trace_of(3, {0.0, 3.0, 4.0}, 0.5), std::nullopt, {});
  for (const Json& quantity : part["quantities"]) {
    EXPECT_TRUE(quantity.contains("golden"));
    EXPECT_FALSE(quantity.contains("run"));
    EXPECT_FALSE(quantity.contains("difference"));
  }
  EXPECT_TRUE(traces_part(std::nullopt, std::nullopt, {}).is_null());
}

TEST(TracesPart, SaysHowManyTicksThereAreAndThatCurvesAreThinned) {
  CountedTrace golden = trace_of(3000, {1.0, 0.0, 0.0}, 0.0);
  golden.ticks = 29991;
  const Json part = traces_part(golden, trace_of(3000, {1.0, 0.0, 0.0}, 0.0), {});
  const std::string text = part["text"];
  EXPECT_NE(text.find("3000 of 29991 ticks"), std::string::npos) << text;
  EXPECT_NE(text.find("least and the greatest"), std::string::npos) << text;
  for (const Json& quantity : part["quantities"]) EXPECT_LE(quantity["golden"]["value"].size(), 2000u);
}

TEST(TracesPart, EachQuantityHasItsOwnValuesUnitAndLimit) {
  CountedTrace golden = trace_of(2, {1.0, 2.0, 3.0}, 4.0), run = trace_of(2, {11.0, 22.0, 33.0}, 44.0);
  for (TickRecord& tick : golden.rows) tick.level = 5.0;
  for (TickRecord& tick : run.rows) tick.level = 55.0;
  Tolerances tolerances;
  tolerances.height = 0.1, tolerances.force = 0.2, tolerances.depth = 0.3;
  const Json part = traces_part(golden, run, tolerances);
  const std::vector<std::tuple<double, double, const char*, double>> expected = {{1.0, 11.0, "N", 0.2},
                                                                                 {2.0, 22.0, "N", 0.2},
                                                                                 {3.0, 33.0, "N", 0.2},
                                                                                 {4.0, 44.0, "m", 0.3},
                                                                                 {5.0, 55.0, "m", 0.3}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Json& quantity = part["quantities"][i + 1];  // after the force's magnitude
    const auto& [in_golden, in_run, unit, limit] = expected[i];
    EXPECT_EQ(quantity["golden"]["value"], Json({in_golden, in_golden}));
    EXPECT_EQ(quantity["run"]["value"], Json({in_run, in_run}));
    EXPECT_EQ(quantity["difference"]["value"], Json({in_run - in_golden, in_run - in_golden}));
    EXPECT_EQ(quantity["run"]["time"], Json({0.0, 0.5}));
    EXPECT_EQ(quantity["unit"], unit);
    EXPECT_EQ(quantity["limit"], limit);
    EXPECT_EQ(quantity["group"], i < 3 ? "Force on the device" : "Tool in the sand");
  }
  EXPECT_EQ(part["quantities"][0]["unit"], "N");
  EXPECT_EQ(part["quantities"][0]["limit"], 0.2);
}

}  // namespace
}  // namespace sandstroke
