#include "sim/stepped_simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/error.h"
#include "sim/simulation.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

Scene stepped_scene() {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.2;
  scene.bed.cols = scene.bed.rows = 80;
  scene.stroke.emplace();
  return scene;
}

/// A hand that goes in and out of the sand, perhaps lifted for a while, and turns.
Stroke stepped_stroke(double seconds, bool lifts) {
  Stroke stroke;
  for (int k = 0; k < static_cast<int>(1000.0 * seconds); ++k) {
    const double t = 1e-3 * k;
    stroke.time.push_back(t);
    stroke.position.push_back(
        {0.04 * std::cos(3.0 * t), 0.04 * std::sin(2.0 * t), -0.004 + 0.003 * std::sin(9.0 * t)});
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(t, Eigen::Vector3d::UnitZ()));
    stroke.orientation.push_back(turn.coeffs());
    if (lifts) stroke.contact.push_back(k > 500 && k < 600 ? pen_up : k == 500 ? pen_lifts : pen_down);
  }
  return stroke;
}

struct PlayedTicks : SimulationObserver {
  std::vector<TickRecord> ticks;
  void on_tick(const TickRecord& tick) override { ticks.push_back(tick); }
};

void expect_bits_of_a_run(const Scene& scene, bool lifts) {
  Simulation run(scene, starting_bed(scene.bed), stepped_stroke(1.0, lifts));
  PlayedTicks played;
  run.run({&played});
  SteppedSimulation stepped(scene, starting_bed(scene.bed));
  for (std::size_t k = 0; k < played.ticks.size(); ++k) {
    const TickRecord& asked = played.ticks[k];
    if (stepped.time() < asked.time - 1e-9) {  // an idle tick, of which nobody is told
      stepped.tick(Hand{asked.hand.position}, {.orientation = true});
      --k;
      continue;
    }
    const TickRecord& tick = stepped.tick(asked.hand, {.velocity = true, .orientation = true});
    ASSERT_EQ(tick.device_force, asked.device_force) << asked.time;
    ASSERT_EQ(tick.wrench.torque, asked.wrench.torque) << asked.time;
    ASSERT_EQ(tick.depth, asked.depth) << asked.time;
    ASSERT_EQ(tick.device_position, asked.device_position) << asked.time;
    ASSERT_EQ(tick.contact, asked.contact) << asked.time;
  }
  stepped.lift();
  stepped.relax();
  EXPECT_EQ((stepped.bed().grid() - run.bed().grid()).abs().maxCoeff(), 0.0);
}

TEST(SteppedSimulation, HasTheBitsOfARunOfTheSameHand) {
  for (const bool accurate : {false, true})
    for (const ForceLaw law : {ForceLaw::paper, ForceLaw::rft}) {
      Scene scene = stepped_scene();
      if (accurate) {
        scene.preset = ModelPreset::accurate;
        apply_model_preset(scene);
        scene.tool.shape = ToolShape::cone;
        scene.tool.height = 0.02;
      }
      scene.force.law = law;
      expect_bits_of_a_run(scene, true);
    }
}

TEST(SteppedSimulation, PushesADynamicDeviceAsARunDoes) {
  Scene scene = stepped_scene();
  scene.device.model = DeviceModel::dynamic;
  scene.device.delay = 2;
  expect_bits_of_a_run(scene, false);  // a run puts a lifted device to the hand
}

TEST(SteppedSimulation, RelaxesOnlyWhenToldWhereThatIsAsked) {
  const Scene scene = stepped_scene();
  SteppedSimulation stepped(scene, starting_bed(scene.bed), false), relaxing(scene, starting_bed(scene.bed));
  for (int k = 0; k < 200; ++k) {
    const Hand hand{Eigen::Vector3d(-0.04 + 4e-4 * k, 0.0, -0.008), Eigen::Vector3d::Zero(), true};
    stepped.tick(hand);
    relaxing.tick(hand);
  }
  EXPECT_GT(stepped.bed().highest(), 1.5 * relaxing.bed().highest());
  EXPECT_GT(stepped.relax().passes, 0);
  EXPECT_TRUE(stepped.relax().converged);
}

