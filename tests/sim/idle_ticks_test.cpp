#include "sim/idle_ticks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/simulation.h"
#include "sim/told.h"
#include "sim/two_drags.h"

namespace sandstroke {
namespace {

struct GapRun : Told {
  std::vector<double> highest;  // m, sand of each frame
  RunResult result;
  HeightGrid surface;
  std::int64_t told;

  GapRun(const Scene& scene, const Stroke& stroke) {
    Simulation simulation(scene, starting_bed(scene.bed), stroke);
    told = simulation.told_ticks();
    result = simulation.run({this});
    surface = simulation.bed().grid();
  }
  void on_frame(double time, const HeightField& bed) override {
    Told::on_frame(time, bed);
    highest.push_back(bed.highest());
  }
};

void expect_equal(const TickRecord& a, const TickRecord& b) {
  const auto same = [](const auto& of_a, const auto& of_b) {
    using Value = std::decay_t<decltype(of_a)>;
    if constexpr (std::is_same_v<Value, double>)
      return of_a == of_b || (std::isnan(of_a) && std::isnan(of_b));
    else if constexpr (!components_of<Value>().empty())
      return of_a == of_b || (of_a.hasNaN() && of_b.hasNaN());
    else
      return of_a == of_b;
  };
  visit_tick_fields([&](const FieldText& field, const auto& of) {
    const std::string_view name = field.name;
    const bool of_a_lifted_hand = !a.contact && name.ends_with("position");
    EXPECT_TRUE(of_a_lifted_hand || same(of(a), of(b))) << name << " at " << a.time;
  });
  EXPECT_LT((a.hand.position - b.hand.position).norm(), 1e-15) << a.time;
  EXPECT_LT((a.device_position - b.device_position).norm(), 1e-15) << a.time;
}

/// Expects that `idle` reports the same as `all`, except idle ticks.
void expect_equal(const GapRun& idle, const GapRun& all) {
  const RunResult &a = idle.result, &b = all.result;
  EXPECT_EQ(a.ticks, b.ticks);
  EXPECT_EQ(a.simulated_seconds, b.simulated_seconds);
  EXPECT_EQ(a.contact_ticks, b.contact_ticks);
  EXPECT_EQ(a.stroke.gaps, b.stroke.gaps);
  EXPECT_EQ(a.relaxations, b.relaxations);
  EXPECT_EQ(a.relaxation.passes, b.relaxation.passes);
  EXPECT_EQ(a.relaxation.cells_visited, b.relaxation.cells_visited);
  EXPECT_EQ(a.relaxation.converged, b.relaxation.converged);
  EXPECT_EQ(a.moved_volume, b.moved_volume);
  EXPECT_EQ(a.volume_final, b.volume_final);
  EXPECT_EQ(a.max_depth, b.max_depth);
  EXPECT_EQ(a.device.max_force, b.device.max_force);
  EXPECT_EQ(a.device.mean_force, b.device.mean_force);
  EXPECT_EQ(a.device.absorbed_energy, b.device.absorbed_energy);
  EXPECT_EQ(a.device.least_passivity_margin, b.device.least_passivity_margin);
  EXPECT_TRUE((idle.surface == all.surface).all());
  EXPECT_EQ(idle.frames, all.frames);
  EXPECT_EQ(idle.highest, all.highest);

  auto there = all.relaxations.begin();
  for (const RelaxationRecord& here : idle.relaxations) {
    for (; there != all.relaxations.end() && there->time < here.time; ++there)
      EXPECT_EQ(there->outcome.passes, 0);
    ASSERT_NE(there, all.relaxations.end());
    EXPECT_EQ(there->time, here.time);
    EXPECT_EQ(there++->outcome.passes, here.outcome.passes);
  }
  EXPECT_EQ(there, all.relaxations.end());

  auto tick = all.ticks.begin();
  for (const TickRecord& here : idle.ticks) {
    tick = std::find_if(tick, all.ticks.end(), [&](const TickRecord& one) { return one.time >= here.time; });
    ASSERT_NE(tick, all.ticks.end());
    ASSERT_EQ(tick->time, here.time);
    expect_equal(here, *tick++);
  }
}

TEST(IdleTicks, AreLeftOutOfARunThatIsTheSame) {
  std::vector<Scene> scenes(7, bed_of_two_drags());
  scenes[1].preset = ModelPreset::accurate;
  apply_model_preset(scenes[1]);
  scenes[2].output.frames = 7.0;
  scenes[3].relaxation.max_passes = 1;
  scenes[3].relaxation.rate = 10.0;  // sand relaxes all the time
  scenes[3].output.frames = 2000.0;
  scenes[4].relaxation.rate = 0.7;
  scenes[5].relaxation.rate = 1e6;
  scenes[6].device.servo_rate = 333.3;
  for (const Scene& scene : scenes) {
    SCOPED_TRACE(&scene - scenes.data());
    const GapRun idle(scene, two_drags(3.0, Pause::unsampled)), all(scene, two_drags(3.0, Pause::sampled));
    EXPECT_EQ(static_cast<std::int64_t>(idle.ticks.size()), idle.told);
    EXPECT_EQ(static_cast<std::int64_t>(all.ticks.size()), all.told);
    EXPECT_NEAR(static_cast<double>(all.told - idle.told), 2.0 * scene.device.servo_rate, 2.0);
    expect_equal(idle, all);
  }
}

TEST(IdleTicks, AreAwayFromAllSamples) {
  const Stroke stroke = two_drags(1.7, Pause::unsampled);
  const std::vector<TickRange> idle = idle_ticks(stroke, DeviceSettings{});
  ASSERT_EQ(idle.size(), 1u);
  EXPECT_EQ(idle[0].begin, 801);  // 0.3005 s + 0.5 s
  EXPECT_EQ(idle[0].end, 1500);   // 2.0005 s - 0.5 s: tick 1500 is less than that before the sample
  EXPECT_TRUE(idle_ticks(two_drags(1.0, Pause::unsampled), DeviceSettings{}).empty());
  EXPECT_TRUE(idle_ticks(two_drags(3.0, Pause::sampled), DeviceSettings{}).empty());
}

TEST(IdleTicks, AreNoneOfADeviceThatStillSwingsOrFeels) {
  DeviceSettings dynamic, late, dropping;
  dynamic.model = DeviceModel::dynamic;
  late.delay = 1;
  dropping.dropped_ticks = 0.1;
  for (const DeviceSettings& device : {dynamic, late, dropping})
    EXPECT_TRUE(idle_ticks(two_drags(3.0, Pause::unsampled), device).empty());
}

TEST(IdleTicks, TakeNoTimeForYears) {
  Scene scene = bed_of_two_drags();
  const GapRun seconds(scene, two_drags(3.0, Pause::unsampled)),
      years(scene, two_drags(1e9, Pause::unsampled));
  EXPECT_EQ(years.told, seconds.told);
  EXPECT_NEAR(years.result.simulated_seconds, 1e9, 1.0);
  EXPECT_NEAR(static_cast<double>(years.result.relaxations), 60e9, 60.0);
  EXPECT_NEAR(static_cast<double>(years.result.contact_ticks),
              static_cast<double>(seconds.result.contact_ticks), 2.0);
}

}  // namespace
}  // namespace sandstroke
