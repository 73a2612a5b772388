// Compares the engine with the plain references, bit for bit: random beds, tools and angles, on any number of
// threads and every instruction set of the machine.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <hwy/targets.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "rules/displacement.h"
#include "rules/talus.h"
#include "sand/active_sand.h"
#include "sand/all_laws.h"
#include "sand/ground.h"
#include "sand/initial_surface.h"
#include "sand/relaxation.h"
#include "sand/sphere_tool.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

/// Uses one instruction set while it lives.
class InstructionSet {
 public:
  explicit InstructionSet(std::int64_t target) { hwy::SetSupportedTargetsForTest(target); }
  ~InstructionSet() { hwy::SetSupportedTargetsForTest(0); }
};

template <class Body>
void on_threads(int threads, const Body& body) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  8);  // more than the machine has
  tbb::task_arena(threads).execute(body);
}

/// A bed and a tool that works on it, drawn at random. Sizes are not whole numbers of tiles, tools lie close
/// to walls and tile borders, talus angles are gentle and steep. Beds are flat, rough, bumpy or cliffs, some
/// of them round.
class RandomScene {
 public:
  RandomScene(unsigned seed, int least_side, int largest_side) : random_(seed) {
    const int rows = whole(least_side, largest_side), cols = whole(least_side, largest_side);
    SurfaceSettings surface;
    const SurfaceKind kinds[] = {SurfaceKind::flat, SurfaceKind::noise, SurfaceKind::cliff,
                                 SurfaceKind::cylinder, SurfaceKind::ripples};
    surface.kind = kinds[whole(0, 4)];
    surface.seed = seed;
    surface.height = surface.kind == SurfaceKind::flat ? 0.0 : real(-8.0, 8.0) * dx;
    surface.radius = real(2.0, 30.0) * dx;
    surface.amplitude = real(0.0, 6.0) * dx;
    surface.wavelength = whole(0, 1) || surface.kind == SurfaceKind::ripples ? real(5.0, 60.0) * dx : 0.0;
    bed = make_surface(surface, rows, cols, dx, whole(0, 2) == 0 ? BedShape::round : BedShape::rectangle);
    relaxation.law = static_cast<RelaxationLaw>(whole(0, 2));
    relaxation.talus_angle = real(3.0, 70.0);
    relaxation.tolerance = whole(0, 3) ? 1e-3 : 0.05;
    relaxation.share = whole(0, 2) ? 0.0 : real(0.05, relaxation.law == RelaxationLaw::paper ? 0.5 : 0.25);
    relaxation.max_passes = whole(0, 5) ? 60 : whole(0, 3);  // the reference is slow
    tool.radius = real(0.6, 7.0) * dx;
    tool.profile = whole(0, 1) ? ToolProfile::paper : ToolProfile::sphere;
    const Deposit deposits[] = {Deposit::ring, Deposit::ahead, Deposit::outward};
    deposit = {deposits[whole(0, 2)], real(1.0, 1.4)};
  }

  /// Lays the bed on a floor: level, rough, or stones with upright sides and none between. Some lie above the
  /// sand.
  void lay_on_floor() {
    const auto ground = std::make_shared<Ground>(bed, 0.5);
    const int kind = whole(0, 2);
    for (int row = 0; row < bed.rows(); ++row)
      for (int col = 0; col < bed.cols(); ++col)
        if (kind == 1)
          ground->floor.set(row, col, real(-6.0, 2.0) * dx);
        else if (kind == 2 && row / 9 % 2 == col / 7 % 2)
          ground->floor.set(row, col, (row / 9 + col / 7) % 9 * dx - 5.0 * dx);
    if (kind == 0) *ground = Ground(bed, real(-4.0, 0.0) * dx, 0.5);
    bed.lie_on(ground);
  }

  struct Push {
    double x, y, depth;
    Eigen::Vector3d motion;
  };
  /// A position anywhere, along a tile border, or along a wall; now and then along one axis, or none.
  Push draw_push() {
    const int at = whole(0, 2);
    const double row = at == 0 ? real(0, bed.rows()) : at == 1 ? real(61, 67) : real(-2, 3);
    const double col = at == 0 ? real(0, bed.cols()) : at == 1 ? real(60, 68) : real(0, bed.cols());
    const auto along_axis = [&] { return whole(0, 3) ? real(-dx, dx) : 0.0; };
    return {bed.x_of(0) + col * dx,
            bed.y_of(0) + row * dx,
            real(0.0, 4.0) * dx,
            {along_axis(), along_axis(), along_axis()}};
  }

