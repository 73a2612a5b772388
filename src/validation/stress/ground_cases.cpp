// Floors, stones and regions that no user would lay. Sand comes to rest on them, none gets below the floor
// and none is lost, or the scene is refused with an error sentence.
#include <spdlog/fmt/fmt.h>

#include "validation/stress/hostile_grounds.h"
#include "validation/stress/judged_run.h"
#include "validation/stress/stress.h"

namespace sandstroke {
namespace {

struct LawOnGround {
  RelaxationLaw law;
  RelaxationMethod method;
};

/// All that there are, or some.
std::vector<LawOnGround> laws_on_grounds(bool quick) {
  if (quick)
    return {{RelaxationLaw::paper, RelaxationMethod::passes},
            {RelaxationLaw::isotropic, RelaxationMethod::rkl},
            {RelaxationLaw::faces, RelaxationMethod::rkl}};
  std::vector<LawOnGround> all;
  for (const RelaxationLaw law : {RelaxationLaw::paper, RelaxationLaw::isotropic, RelaxationLaw::faces})
    for (const RelaxationMethod method : {RelaxationMethod::passes, RelaxationMethod::rkl,
                                          RelaxationMethod::multilevel, RelaxationMethod::plain})
      all.push_back({law, method});
  return all;
}

/// The paper's law takes no super-steps over a floor, and no coarser beds at all.
bool goes_with(const LawOnGround& one, const GroundSettings& ground) {
  return one.law != RelaxationLaw::paper || one.method == RelaxationMethod::passes ||
         one.method == RelaxationMethod::plain || (one.method == RelaxationMethod::rkl && !ground.is_solid());
}

Scene scene_on(const HostileGround& hostile, const LawOnGround& one) {
  Scene scene;
  scene.bed.cols = ground_cols;
  scene.bed.rows = ground_rows;
  scene.bed.width = ground_cols * ground_cell;
  scene.bed.depth = ground_rows * ground_cell;
  scene.bed.shape = hostile.shape;
  scene.bed.surface = hostile.surface;
  scene.ground = hostile.ground;
  scene.relaxation.law = one.law;
  scene.relaxation.method = one.method;
  return scene;
}

/// The scene's bed, with a layer of sand [m] over all that its ground is.
HeightField bed_with_layer(const Scene& scene, double layer) {
  HeightField bed = starting_bed(scene.bed);
  if (layer == 0.0) return bed;
  bed = on_ground(std::move(bed), scene);
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) bed.set(row, col, bed(row, col) + layer);
  return bed;
}

std::string name_of(const LawOnGround& one) {
  return fmt::format("{}, {}", relaxation_law_names[static_cast<int>(one.law)],
                     relaxation_method_names[static_cast<int>(one.method)]);
}

/// Relaxes sand on one ground by all laws and methods that go with it, but the slow one (few_passes has it).
StressCase on_hostile(const HostileGround& hostile, bool quick) {
  Variations all("grounds", hostile.name, hostile.settings, {Verdict::stable});
  for (const LawOnGround& one : laws_on_grounds(quick)) {
    if (!goes_with(one, hostile.ground) || one.method == RelaxationMethod::plain) continue;
    const Scene scene = scene_on(hostile, one);
    all.add(judged_on_threads(scene, bed_with_layer(scene, hostile.spread)), name_of(one));
  }
  return all.done();
}

/// What does not go together is refused.
StressCase other_laws(const HostileGround& hostile) {
  Variations all("grounds", fmt::format("{}, other laws", hostile.name), "laws that know no floor",
                 {Verdict::refused});
  for (const LawOnGround& one : laws_on_grounds(false))
    if (!goes_with(one, hostile.ground)) {
      const Scene scene = scene_on(hostile, one);
      all.add(judged_run(scene, starting_bed(scene.bed)), name_of(one));
    }
  return all.done();
}

/// Allows no pass, or one, or a share of the excess that is small.
StressCase few_passes(const HostileGround& hostile, bool quick) {
  Variations all("grounds", fmt::format("{}, hardly relaxed", hostile.name),
                 "relaxation.max_passes of 0, 1 and 7", {Verdict::stable, Verdict::not_converged});
  for (const LawOnGround& one : laws_on_grounds(quick))
    for (const int passes : {0, 1, 7}) {
      if (!goes_with(one, hostile.ground) || (quick && passes == 0)) continue;
      Scene scene = scene_on(hostile, one);
      scene.relaxation.max_passes = passes;
      all.add(judged_on_threads(scene, bed_with_layer(scene, hostile.spread)),
              fmt::format("{}, {} passes", name_of(one), passes));
    }
  return all.done();
}

/// A stone and a heap in cells of any size.
StressCase any_cells(bool quick) {
  const int passes = quick ? 300 : 3000;
  Variations all(
      "grounds", "stones in cells of any size",
      fmt::format("cells of 1e-100 to 1e100 m; a stone of 20 cells, or of 1 m; at most {} passes", passes),
      {Verdict::stable, Verdict::not_converged, Verdict::refused});
  for (const double size : {1e-100, 1e-60, 1e-9, 1.0, 40.0, 1e9, 1e60, 1e100})
    for (const double diameter : {20.0 * size, 1.0})
      for (const LawOnGround& one : laws_on_grounds(quick)) {
        HostileGround hostile{"", "", heap_of(15.0 * size), {}};
        hostile.surface.radius = 8.0 * size;
        hostile.ground.floor = size > 1.0 ? -1.0 : -size;
        hostile.ground.stones = {
            stone_of(StoneShape::sphere, Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(diameter))};
        if (!goes_with(one, hostile.ground) || one.method == RelaxationMethod::plain) continue;
        Scene scene = scene_on(hostile, one);
        scene.bed.cols = scene.bed.rows = 40;
        scene.bed.width = scene.bed.depth = 40.0 * size;
        scene.relaxation.max_passes = passes;
        all.add(judged_run(scene, starting_bed(scene.bed)),
                fmt::format("cells of {} m, stone of {} m, {}", size, diameter, name_of(one)));
      }
  return all.done();
}

/// Grounds that no bed can have.
StressCase impossible() {
  Variations all("grounds", "beyond the bed", "a stone, a region or a floor", {Verdict::refused});
  const auto add = [&](const std::string& name, const auto& change) {
    HostileGround hostile{"", "", {}, {}};
    change(hostile.ground);
    const Scene scene = scene_on(hostile, {RelaxationLaw::isotropic, RelaxationMethod::passes});
    all.add(judged_run(scene, starting_bed(scene.bed)), name);
  };
  using V = Eigen::Vector3d;
  for (const double far : {0.2, 1e5, 1e300}) {
    add(fmt::format("a stone at {} m", far), [&](GroundSettings& ground) {
      ground.stones = {stone_of(StoneShape::sphere, V(far, 0.0, 0.0), V::Constant(0.02))};
    });
    add(fmt::format("a region at {} m", far), [&](GroundSettings& ground) {
      ground.regions = {rectangle_of({far, 0.0}, {0.02, 0.02}, 45.0)};
    });
  }
  add("a stone of 1e300 m", [&](GroundSettings& ground) {
    ground.stones = {stone_of(StoneShape::box, V::Zero(), V::Constant(1e300))};
  });
  add("a stone below the floor", [&](GroundSettings& ground) {
    ground.floor = 0.0;
    ground.stones = {stone_of(StoneShape::sphere, V(0.0, 0.0, -1.0), V::Constant(0.02))};
  });
  add("the same stone twice", [&](GroundSettings& ground) {
    ground.stones = {stone_of(StoneShape::sphere, V::Zero(), V::Constant(0.02)),
                     stone_of(StoneShape::sphere, V::Zero(), V::Constant(0.02))};
  });
  return all.done();
}

}  // namespace

void stress_grounds(StressReport& report, const StressOptions& options) {
  const std::vector<HostileGround> grounds = hostile_grounds();
  double done = 0.0;
  for (const HostileGround& hostile : grounds) {
    report.cases.push_back(on_hostile(hostile, options.quick));
    report.cases.push_back(few_passes(hostile, options.quick));
    options.progress(done += 0.9 / static_cast<double>(grounds.size()));
  }
  report.cases.push_back(other_laws(grounds.front()));
  report.cases.push_back(any_cells(options.quick));
  report.cases.push_back(impossible());
  options.progress(1.0);
}

}  // namespace sandstroke