TEST(SteppedSimulation, TakesTheVelocityOfTheWayWithoutOne) {
  const Scene scene = stepped_scene();
  SteppedSimulation told(scene, starting_bed(scene.bed)), guesses(scene, starting_bed(scene.bed));
  for (int k = 0; k < 100; ++k) {
    Hand hand{Eigen::Vector3d(-0.02 + 2e-4 * k, 0.0, -0.004), Eigen::Vector3d(k > 0 ? 0.2 : 0.0, 0.0, 0.0),
              true};
    const Eigen::Vector3d force = told.tick(hand, {.velocity = true}).device_force;
    hand.velocity.setZero();
    EXPECT_LT((guesses.tick(hand).device_force - force).norm(), 1e-9);
  }
}

TEST(SteppedSimulation, RefusesWhatIsNoNumberAndAHandThatMustBeKnownBefore) {
  Scene scene = stepped_scene();
  SteppedSimulation stepped(scene, starting_bed(scene.bed));
  Hand hand{Eigen::Vector3d(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0), Eigen::Vector3d::Zero(),
            true};
  EXPECT_THROW(stepped.tick(hand), Error);
  scene.device.model = DeviceModel::dynamic;
  scene.device.drag = DragVelocity::implicit;
  EXPECT_THROW(SteppedSimulation(scene, starting_bed(scene.bed)), Error);
}

/// Scenes whose ticks depend on much of what was before: encoders, delays, dropped ticks, contact forces,
/// laws, tools that turn.
std::vector<Scene> scenes_with_a_past() {
  std::vector<Scene> scenes;
  for (const ModelPreset preset : {ModelPreset::paper, ModelPreset::accurate})
    for (const ForceLaw law : {ForceLaw::paper, ForceLaw::rft, ForceLaw::archimedes})
      for (const bool dynamic : {false, true})
        for (const bool blade : {false, true}) {
          if (blade && preset == ModelPreset::paper) continue;
          Scene scene = stepped_scene();
          scene.preset = preset;
          apply_model_preset(scene);
          scene.force.law = law;
          if (blade) {
            scene.tool.shape = ToolShape::plate;
            scene.tool.width = 0.04;
            scene.tool.thickness = 0.01;
          }
          if (dynamic) {
            scene.device.model = DeviceModel::dynamic;
            scene.device.delay = 3;
            scene.device.dropped_ticks = 0.1;
            scene.device.velocity = ReadVelocity::encoders;
          }
          scenes.push_back(scene);
        }
  return scenes;
}

/// Plays ticks [begin, end) of a hand.
std::vector<TickRecord> play(SteppedSimulation& simulation, const Stroke& stroke, int begin, int end) {
  std::vector<TickRecord> ticks;
  for (int k = begin; k < end; ++k) {
    Hand hand;
    hand.down = true;
    hand.position = stroke.position[static_cast<std::size_t>(k)];
    hand.orientation = Eigen::Quaterniond(stroke.orientation[static_cast<std::size_t>(k)]);
    ticks.push_back(simulation.tick(hand, {.orientation = true}));
  }
  return ticks;
}

void expect_same(const std::vector<TickRecord>& some, const std::vector<TickRecord>& others) {
  ASSERT_EQ(some.size(), others.size());
  for (std::size_t k = 0; k < some.size(); ++k) {
    const TickRecord &one = some[k], &other = others[k];
    ASSERT_EQ(one.device_force, other.device_force) << k;
    ASSERT_EQ(one.wrench.torque, other.wrench.torque) << k;
    ASSERT_EQ(one.device_position, other.device_position) << k;
    ASSERT_EQ(one.passivity_margin, other.passivity_margin) << k;
    ASSERT_EQ(one.dropped, other.dropped) << k;
    ASSERT_EQ(one.displaced_volume, other.displaced_volume) << k;
    ASSERT_EQ(one.contact, other.contact) << k;
  }
}

bool same_sand(const SteppedSimulation& one, const SteppedSimulation& other) {
  return (one.bed().grid() == other.bed().grid()).all();
}

TEST(SteppedSimulation, CopiesGoOnWithTheSameBitsInAnyOrderAndThread) {
  const Stroke stroke = stepped_stroke(0.7, false);
  std::mt19937 random(3);
  for (const Scene& scene : scenes_with_a_past()) {
    const int from = 20 + static_cast<int>(random() % 300), to = from + 60;
    SteppedSimulation whole(scene, starting_bed(scene.bed));
    play(whole, stroke, 0, from);
    const std::vector<TickRecord> expected = play(whole, stroke, from, to);

    SteppedSimulation first(scene, starting_bed(scene.bed));
    play(first, stroke, 0, from);
    SteppedSimulation second = first, third = first;
    // The third goes elsewhere meanwhile, in another thread.
    std::thread elsewhere([&] { play(third, stroke, to, to + 100); });
    expect_same(play(second, stroke, from, to), expected);
    elsewhere.join();
    expect_same(play(first, stroke, from, to), expected);
    EXPECT_TRUE(same_sand(first, whole));
    EXPECT_TRUE(same_sand(second, whole));
    EXPECT_FALSE(same_sand(third, whole));
    for (SteppedSimulation* simulation : {&whole, &first, &second}) {
      simulation->lift();
      simulation->relax();
    }
    EXPECT_TRUE(same_sand(first, whole));
    EXPECT_TRUE(same_sand(second, whole));
  }
}

