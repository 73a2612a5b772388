// Closed loops of a tool in sand: the sand may store energy, but gives none.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <tuple>

#include "sim/pressed_tool.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

/// Places on a closed path of size 1, by the fraction of the turn; where it begins is 0.
using Path = std::function<Vector3d(double)>;

struct NamedPath {
  const char* name;
  Path at;
};

const std::array<NamedPath, 6> paths = {{
    {"circle in x and z", [](double a) { return Vector3d(std::cos(a) - 1.0, 0.0, std::sin(a)); }},
    {"the same backwards", [](double a) { return Vector3d(std::cos(a) - 1.0, 0.0, -std::sin(a)); }},
    {"level circle", [](double a) { return Vector3d(std::cos(a) - 1.0, std::sin(a), 0.0); }},
    {"flat ellipse, leaning",
     [](double a) { return Vector3d(std::cos(a) - 1.0, 0.2 * std::sin(a), 0.5 * std::sin(a + 1.0) - 0.42); }},
    {"line", [](double a) { return Vector3d(std::sin(a) * Vector3d(0.6, 0.3, 0.74)); }},
    {"figure of eight",
     [](double a) { return Vector3d(std::sin(2.0 * a), 0.3 * std::sin(a), 0.5 * std::sin(a)); }},
}};

/// The work of a hand on a tool in level sand, and on a device of limited force, as an ever finer loop has
/// it: by the force after each step.
class PressedHand {
 public:
  PressedHand(const Scene& scene, double depth)
      : bed_(starting_bed(scene.bed)),
        law_(make_contact_force(scene, bed_.cell_size())),
        sand_(scene.tool, scene.displacement) {
    sand_.look(bed_, Vector3d::Zero());
    constexpr int steps = 100;
    for (int i = 1; i <= steps; ++i) go({0.0, 0.0, -depth * i / steps});
  }

  void go(const Vector3d& to) {
    const Vector3d motion = to - tip_;
    felt_ = law_->in_tick(sand_, bed_, to, motion, true);
    work_ -= felt_.force.dot(motion);
    device_work_ -= felt_.given.dot(motion);
    tip_ = to;
  }

  const Wrench& felt() const { return felt_; }
  double work() const { return work_; }                // J
  double device_work() const { return device_work_; }  // J

 private:
  HeightField bed_;
  std::unique_ptr<ToolForce> law_;
  SandSide sand_;
  Vector3d tip_ = Vector3d::Zero();
  Wrench felt_;
  double work_ = 0.0, device_work_ = 0.0;
};

class ContactLoopsOf : public testing::TestWithParam<std::tuple<ForceLaw, ToolShape>> {};

TEST_P(ContactLoopsOf, OfAnySizeGiveNoEnergy) {
  const auto [law, shape] = GetParam();
  constexpr double depth = 0.03;
  constexpr int steps = 200, turns = 4;
  for (const double limit : {0.0, 1.0}) {
    Scene scene = contact_scene_of(law, shape);
    scene.device.max_force = limit;
    for (const auto& [name, path] : paths)
      for (const double size : {0.01, 0.05, 0.3, 1.0, 3.0, 10.0}) {
        PressedHand hand(scene, depth);
        const double way = size * scene.strength.yield_way, rounding = 1e-9 * hand.work();
        for (int turn = 1; turn <= turns; ++turn) {
          const double before = hand.work(), device_before = hand.device_work(), stored = hand.felt().stored;
          for (int i = 1; i <= steps; ++i)
            hand.go(Vector3d(0.0, 0.0, -depth) + way * (path(2.0 * pi * i / steps) - path(0.0)));
          // What a turn gives was stored.
          EXPECT_GE(hand.work() - before, hand.felt().stored - stored - rounding) << name << " " << size;
          EXPECT_GE(hand.device_work(), -rounding) << name << " " << size;
          if (turn < turns || shape != ToolShape::sphere) continue;
          EXPECT_GE(hand.work() - before, -rounding) << name << " " << size;
          EXPECT_GE(hand.device_work() - device_before, -rounding) << name << " " << size;
        }
      }
  }
}

TEST(ContactLoops, ThatTurnTheToolGiveADeviceNoEnergy) {
  // A device gives no torque: the hand tilts the grip for nothing, so that must not push the device.
  Scene scene = contact_scene_of(ForceLaw::rft, ToolShape::plate);
  scene.device.max_force = 3.0;
  const HeightField bed = starting_bed(scene.bed);
  const std::unique_ptr<ToolForce> law = make_contact_force(scene, bed.cell_size());
  SandSide sand(scene.tool, scene.displacement);
  sand.look(bed, Vector3d::Zero());
  Vector3d tip = Vector3d::Zero();
  double work = 0.0;
  const auto go = [&](const Vector3d& to) {
    const Vector3d motion = to - tip;
    work -= law->in_tick(sand, bed, to, motion, true).given.dot(motion);
    tip = to;
  };
  for (int i = 1; i <= 100; ++i) go({0.0, 0.0, -0.012 * i / 100});
  const double plunge = work;
  EXPECT_GT(plunge, 0.0);
  constexpr int steps = 200;
  for (int i = 1; i <= 10 * steps; ++i) {
    const double angle = 2.0 * pi * i / steps;
    law->turn(Eigen::AngleAxisd(0.17 * std::sin(angle), Vector3d::UnitY()).toRotationMatrix() *
              own_rotation(scene.tool));
    go({5e-4 * std::sin(angle + 0.5 * pi) - 5e-4, 0.0, -0.012});
  }
  EXPECT_GE(work - plunge, -1e-3 * plunge);
}

INSTANTIATE_TEST_SUITE_P(LawsAndTools, ContactLoopsOf,
                         testing::Combine(testing::Values(ForceLaw::rft, ForceLaw::archimedes),
                                          testing::Values(ToolShape::sphere, ToolShape::plate)));

}  // namespace
}  // namespace sandstroke
