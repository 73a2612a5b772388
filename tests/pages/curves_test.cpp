#include "pages/curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace sandstroke {
namespace {

std::vector<TickRecord> trace_of(std::size_t ticks, const Eigen::Vector3d& force, double depth) {
  std::vector<TickRecord> trace;
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    TickRecord& record = trace.emplace_back();
    record.time = 0.5 * static_cast<double>(tick);
    record.device_force = force;
    record.depth = depth;
  }
  return trace;
}

using Json = nlohmann::ordered_json;

TEST(AbsorbedEnergy, IsTheForceTimesTheWayOfTheTickBefore) {
  std::vector<TickRecord> trace(4);
  const std::vector<double> height = {0.0, -0.25, -0.75, -0.5}, force = {2.0, 4.0, 8.0, 100.0};
  for (std::size_t tick = 0; tick < 4; ++tick) {
    trace[tick].device_position = {3.0, 0.0, height[tick]};
    trace[tick].device_force.z() = force[tick];
  }
  EXPECT_EQ(absorbed_energy(trace), (std::vector{0.0, 0.5, 2.5, 0.5}));  // the last gives 2 J back
  EXPECT_TRUE(absorbed_energy({}).empty());
}

TEST(TracesPart, HasTheQuantitiesAndTheEnergyOfOneRun) {
  std::vector<TickRecord> trace = trace_of(3, {0.0, 3.0, 4.0}, 0.5);
  for (std::size_t tick = 0; tick < 3; ++tick)
    trace[tick].device_position.y() = -0.5 * static_cast<double>(tick);
  const Json part = traces_part(trace);
  ASSERT_EQ(part["quantities"].size(), 7u);
  for (const Json& quantity : part["quantities"]) EXPECT_EQ(quantity["run"]["at"], Json({0.0, 0.5, 1.0}));
  EXPECT_EQ(part["quantities"][0]["run"]["value"], Json({5.0, 5.0, 5.0}));
  EXPECT_EQ(part["quantities"][4]["run"]["value"], Json({500.0, 500.0, 500.0}));
  EXPECT_EQ(part["quantities"][6]["name"], "energy");
  EXPECT_EQ(part["quantities"][6]["unit"], "J");
  EXPECT_EQ(part["quantities"][6]["run"]["value"], Json({0.0, 1.5, 3.0}));
}

TEST(TracesPart, HasTheTorqueOfAContactLaw) {
  std::vector<TickRecord> trace(3);
  for (std::size_t tick = 0; tick < trace.size(); ++tick) {
    trace[tick].time = 0.5 * static_cast<double>(tick);
    trace[tick].wrench.torque = {0.0, 0.1 * static_cast<double>(tick), 0.0};
  }
  const Json part = traces_part(trace);
  ASSERT_EQ(part["quantities"].size(), 10u);
  EXPECT_EQ(part["quantities"][7]["name"], "about y");
  EXPECT_EQ(part["quantities"][7]["unit"], "N m");
  EXPECT_EQ(part["quantities"][7]["run"]["value"], Json({0.0, 0.1, 0.2}));
}

TEST(TracesPart, HasTheForceThatWasRecordedWithTheStroke) {
  std::vector<TickRecord> trace = trace_of(3, {0.0, 3.0, 4.0}, 0.5);
  EXPECT_FALSE(traces_part(trace)["quantities"][0].contains("recorded"));
  trace[0].recorded_force = {6.0, 0.0, 8.0};
  trace[2].recorded_force = {0.0, 3.0, 4.0};
  for (const Json& part : {traces_part(trace), traces_part(std::nullopt, trace, {})}) {
    const std::string magnitude = part["quantities"][0]["recorded"]["value"].dump();
    EXPECT_EQ(Json::parse(magnitude), Json({10.0, nullptr, 5.0}));
    EXPECT_EQ(Json::parse(part["quantities"][3]["recorded"]["value"].dump()), Json({8.0, nullptr, 4.0}));
    EXPECT_FALSE(part["quantities"][4].contains("recorded")) << "depth";
  }
  const std::string text = traces_part(trace)["text"];
  EXPECT_NE(text.find("over 2 ticks"), std::string::npos) << text;
}

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
    EXPECT_EQ(quantity["difference"]["at"], Json({0.0, 0.5}));
  };
  expect(0, 5.0, 5.0, std::sqrt(2.0));  // of the magnitude, the length of the difference
  expect(2, 3.0, 4.0, 1.0);
  expect(3, 4.0, 3.0, -1.0);
  expect(4, 500.0, 750.0, 250.0);  // mm
  EXPECT_EQ(Json::parse(part["quantities"][5]["golden"]["value"].dump()), Json({nullptr, nullptr, nullptr}))
      << "a gap while the tool is lifted";
}