  /// Pushes the tool into each bed, at the same position. As a solid tool it stays there, or not.
  void push(std::initializer_list<HeightField*> beds) {
    const Push at = draw_push();
    const bool stays = whole(0, 1) == 1;
    for (HeightField* one : beds) {
      SphereTool placed(tool);
      placed.place(*one, at.x, at.y);
      placed.displace(*one, placed.sand_level() - at.depth, at.motion, deposit);
      if (stays)
        placed.make_walls(*one);
      else
        one->set_tool_walls({});
    }
  }

  /// Lays the bed on a random ground: kinds of sand by cell or by region, or one kind; a level floor below or
  /// within the sand, stones that stand out of it, or none.
  void draw_ground() {
    const double slope = talus_slope(relaxation.talus_angle);
    const double floors[] = {-1e3 * dx, -2.0 * dx, 0.0};
    const int level = whole(0, 3);
    auto ground = level == 3 ? std::make_shared<Ground>(bed, slope)
                             : std::make_shared<Ground>(bed, floors[level], slope);
    const int kinds = whole(0, 2), stones = whole(0, 2);
    const double other = talus_slope(real(1.0, 80.0));
    for (int row = 0; row < bed.rows(); ++row)
      for (int col = 0; col < bed.cols(); ++col)
        if (kinds == 1 && row + 2 * col > bed.cols())
          ground->talus_slopes.set(row, col, other);
        else if (kinds == 2)
          ground->talus_slopes.set(row, col, talus_slope(real(1.0, 89.0)));
    for (int stone = 0; stone < 3 * stones; ++stone) {
      const int at_row = whole(0, bed.rows() - 1), at_col = whole(0, bed.cols() - 1), size = whole(1, 12);
      const double top = real(-3.0, 8.0) * dx, lean = real(-1.0, 1.0) * dx;
      for (int row = at_row; row < std::min(at_row + size, bed.rows()); ++row)
        for (int col = at_col; col < std::min(at_col + size, bed.cols()); ++col)
          ground->floor.set(row, col, std::max(ground->level(), top + lean * (row - at_row)));
    }
    bed.lie_on(ground);
  }

  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  static constexpr double dx = 0.002;
  HeightField bed{1, 1, dx};
  RelaxationSettings relaxation;
  ToolSettings tool;
  DisplacementSettings deposit;

 private:
  std::mt19937 random_;
};

bool same_bits(const HeightGrid& a, const HeightGrid& b) {
  return std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
}

std::string law_of(const RandomScene& scene) {
  return relaxation_law_names[static_cast<std::size_t>(scene.relaxation.law)];
}

/// Lets the engine and the reference relax a scene and compares every bit after each time.
void expect_equal_relaxations(RandomScene& scene) {
  HeightField by_engine = scene.bed, by_reference = scene.bed;
  const auto engine = make_relaxer(scene.relaxation, scene.dx),
             reference = make_plain_relaxer(scene.relaxation, scene.dx);
  for (int round = 0; round < 4; ++round) {
    const RelaxationOutcome a = engine->relax(by_engine), b = reference->relax(by_reference);
    ASSERT_TRUE(same_bits(by_engine.grid(), by_reference.grid()))
        << "round " << round << ", " << law_of(scene);
    ASSERT_EQ(a.passes, b.passes) << "round " << round;
    ASSERT_EQ(a.residual, b.residual) << "round " << round;
    ASSERT_EQ(a.converged, b.converged) << "round " << round;
    ASSERT_NEAR(a.moved_volume, b.moved_volume, 1e-12 * (1e-6 + b.moved_volume));
    scene.push({&by_engine, &by_reference});
  }
}