Scene scene_of_a_pile() {
  Scene scene = stepped_scene();
  scene.bed.surface.kind = SurfaceKind::cylinder;
  scene.bed.surface.radius = 0.04;
  scene.bed.surface.height = 0.05;
  return scene;
}

void expect_same_relaxations(SteppedSimulation& one, SteppedSimulation& other) {
  for (int i = 0; i < 3; ++i) {
    const RelaxationOutcome a = one.relax(), b = other.relax();
    EXPECT_EQ(a.passes, b.passes);
    EXPECT_EQ(a.residual, b.residual);
  }
  EXPECT_TRUE(same_sand(one, other));
}

/// A copy made while sand is still awake, since a relaxation was cut off.
TEST(SteppedSimulation, ACopyGoesOnWithARelaxationThatWasCutOff) {
  for (const RelaxationMethod method :
       {RelaxationMethod::passes, RelaxationMethod::rkl, RelaxationMethod::plain}) {
    Scene scene = scene_of_a_pile();
    scene.relaxation.method = method;
    scene.relaxation.max_passes = 10;
    SteppedSimulation one(scene, starting_bed(scene.bed));
    one.relax();
    SteppedSimulation other = one;
    expect_same_relaxations(one, other);
  }
}

TEST(SteppedSimulation, CopiesShareTheSandThatNeitherTouched) {
  Scene scene = stepped_scene();
  scene.bed.cols = scene.bed.rows = 1280;
  SteppedSimulation one(scene, HeightField(HeightGrid::Zero(1280, 1280), scene.bed.cell_size()));
  one.relax();
  SteppedSimulation other = one;
  const HeightField &bed = one.bed(), &copy = other.bed();
  const auto shared = [&] {
    int count = 0;
    for (int slot = 0; slot < bed.allocated_tiles(); ++slot)
      count += bed.tile_heights(slot) == copy.tile_heights(slot);
    return count;
  };
  EXPECT_EQ(shared(), 400);
  play(other, stepped_stroke(0.1, false), 0, 100);
  other.relax();
  EXPECT_LT(shared(), 400);
  EXPECT_GT(shared(), 340);  // the tool and its furrow are 20 mm wide, a tile 10
}

/// A relaxation that an exception ends, as Ctrl-C does from Python.
TEST(SteppedSimulation, GoesOnAfterAnExceptionFromItsWatcher) {
  struct Stop {};
  for (const RelaxationMethod method : {RelaxationMethod::passes, RelaxationMethod::rkl}) {
    Scene scene = scene_of_a_pile();
    scene.relaxation.method = method;
    SteppedSimulation one(scene, starting_bed(scene.bed));
    EXPECT_THROW(one.relax([](std::int64_t passes, const BedNow&) {
      if (passes == 5) throw Stop();
    }),
                 Stop);
    SteppedSimulation other = one;
    for (SteppedSimulation* simulation : {&one, &other}) {
      const RelaxationOutcome outcome = simulation->relax();
      EXPECT_TRUE(outcome.converged);
      EXPECT_NEAR(simulation->bed().volume(), starting_bed(scene.bed).volume(), 1e-18);
    }
  }
}

TEST(SteppedSimulation, GoesOnFromAStateWithTheSameBits) {
  const Stroke stroke = stepped_stroke(0.7, false);
  std::mt19937 random(5);
  for (const Scene& scene : scenes_with_a_past()) {
    const int from = static_cast<int>(random() % 300), to = from + 60;
    SteppedSimulation whole(scene, starting_bed(scene.bed));
    play(whole, stroke, 0, from);
    const std::string state = whole.state();
    const std::vector<TickRecord> expected = play(whole, stroke, from, to);

    SteppedSimulation other(scene, starting_bed(scene.bed));
    play(other, stroke, to, to + 20);  // it was elsewhere
    other.set_state(state);
    EXPECT_NEAR(other.time(), 1e-3 * from, 1e-12);
    EXPECT_TRUE(other.state() == state);  // too long to be shown
    expect_same(play(other, stroke, from, to), expected);
    for (SteppedSimulation* simulation : {&whole, &other}) {
      simulation->lift();
      simulation->relax();
    }
    EXPECT_TRUE(same_sand(other, whole));
  }
}