TEST(TracesPart, HasNoCurvesOfARunWithoutATrace) {
  const Json part = traces_part(trace_of(3, {0.0, 3.0, 4.0}, 0.5), std::nullopt, {});
  for (const Json& quantity : part["quantities"]) {
    EXPECT_TRUE(quantity.contains("golden"));
    EXPECT_FALSE(quantity.contains("run"));
    EXPECT_FALSE(quantity.contains("difference"));
  }
  EXPECT_TRUE(traces_part(std::nullopt, std::nullopt, {}).is_null());
}

TEST(TracesPart, SaysHowManyTicksThereAreAndThatCurvesAreThinned) {
  const Json part =
      traces_part(trace_of(3000, {1.0, 0.0, 0.0}, 0.0), trace_of(2999, {1.0, 0.0, 0.0}, 0.0), {});
  const std::string text = part["text"];
  EXPECT_NE(text.find("Golden: 3000 ticks; run: 2999 ticks."), std::string::npos) << text;
  EXPECT_NE(text.find("least and the greatest"), std::string::npos) << text;
  for (const Json& quantity : part["quantities"]) EXPECT_LE(quantity["golden"]["value"].size(), 2000u);
}

TEST(TracesPart, EachQuantityHasItsOwnValuesUnitAndLimit) {
  std::vector<TickRecord> golden = trace_of(2, {1.0, 2.0, 3.0}, 4.0),
                          run = trace_of(2, {11.0, 22.0, 33.0}, 44.0);
  for (TickRecord& tick : golden) tick.level = 5.0;
  for (TickRecord& tick : run) tick.level = 55.0;
  Tolerances tolerances;
  tolerances.height = 0.1;
  tolerances.force = 0.2;
  tolerances.depth = 0.3;
  const Json part = traces_part(golden, run, tolerances);
  const std::vector<std::tuple<double, double, const char*, double>> expected = {{1.0, 11.0, "N", 0.2},
                                                                                 {2.0, 22.0, "N", 0.2},
                                                                                 {3.0, 33.0, "N", 0.2},
                                                                                 {4e3, 44e3, "mm", 300.0},
                                                                                 {5e3, 55e3, "mm", 300.0}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Json& quantity = part["quantities"][i + 1];  // after the force's magnitude
    const auto& [in_golden, in_run, unit, limit] = expected[i];
    EXPECT_EQ(quantity["golden"]["value"], Json({in_golden, in_golden}));
    EXPECT_EQ(quantity["run"]["value"], Json({in_run, in_run}));
    EXPECT_EQ(quantity["difference"]["value"], Json({in_run - in_golden, in_run - in_golden}));
    EXPECT_EQ(quantity["run"]["at"], Json({0.0, 0.5}));
    EXPECT_EQ(quantity["unit"], unit);
    EXPECT_EQ(quantity["limit"], limit);
    EXPECT_EQ(quantity["group"], i < 3 ? "Force on the device" : "Tool in the sand");
  }
  // Above the sand, the depth is drawn as 0: the hand's height would squash what counts.
  golden[0].depth = -0.5;
  EXPECT_EQ(traces_part(golden, run, tolerances)["quantities"][4]["golden"]["value"], Json({0.0, 4e3}));
  EXPECT_EQ(part["quantities"][0]["unit"], "N");
  EXPECT_EQ(part["quantities"][0]["limit"], 0.2);
}

}  // namespace
}  // namespace sandstroke