TEST(Engine, EqualsTheReferenceInASteadyFlow) {
  // A ramp, too steep everywhere: inner cells pass on what they take, and do not change.
  for (const RelaxationLaw law : all_laws)
    for (const int passes : {0, 1, 20, 100}) {
      RelaxationSettings settings;
      settings.law = law;
      settings.max_passes = passes;
      HeightField by_engine(3, 400, 1.0);
      for (int row = 0; row < 3; ++row)
        for (int col = 0; col < 400; ++col) by_engine.set(row, col, col);
      HeightField by_reference = by_engine;
      const RelaxationOutcome a = make_relaxer(settings, 1.0)->relax(by_engine);
      const RelaxationOutcome b = make_plain_relaxer(settings, 1.0)->relax(by_reference);
      EXPECT_TRUE(same_bits(by_engine.grid(), by_reference.grid()));
      EXPECT_EQ(a.passes, b.passes);
      EXPECT_EQ(a.residual, b.residual);
      EXPECT_EQ(a.converged, b.converged);
      EXPECT_LE(a.moved_volume, b.moved_volume);
    }
}

TEST(Engine, SaysThatSandRestsWhereThePassesJustSufficed) {
  SurfaceSettings cylinder;
  cylinder.kind = SurfaceKind::cylinder;
  cylinder.radius = 10.0;
  cylinder.height = 12.0;
  RelaxationSettings settings;
  HeightField bed = make_surface(cylinder, 80, 80, 1.0);
  settings.max_passes = make_relaxer(settings, 1.0)->relax(bed).passes;
  for (const auto& [less, converged] : {std::pair(0, true), std::pair(1, false)}) {
    settings.max_passes -= less;
    HeightField again = make_surface(cylinder, 80, 80, 1.0);
    const RelaxationOutcome outcome = make_relaxer(settings, 1.0)->relax(again);
    EXPECT_EQ(outcome.passes, settings.max_passes);
    EXPECT_EQ(outcome.converged, converged);
  }
}

const int thread_counts[] = {1, 2, 3, 8};

TEST(Engine, EqualsTheReferenceOn200RandomScenes) {
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  for (unsigned seed = 1; seed <= (sanitized ? 50 : 200); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const InstructionSet set(targets[seed % targets.size()]);
    on_threads(thread_counts[seed / targets.size() % 4], [&] {
      RandomScene scene(seed, 1, 140);
      expect_equal_relaxations(scene);
    });
    ASSERT_FALSE(testing::Test::HasFailure());
  }
}

TEST(Engine, EqualsTheReferenceOn300RandomGrounds) {
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  for (unsigned seed = 1; seed <= (sanitized ? 50 : 300); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const InstructionSet set(targets[seed % targets.size()]);
    on_threads(thread_counts[seed / targets.size() % 4], [&] {
      RandomScene scene(seed, 1, 140);
      scene.draw_ground();
      expect_equal_relaxations(scene);
    });
    ASSERT_FALSE(testing::Test::HasFailure());
  }
}

TEST(Engine, EqualsTheReferenceWithEveryInstructionSetAndThreadCount) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    for (const int threads : sanitized ? std::vector{3} : std::vector{1, 2, 3, 8})
      for (const unsigned seed : sanitized ? std::vector{1001u} : std::vector{1001u, 1002u, 1003u}) {
        SCOPED_TRACE(std::string(hwy::TargetName(target)) + ", threads " + std::to_string(threads));
        const InstructionSet set(target);
        on_threads(threads, [&] {
          RandomScene scene(seed, 200, 260);  // rough: enough active cells for several threads
          SurfaceSettings rough;
          rough.kind = SurfaceKind::noise;
          rough.amplitude = 5.0 * scene.dx;
          rough.wavelength = 0.0;
          rough.seed = seed;
          scene.bed = make_surface(rough, scene.bed.rows(), scene.bed.cols(), scene.dx);
          scene.relaxation.max_passes = sanitized ? 1 : 6;
          expect_equal_relaxations(scene);
        });
        ASSERT_FALSE(testing::Test::HasFailure());
      }
}

/// Cells that the next relaxation will look at.
bool same_disturbed(const HeightField& a, const HeightField& b) {
  for (int tile = 0; tile < a.tile_count(); ++tile) {
    const auto disturbed = [tile](const HeightField& bed) {
      return bed.slot_of(tile) < 0 ? CellFlags{} : bed.disturbed_cells(bed.slot_of(tile));
    };
    if (disturbed(a) != disturbed(b)) return false;
  }
  return true;
}

