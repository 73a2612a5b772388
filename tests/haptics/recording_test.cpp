#include "haptics/recording.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "haptics/recording_fields.h"

namespace sandstroke {
namespace {

TEST(TickCounts, EachFlagCountsItsOwn) {
  const auto count = [](std::uint32_t flags) {
    TickCounts t;
    t.elapsed = 10;
    t.recorded = 20;
    t.skipped = 30;
    t.unread = 40;
    t.dropped = 50;
    count_flags(flags, t);
    EXPECT_EQ(t.elapsed + t.recorded + t.skipped + t.unread + t.dropped, 150);
    return std::vector{t.late, t.clamped, t.ramped, t.rate_limited, t.refused, t.deferred, t.interlocked};
  };
  using Counts = std::vector<std::int64_t>;
  EXPECT_EQ(count(0), (Counts{0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(count(late_sample), (Counts{1, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(count(after_skipped_ticks), (Counts{0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(count(clamped_force), (Counts{0, 1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(count(ramped_force), (Counts{0, 0, 1, 0, 0, 0, 0}));
  EXPECT_EQ(count(rate_limited_force), (Counts{0, 0, 0, 1, 0, 0, 0}));
  EXPECT_EQ(count(refused_force), (Counts{0, 0, 0, 0, 1, 0, 0}));
  EXPECT_EQ(count(deferred_sand), (Counts{0, 0, 0, 0, 0, 1, 0}));
  EXPECT_EQ(count(interlocked_force), (Counts{0, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(count(late_sample | refused_force | deferred_sand), (Counts{1, 0, 0, 0, 1, 1, 0}));
}

TEST(StopReason, HasATextOfItsOwnAndIsFoundByIt) {
  std::set<std::string> texts;
  for (int i = 0; i <= static_cast<int>(StopReason::finish); ++i) {
    const auto reason = static_cast<StopReason>(i);
    EXPECT_TRUE(texts.insert(stop_reason_text(reason)).second);
    EXPECT_EQ(stop_reason_of(stop_reason_text(reason)), reason);
  }
  EXPECT_EQ(stop_reason_of("the time was"), std::nullopt);
  EXPECT_EQ(stop_reason_of("unknown"), std::nullopt);
}

TEST(StopReason, LeavesACompleteRecordingIfSomebodyAskedForIt) {
  using enum StopReason;
  for (const StopReason asked : {duration, stroke_end, stop_switch, key, finish})
    EXPECT_TRUE(is_complete(asked));
  for (const StopReason other : {signal, device_lost, stall, disk, no_number, error, cut_off})
    EXPECT_FALSE(is_complete(other));
}

TEST(RecordingFields, EveryFieldHasANameOfItsOwn) {
  std::set<std::string> names;
  std::set<const void*> fields;
  const auto visit = [&](const char* name, const auto& field) {
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_TRUE(fields.insert(&field).second) << name;
  };
  const RecordingHeader header;
  const RecordingFooter footer;
  visit_header(header, visit);
  visit_footer(footer, visit);
}

TEST(RecordingFields, AreUnderTheirNames) {
  RecordingHeader header;
  header.nominal_rate = 1;
  header.device.max_force = 2;
  header.device.max_stiffness = 3;
  header.device.workspace_radius = 4;
  header.device.switches = 5;
  header.force_limit = 6;
  header.scheduling.priority = 7;
  header.device.max_damping = 8;
  RecordingFooter footer;
  footer.ticks = {11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22};
  footer.lateness = {31, 32, 33};
  std::map<std::string, double> values;
  const auto visit = [&](const char* name, const auto& field) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(field)>>)
      values[name] = static_cast<double>(field);
  };
  visit_header(header, visit);
  visit_footer(footer, visit);
  const std::map<std::string, double> expected = {{"nominal_rate", 1},         {"device_max_force", 2},
                                                  {"device_max_stiffness", 3}, {"device_workspace_radius", 4},
                                                  {"device_switches", 5},      {"force_limit", 6},
                                                  {"scheduling_priority", 7},  {"ticks_elapsed", 11},
                                                  {"ticks_recorded", 12},      {"ticks_skipped", 13},
                                                  {"ticks_unread", 14},        {"ticks_dropped", 15},
                                                  {"ticks_late", 16},          {"ticks_clamped", 17},
                                                  {"ticks_ramped", 18},        {"ticks_rate_limited", 19},
                                                  {"ticks_refused", 20},       {"ticks_held", 21},
                                                  {"ticks_interlocked", 22},   {"device_max_damping", 8},
                                                  {"lateness_mean", 31},       {"lateness_p99", 32},
                                                  {"lateness_max", 33}};
  for (const auto& [name, value] : expected) EXPECT_EQ(values[name], value) << name;
}

TEST(TickCounts, AreStarvedWhereMoreThanATenthWasSkipped) {
  const auto of = [](std::int64_t skipped) {
    TickCounts ticks;
    ticks.elapsed = 1000;
    ticks.skipped = skipped;
    return ticks;
  };
  EXPECT_EQ(skipped_fraction(of(5)), 0.005);
  EXPECT_EQ(skipped_fraction(TickCounts{}), 0.0);
  EXPECT_FALSE(is_starved({of(100), {}, StopReason::duration}));
  EXPECT_TRUE(is_starved({of(101), {}, StopReason::duration}));
  EXPECT_FALSE(is_starved({of(900), {}, StopReason::cut_off}));  // nobody knows why they are missing
}

}  // namespace
}  // namespace sandstroke
