#include "sweep/point_runner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sand/initial_surface.h"
#include "sim/simulation.h"
#include "sweep/sweep_inputs.h"

namespace sandstroke {
namespace {

Scene small_scene() {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.2;
  scene.bed.cols = scene.bed.rows = 100;
  scene.stroke.emplace().file = "in memory";
  return scene;
}

/// Down into the sand, along, and up.
Stroke a_drag() {
  Stroke stroke;
  stroke.time = {0.0, 0.1, 0.4, 0.5};
  stroke.position = {{-0.05, 0, 0.002}, {-0.05, 0, -0.006}, {0.05, 0.02, -0.006}, {0.05, 0.02, 0.002}};
  stroke.gap_threshold = 1e9;
  return stroke;
}

double metric(const PointResult& point, const std::string& name) {
  for (std::size_t i = 0; i < all_metrics().size(); ++i)
    if (all_metrics()[i].name == name) return point.metrics[i];
  ADD_FAILURE() << name;
  return 0.0;
}

SharedRunResult run(const std::vector<Scene>& scenes) {
  const Stroke stroke = a_drag();
  return *run_shared(scenes, starting_bed(scenes.front().bed), &stroke, all_metrics(), nullptr);
}

TEST(SharedRun, IsToTheBitWhatEachSceneGivesAlone) {
  std::vector<Scene> scenes(4, small_scene());
  scenes[1].force.k_s = 20'000.0;  // reaches the device's limit
  scenes[2].force.k_f = 100.0;
  scenes[2].force.drag = DragDirection::full;
  scenes[3].force.k_c = 40.0;
  scenes[3].device.max_force = 0.5;
  scenes[3].device.damping = 5.0;
  const SharedRunResult shared = run(scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    Simulation alone(scenes[i], starting_bed(scenes[i].bed), a_drag());
    const RunResult result = alone.run();
    const PointResult& point = shared.points[i];
    EXPECT_EQ(metric(point, "max_force"), result.device.max_force);
    EXPECT_EQ(metric(point, "mean_force"), result.device.mean_force);
    EXPECT_EQ(metric(point, "work"), result.device.absorbed_energy);
    EXPECT_EQ(metric(point, "returned_energy"), std::max(0.0, -result.device.least_absorbed_energy));
    EXPECT_EQ(metric(point, "passivity_margin"), result.device.least_passivity_margin);
    EXPECT_EQ(metric(point, "saturated_share"),
              static_cast<double>(result.device.saturated_ticks) / static_cast<double>(result.contact_ticks));
    EXPECT_EQ(metric(point, "moved_volume"), result.moved_volume);
    EXPECT_EQ(metric(point, "passes"), static_cast<double>(result.relaxation.passes));
    EXPECT_EQ(metric(point, "max_depth"), result.max_depth);
    EXPECT_TRUE((shared.surface.grid() == alone.bed().grid()).all());
  }
  EXPECT_GT(metric(shared.points[1], "saturated_share"), 0.0);
  EXPECT_NE(metric(shared.points[2], "work"), metric(shared.points[0], "work"));
}

TEST(SharedRun, EstimatesTheErrorOfEachSceneAsIfItHadBeenRunAlone) {
  for (const DeviceModel model : {DeviceModel::kinematic, DeviceModel::dynamic}) {
    std::vector<Scene> scenes(2, small_scene());
    scenes[1].force.k_s = 700.0;
    for (Scene& scene : scenes) scene.device.model = model;
    if (model == DeviceModel::dynamic) scenes.pop_back();
    const Stroke stroke = a_drag();
    const HeightField bed = starting_bed(scenes[0].bed);
    const SharedRunResult shared =
        *run_shared(scenes, bed, &stroke, all_metrics(), nullptr, SecondSolution::coarser);
    std::set<double> forces;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      Kept force(force_of);
      const Solution alone = solve(scenes[i], bed, stroke, {&force});
      const ErrorEstimate error =
          estimate_error(scenes[i], bed, stroke, alone, force, SecondSolution::coarser);
      const PointResult& point = shared.points[i];
      EXPECT_EQ(metric(point, "error_share"), error.height_share);
      EXPECT_EQ(metric(point, "error_height_rms"), error.height_rms);
      EXPECT_EQ(metric(point, "error_height_max"), error.height_max);
      EXPECT_EQ(metric(point, "error_force_rms"), error.force_rms);
      EXPECT_EQ(metric(point, "error_force_max"), error.force_max);
      EXPECT_GT(error.height_rms, 0.0);
      forces.insert(error.force_rms);
    }
    EXPECT_EQ(forces.size(), scenes.size()) << "each point's own";
  }
  EXPECT_TRUE(std::isnan(metric(run({small_scene()}).points[0], "error_share"))) << "not asked for";
}

TEST(SharedRun, AForceBeyondAnyNumberFailsItsOwnPointOnly) {
  std::vector<Scene> scenes(3, small_scene());
  scenes[0].force.k_s = 1e308;
  scenes[0].force.k_f = 1e308;
  scenes[0].device.max_force = 0.0;
  const SharedRunResult shared = run(scenes);
  EXPECT_EQ(shared.points[0].verdict, PointVerdict::unstable);
  EXPECT_NE(shared.points[0].reason.find("is too large for a number"), std::string::npos);
  EXPECT_TRUE(std::isnan(metric(shared.points[0], "work")));
  EXPECT_EQ(shared.points[1].verdict, PointVerdict::at_rest);
  EXPECT_EQ(shared.points[1].metrics[0], run({small_scene()}).points[0].metrics[0]);
}

TEST(SharedRun, VerdictsTellHowItWent) {
  Scene scene = small_scene();
  scene.relaxation.max_passes = 3;
  EXPECT_EQ(run({scene}).points[0].verdict, PointVerdict::not_at_rest);
  scene = small_scene();
  scene.device = ideal_device();
  scene.force.k_s = 1e6;
  scene.force.k_c = 100.0;
  scene.device.damping = 0.0;
  EXPECT_EQ(run({scene}).points[0].verdict, PointVerdict::unstable);
  scene = small_scene();
  scene.device.scale = 10.0;  // out of the bed
  const PointResult refused = run({scene}).points[0];
  EXPECT_EQ(refused.verdict, PointVerdict::refused);
  EXPECT_NE(refused.reason.find("outside the bed"), std::string::npos);
}

TEST(SharedRun, MeasuresTheSandAloneWithoutAStroke) {
  Scene scene = small_scene();
  scene.stroke.reset();
  scene.bed.surface.kind = SurfaceKind::cylinder;
  scene.bed.surface.radius = 0.05;
  scene.bed.surface.height = 0.03;
  const PointResult point =
      run_shared({scene}, starting_bed(scene.bed), nullptr, all_metrics(), nullptr)->points[0];
  EXPECT_EQ(point.verdict, PointVerdict::at_rest);
  EXPECT_GT(metric(point, "moved_volume"), 0.0);
  EXPECT_TRUE(std::isnan(metric(point, "mean_force")));
  EXPECT_TRUE(std::isnan(metric(point, "furrow_depth")));
  const double talus = std::tan(M_PI / 6);
  EXPECT_LE(metric(point, "slope_max_geometric"), std::atan(talus * 1.0824 * 1.002) * 180.0 / M_PI);
  EXPECT_LE(metric(point, "slope_max_law"),
            std::atan(talus * (1.0 + metric(point, "residual"))) * 180.0 / M_PI + 1e-9);
}

TEST(SharedRun, GivesEachSceneTheMarginOfItsDeviceWithoutAStroke) {
  std::vector<Scene> scenes(2, small_scene());
  for (Scene& scene : scenes) scene.stroke.reset();
  scenes[1].device.damping += 4.0;
  const SharedRunResult shared =
      *run_shared(scenes, starting_bed(scenes[0].bed), nullptr, all_metrics(), nullptr);
  for (std::size_t i = 0; i < scenes.size(); ++i)
    EXPECT_EQ(
        metric(shared.points[i], "passivity_margin"),
        Simulation(scenes[i], starting_bed(scenes[i].bed), std::nullopt).run().device.least_passivity_margin);
}

TEST(SharedRun, AFurrowIsAsWideAsItsToolAndTheGoldenSurfaceIsSubtracted) {
  const Scene scene = small_scene();
  const Stroke stroke = a_drag();
  const SharedRunResult first = run({scene});
  EXPECT_GT(metric(first.points[0], "furrow_depth"), 0.001);
  EXPECT_GT(metric(first.points[0], "rampart_height"), 0.0);
  EXPECT_NEAR(metric(first.points[0], "furrow_width"), 2.0 * scene.tool.radius, scene.tool.radius);
  const HeightField flat = starting_bed(scene.bed);
  const PointResult against_itself =
      run_shared({scene}, starting_bed(scene.bed), &stroke, all_metrics(), &first.surface)->points[0];
  EXPECT_EQ(metric(against_itself, "golden_max"), 0.0);
  const PointResult against_flat =
      run_shared({scene}, starting_bed(scene.bed), &stroke, all_metrics(), &flat)->points[0];
  EXPECT_EQ(metric(against_flat, "golden_max"), first.surface.grid().abs().maxCoeff());
  EXPECT_NEAR(metric(against_flat, "golden_volume"), 0.0, 1e-12);
}

/// Changes one setting after the other.
class Changer : public KeyVisitor {
 public:
  explicit Changer(int which) : left_(which) {}
  void section(const char* name, const char*) override { section_ = name; }
  bool optional_section(const char* name, bool present, const char* help) override {
    section(name, help);
    return present;
  }
  void number(const char* key, double& value, Range, const char*, const char*) override {
    if (mine(key)) value += 1.0;
  }
  void numbers(const char* key, double* values, int, Range, const char*, const char*) override {
    if (mine(key)) values[0] += 1.0;
  }
  void integers(const char* key, int* values, int, int, int, const char*) override {
    if (mine(key)) values[0] += 1;
  }
  void flag(const char* key, bool& value, const char*) override {
    if (mine(key)) value = !value;
  }
  void text(const char* key, std::string& value, const char*) override {
    if (mine(key)) value += "x";
  }
  void choice(const char* key, int& value, const std::vector<std::string>& names, const char*) override {
    if (mine(key)) value = (value + 1) % static_cast<int>(names.size());
  }
  int tables(const char*, int count) override { return count; }
  void table(const char* list, int place, const char*) override {
    section_ = list + ("." + std::to_string(place));
  }
  bool given(const char*) override { return true; }
  void require(const char*) override {}
  void profile(const char*, std::vector<double>&, Range, const char*, const char*) override {}
  void points(const char*, std::vector<Eigen::Vector2d>&, const char*, const char*) override {}
  void texts(const char*, std::vector<std::string>&, const char*) override {}
  bool reads() const override { return false; }
  const std::string& changed() const { return changed_; }