WallGrid beyond_wall(const HeightField& bed) {
  WallGrid walls(bed.rows(), bed.cols());
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) walls(row, col) = !bed.has_sand(row, col);
  return walls;
}

/// Pushes a tool into a bed six times, by the engine and by the plain rule. Counts pushes that moved sand.
void push_by_both(RandomScene& scene, int& pushed) {
  const bool has_floor = scene.bed.ground() != nullptr;
  const HeightGrid floor = has_floor ? scene.bed.ground()->floor.grid() : HeightGrid();
  HeightField expected = scene.bed;
  const WallGrid walls = beyond_wall(scene.bed);
  for (int i = 0; i < 6; ++i) {
    const RandomScene::Push at = scene.draw_push();
    SphereTool tool(scene.tool);
    tool.place(scene.bed, at.x, at.y);
    HeightGrid heights = expected.grid();
    const PlainDisplacement plain(scene.tool.profile, scene.tool.radius, walls, scene.dx, at.x, at.y);
    const double level = plain.sand_level(heights), tip = level - at.depth;
    ASSERT_TRUE(tool.sand_level() == level || (std::isnan(level) && std::isnan(tool.sand_level())));
    if (std::isnan(level)) continue;
    ASSERT_EQ(tool.depth(tip), has_floor ? level - tip - plain.floor_above(floor, tip) : level - tip);

    const double volume = tool.displace(scene.bed, tip, at.motion, scene.deposit);
    ASSERT_EQ(volume, plain.displace(heights, tip, at.motion, scene.deposit, has_floor ? &floor : nullptr));
    ASSERT_TRUE(!has_floor || (heights >= floor).all());
    expected.set_changed(heights);
    ASSERT_TRUE(same_bits(scene.bed.grid(), expected.grid()));
    ASSERT_TRUE(same_disturbed(scene.bed, expected));
    pushed += volume > 0.0;

    tool.make_walls(scene.bed);
    for (int row = 0; row < scene.bed.rows(); ++row)
      for (int col = 0; col < scene.bed.cols(); ++col)
        ASSERT_EQ(scene.bed.is_wall(row, col), plain.covers(row, col) || walls(row, col))
            << row << ", " << col;
    scene.bed.set_tool_walls({});
    scene.bed.clear_disturbed();
    expected.clear_disturbed();
  }
}

TEST(Tool, EqualsThePlainRuleOn400RandomScenesWithAndWithoutFloor) {
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  for (const bool has_floor : {false, true}) {
    int pushed = 0;
    for (unsigned seed = 1; seed <= (sanitized ? 40 : 400); ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed) + (has_floor ? ", on a floor" : ""));
      const InstructionSet set(targets[seed % targets.size()]);
      RandomScene scene(seed, 1, 140);
      if (has_floor) scene.lay_on_floor();
      push_by_both(scene, pushed);
      if (testing::Test::HasFatalFailure()) return;
    }
    EXPECT_GT(pushed, sanitized ? 100 : 1000);
  }
}

TEST(Tool, HasTheSameBitsWithEveryInstructionSet) {
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::vector<HeightGrid> beds;
    std::vector<double> levels;
    for (const std::int64_t target : targets) {
      const InstructionSet set(target);
      RandomScene scene(seed, 20, 140);
      for (int i = 0; i < 3; ++i) scene.push({&scene.bed});
      SphereTool tool(scene.tool);
      tool.place(scene.bed, 0.1 * scene.dx, -0.3 * scene.dx);
      beds.push_back(scene.bed.grid());
      levels.push_back(tool.sand_level());
    }
    for (std::size_t i = 1; i < targets.size(); ++i) {
      EXPECT_TRUE(same_bits(beds[i], beds[0])) << hwy::TargetName(targets[i]) << ", seed " << seed;
      EXPECT_EQ(levels[i], levels[0]) << hwy::TargetName(targets[i]) << ", seed " << seed;
    }
  }
}

}  // namespace
}  // namespace sandstroke
