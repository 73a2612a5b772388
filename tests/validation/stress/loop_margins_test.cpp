#include "validation/stress/loop_margins.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/scene.h"
#include "validation/stress/device_parts.h"
#include "validation/stress/loop_theory.h"
#include "validation/stress/scene_loop.h"
#include "validation/stress/stress.h"

namespace sandstroke {
namespace {

const Margin& margin_of(const LoopMargins& loop, const char* what) {
  for (const Margin& one : loop.margins)
    if (one.what.find(what) != std::string::npos) return one;
  throw std::runtime_error(std::string("no margin of ") + what);
}

LoopSettings wall(double stiffness) {
  LoopSettings loop;
  loop.device = ideal_device();
  loop.against = Wall{stiffness, 0.0};
  return loop;
}

TEST(LoopMargins, EachChangedByItsFactorAloneBringsTheLoopToItsBoundary) {
  const LoopSettings loop = wall(2000.0);
  const LoopMargins margins = margins_of("wall", loop);
  EXPECT_TRUE(margins.stable);
  const auto radius_with = [&](const auto& change) {
    LoopSettings changed = loop;
    change(changed);
    return spectral_radius(changed);
  };
  EXPECT_NEAR(radius_with([&](LoopSettings& l) {
                l.against = Wall{margin_of(margins, "stiffness").boundary, 0.0};
              }),
              1.0, 1e-6);
  EXPECT_NEAR(
      radius_with([&](LoopSettings& l) { l.device.servo_rate = margin_of(margins, "servo").boundary; }), 1.0,
      1e-6);
  const double damping = margin_of(margins, "damping").factor;
  EXPECT_NEAR(radius_with([&](LoopSettings& l) {
                l.device.damping /= damping;
                l.device.hand_damping /= damping;
              }),
              1.0, 1e-6);
  const Margin& delay = margin_of(margins, "delay");
  EXPECT_LT(radius_with([&](LoopSettings& l) { l.device.delay = static_cast<int>(delay.boundary); }), 1.0);
  EXPECT_GE(radius_with([&](LoopSettings& l) { l.device.delay = static_cast<int>(delay.boundary) + 1; }),
            1.0);
  for (const Margin& one : margins.margins) EXPECT_GT(one.factor, 1.0) << one.what;
}

TEST(LoopMargins, OfAnUnstableLoopAreBelowOne) {
  const LoopMargins margins = margins_of("wall", wall(1e5));
  EXPECT_FALSE(margins.stable);
  for (const Margin& one : margins.margins) EXPECT_LT(one.factor, 1.0) << one.what;
}

TEST(LoopMargins, ALoopWithoutDampingIsStableAtNoValueOfIt) {
  LoopSettings loop = wall(2000.0);
  loop.device.damping = loop.device.hand_damping = 0.0;
  const LoopMargins margins = margins_of("wall", loop);
  EXPECT_FALSE(margins.stable);
  for (const char* what : {"damping", "delay"}) {
    EXPECT_EQ(margin_of(margins, what).factor, 0.0) << what;
    EXPECT_TRUE(std::isinf(margin_of(margins, what).boundary)) << what;
  }
}

// Drag by the difference of positions lags by half of its window.
TEST(LoopMargins, VelocitiesOfEncodersMakeThemSmaller) {
  DeviceSettings device = ideal_device();
  const LoopMargins exact = margins_of("exact", pressed_with(3.0, device, ForceSettings{}));
  device.velocity = ReadVelocity::encoders;
  const LoopMargins read = margins_of("read", pressed_with(3.0, device, ForceSettings{}));
  EXPECT_LT(margin_of(read, "stiffness").factor, margin_of(exact, "stiffness").factor);
}

TEST(LoopMargins, TheKnownLoopsAreStable) {
  for (const MarkedLoop& known : known_loops())
    EXPECT_TRUE(margins_of(known.name, known.loop).stable) << known.name;
}

TEST(MapMarks, ALoopIsWhereItsSettingsAreAndMatchesAMapOfItsOwn) {
  const LoopSettings own = wall(3000.0);
  const MapAxis rate{"servo rate", "Hz", true, {}}, stiffness{"stiffness", "N/m", true, {}},
      k_c{"k_c", "1/m", true, {}};
  const auto same = [&](double x, double y) {
    LoopSettings loop = wall(y);
    loop.device.servo_rate = x;
    return loop;
  };
  const std::vector<MapMark> marks = marks_in(rate, stiffness, same, {{"own", own}});
  ASSERT_EQ(marks.size(), 1u);
  EXPECT_EQ(marks[0].x, own.device.servo_rate);
  EXPECT_EQ(marks[0].y, 3000.0);
  EXPECT_TRUE(marks[0].same);
  EXPECT_TRUE(marks[0].stable);
  const auto heavier = [&](double x, double y) {
    LoopSettings loop = same(x, y);
    loop.device.mass *= 2.0;
    return loop;
  };
  EXPECT_FALSE(marks_in(rate, stiffness, heavier, {{"own", own}}).at(0).same);
  EXPECT_TRUE(marks_in(rate, k_c, same, {{"own", own}}).empty()) << "a wall has no k_c";
}

TickRecord contact(double depth) {
  TickRecord tick;
  tick.contact = true;
  tick.depth = depth;
  return tick;
}

TEST(StiffestContact, IsTheDeepestOfThePapersLawAndKeepsTheScenesDevice) {
  Scene scene;
  scene.device.mass = 0.5;
  scene.device.resolution = 1e-5;
  StiffestContact observer(scene);
  EXPECT_ANY_THROW(observer.loop()) << "it never touched sand";
  for (const double depth : {0.002, 0.006, 0.004}) observer.on_tick(contact(depth));
  const LoopSettings loop = observer.loop();
  EXPECT_EQ(std::get<PressedSand>(loop.against).depth, 0.006);
  EXPECT_EQ(loop.device.mass, 0.5);
  EXPECT_EQ(loop.device.resolution, 0.0);
}

TEST(StiffestContact, OfAForceAtItsLimitIsNone) {
  const Scene scene;
  StiffestContact observer(scene);
  TickRecord tick = contact(0.03);
  tick.saturated = true;
  observer.on_tick(tick);
  EXPECT_ANY_THROW(observer.loop());
}

TEST(StiffestContact, OfAContactLawHasItsStiffness) {
  Scene scene;
  scene.force.law = ForceLaw::rft;
  scene.device.max_force = 0.0;
  StiffestContact observer(scene);
  for (const double stiffness : {100.0, 700.0, 300.0}) {
    TickRecord tick = contact(0.001);
    tick.wrench.stiffness = stiffness;
    observer.on_tick(tick);
  }
  EXPECT_NEAR(felt_about_rest(observer.loop()).z.stiffness, 700.0, 1e-9);
}

TEST(StressScene, DrawsTheScenesLoopWithinItsOwnMapsAndTheoryForetellsThem) {
  LoopSettings own = known_loops()[0].loop;
  own.device.resolution = 0.0;  // encoders dither, which these maps do not foretell
  StressOptions options;
  options.quick = true;
  const StressReport report = stress_scene(own, options);
  EXPECT_EQ(report.surprises(), 0);
  ASSERT_EQ(report.margins.size(), 1u);
  ASSERT_EQ(report.maps.size(), 4u);
  for (const StabilityMap& map : report.maps) {
    ASSERT_EQ(map.marks.size(), 1u) << map.name;
    const MapMark& mark = map.marks[0];
    EXPECT_TRUE(mark.same) << map.name;
    EXPECT_GE(mark.x, map.x.values.front()) << map.name;
    EXPECT_LE(mark.x, map.x.values.back()) << map.name;
    EXPECT_GE(mark.y, map.y.values.front()) << map.name;
    EXPECT_LE(mark.y, map.y.values.back()) << map.name;
  }
}

}  // namespace
}  // namespace sandstroke