 private:
  bool mine(const char* key) {
    if (left_-- != 0) return false;
    changed_ = section_ + "." + key;
    return true;
  }
  int left_;
  std::string section_, changed_;
};

/// Sections of the settings that points may differ in and still share their sand.
std::set<std::string> shared_settings(const Scene& scene) {
  std::set<std::string> shared;
  for (int which = 0;; ++which) {
    Scene other = scene;
    Changer changer(which);
    describe_scene(changer, other);
    if (changer.changed().empty()) return shared;
    if (sand_key(other, nullptr) == sand_key(scene, nullptr)) shared.insert(changer.changed());
  }
}

TEST(SandKey, OnlyWhatSandDoesNotFeelIsShared) {
  Scene scene = small_scene();
  scene.stroke.reset();  // the key has its content instead
  std::set<std::string> shared = shared_settings(scene);
  std::erase_if(shared, [](const std::string& key) { return key.starts_with("output."); });
  EXPECT_EQ(shared,
            (std::set<std::string>{"model.preset", "force.k_s", "force.k_c", "force.k_f", "force.drag",
                                   "device.preset", "device.max_force", "device.resolution", "device.mass",
                                   "device.damping", "device.hand_stiffness", "device.hand_damping"}));
  scene.device.model = DeviceModel::dynamic;  // pushed about by the sand
  shared = shared_settings(scene);
  std::erase_if(shared, [](const std::string& key) { return key.starts_with("output."); });
  EXPECT_EQ(shared, std::set<std::string>{"model.preset"});
}

TEST(SandKey, TellsStrokesApart) {
  const Scene scene = small_scene();
  const SweepStroke one{a_drag(), "0123"}, other{a_drag(), "4567"};
  EXPECT_EQ(sand_key(scene, &one), sand_key(scene, &one));
  EXPECT_NE(sand_key(scene, &one), sand_key(scene, &other));
}

}  // namespace
}  // namespace sandstroke