TEST(SteppedSimulation, KeepsWhichSandIsAwakeInAState) {
  for (const RelaxationMethod method : {RelaxationMethod::passes, RelaxationMethod::rkl}) {
    Scene scene = scene_of_a_pile();
    scene.relaxation.method = method;
    scene.relaxation.max_passes = 10;
    SteppedSimulation one(scene, starting_bed(scene.bed)), other = one;
    one.relax();
    other.set_state(one.state());
    expect_same_relaxations(one, other);
  }
}

TEST(SteppedSimulation, RefusesAStateThatIsCutOffOrOfAnotherScene) {
  Scene scene = stepped_scene();
  scene.force.law = ForceLaw::rft;
  SteppedSimulation one(scene, starting_bed(scene.bed)), other = one;
  play(one, stepped_stroke(0.1, false), 0, 100);
  const std::string state = one.state();
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{5}, std::size_t{40}, state.size() / 2, state.size() - 1})
    EXPECT_THROW(other.set_state(std::string_view(state).substr(0, size)), Error) << size;
  EXPECT_THROW(other.set_state(state + "x"), Error);
  EXPECT_EQ(other.time(), 0.0);  // as it was
  EXPECT_EQ(other.bed().allocated_tiles(), 0);
  scene.force.law = ForceLaw::paper;
  SteppedSimulation by_another_law(scene, starting_bed(scene.bed));
  EXPECT_THROW(by_another_law.set_state(state), Error);
  other.set_state(state);
  EXPECT_TRUE(same_sand(one, other));
}

TEST(SteppedSimulation, RefusesAStateThatWasChanged) {
  SteppedSimulation one(stepped_scene(), starting_bed(stepped_scene().bed));
  play(one, stepped_stroke(0.1, false), 0, 100);
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    std::string state = one.state();
    state[random() % state.size()] ^= static_cast<char>(1 << random() % 8);
    EXPECT_THROW(one.set_state(state), Error);
  }
}

/// The scene's text is the same, but a file that it names has changed, or somebody gave another surface.
TEST(SteppedSimulation, RefusesAStateOfAnotherToolOrSurface) {
  Scene scene = stepped_scene();
  scene.tool.shape = ToolShape::mesh;
  ToolSettings box;
  box.shape = ToolShape::plate;
  box.width = 0.04;
  box.thickness = 0.01;
  auto mesh = std::make_shared<TriangleMesh>(tool_surface(box));
  scene.tool.mesh = mesh;
  SteppedSimulation one(scene, starting_bed(scene.bed));
  play(one, stepped_stroke(0.1, false), 0, 50);
  auto other_mesh = std::make_shared<TriangleMesh>(*mesh);
  for (Eigen::Vector3d& vertex : other_mesh->vertices) vertex.x() *= 1.01;
  scene.tool.mesh = other_mesh;
  SteppedSimulation with_another_tool(scene, starting_bed(scene.bed));
  EXPECT_THROW(with_another_tool.set_state(one.state()), Error);

  const Scene pile = scene_of_a_pile();
  SteppedSimulation on_pile(pile, starting_bed(pile.bed));
  SteppedSimulation on_level(pile, HeightField(pile.bed.rows, pile.bed.cols, pile.bed.cell_size()));
  EXPECT_THROW(on_level.set_state(on_pile.state()), Error);
  SteppedSimulation on_heights(pile, HeightField(starting_bed(pile.bed).grid(), pile.bed.cell_size()));
  on_level.set_state(on_heights.state());  // has all heights
  EXPECT_TRUE(same_sand(on_level, on_heights));
}

TEST(SteppedSimulation, KeepsInAStateWhetherItRelaxes) {
  const Scene scene = stepped_scene();
  SteppedSimulation relaxes(scene, starting_bed(scene.bed)), stays(scene, starting_bed(scene.bed), false);
  SteppedSimulation other = relaxes;
  other.set_state(stays.state());
  for (SteppedSimulation* simulation : {&relaxes, &stays, &other})
    play(*simulation, stepped_stroke(0.2, false), 0, 200);
  EXPECT_TRUE(same_sand(other, stays));
  EXPECT_FALSE(same_sand(other, relaxes));
}

}  // namespace
}  // namespace sandstroke
