#include "sim/scene.h"

#include <gtest/gtest.h>

#include <tuple>

#include "core/error.h"
#include "core/machine.h"
#include "sand/all_laws.h"

namespace sandstroke {
namespace {

/// Larger than any machine's memory, cell by cell.
Scene huge_scene() {
  Scene scene;
  scene.bed.cols = scene.bed.rows = 65536;
  scene.bed.width = scene.bed.depth = 0.002 * 65536;
  return scene;
}

TEST(CheckScene, SandThatRestsByRuleNeedsNoMemory) {
  using enum SurfaceKind;
  for (const auto kind : {flat, cylinder, cone, cliff, ripples}) {
    Scene scene = huge_scene();
    scene.bed.surface.kind = kind;
    EXPECT_NO_THROW(check_scene(scene, "huge.toml")) << static_cast<int>(kind);
  }
  Scene bumps = huge_scene();
  bumps.bed.surface.kind = noise;
  bumps.bed.surface.wavelength = 1.0;  // far less steep than the talus
  EXPECT_NO_THROW(check_scene(bumps, "huge.toml"));
}

TEST(CheckScene, SandThatWillMoveMustFitTheMemory) {
  if (physical_memory() > 100e9) GTEST_SKIP() << "this machine has memory for it";
  const auto refused = [](const Scene& scene) {
    try {
      check_scene(scene, "huge.toml");
      ADD_FAILURE() << "not refused";
    } catch (const Error& failure) {
      EXPECT_EQ(failure.kind(), ErrorKind::input);
      for (const char* part : {"huge.toml", "bed.cells = [65536, 65536]", "GB of memory"})
        EXPECT_NE(std::string(failure.what()).find(part), std::string::npos) << failure.what();
    }
  };
  Scene rough = huge_scene();
  rough.bed.surface.kind = SurfaceKind::noise;
  rough.bed.surface.wavelength = 0.0;
  refused(rough);
  Scene read = huge_scene();
  read.bed.surface.kind = SurfaceKind::file;
  read.bed.surface.file = "run.h5";
  refused(read);
}

TEST(CheckScene, ImplicitDragIsForAForceThatActsAtOnce) {
  Scene scene;
  scene.device.model = DeviceModel::dynamic;
  scene.device.drag = DragVelocity::implicit;
  EXPECT_NO_THROW(check_scene(scene, "late.toml"));
  for (const auto& [delay, dropped] : {std::pair(1, 0.0), std::pair(0, 0.1)}) {
    scene.device.delay = delay;
    scene.device.dropped_ticks = dropped;
    try {
      check_scene(scene, "late.toml");
      ADD_FAILURE() << "not refused";
    } catch (const Error& failure) {
      EXPECT_EQ(failure.kind(), ErrorKind::input);
      for (const char* part : {"late.toml", "device.drag", "device.delay = 0", "device.dropped_ticks = 0"})
        EXPECT_NE(std::string(failure.what()).find(part), std::string::npos) << failure.what();
    }
  }
}

TEST(CheckScene, AToolThatNoStrokeUsesNeedNotFitTheBed) {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.01;  // less than the rampart of the tool
  scene.bed.cols = scene.bed.rows = 10;
  EXPECT_NO_THROW(check_scene(scene, "scene"));
  scene.stroke.emplace();
  scene.stroke->file = "in memory";
  EXPECT_THROW(check_scene(scene, "scene"), Error);
}

TEST(CheckScene, CellsMustHaveVolumesThatAreNumbers) {
  for (const double dx : {1e-308, 1e-160, 1e-101, 1e101, 1e300}) {
    Scene scene;
    scene.bed.cols = scene.bed.rows = 10;
    scene.bed.width = scene.bed.depth = 10 * dx;
    EXPECT_THROW(check_scene(scene, "scene"), Error) << dx;
  }
}

/// True if a scene with a stroke is taken.
bool is_taken(const Scene& scene) {
  try {
    check_scene(scene, "scene");
    return true;
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::input);
    return false;
  }
}

Scene stroked_scene(double width, int cols, double depth, int rows) {
  Scene scene;
  scene.bed.width = width;
  scene.bed.cols = cols;
  scene.bed.depth = depth;
  scene.bed.rows = rows;
  scene.stroke.emplace();
  scene.stroke->file = "in memory";
  return scene;
}

TEST(CheckScene, ASphereMustBeTwoCellsWide) {
  Scene scene = stroked_scene(0.3, 30, 0.2, 20);  // cells of 10 mm
  for (const auto& [radius, taken] : {std::pair{0.0095, false}, {0.0105, true}}) {
    scene.tool.radius = radius;
    EXPECT_EQ(is_taken(scene), taken) << radius;
  }
}

TEST(CheckScene, TeethOfARakeMayTouchButNotOverlap) {
  Scene scene = stroked_scene(0.3, 300, 0.2, 200);
  scene.preset = ModelPreset::accurate;
  apply_model_preset(scene);
  scene.tool.shape = ToolShape::rake;
  scene.tool.radius = 0.004;
  for (const auto& [spacing, teeth, taken] :
       {std::tuple{0.0079, 3, false}, {0.0079, 1, true}, {0.008, 3, true}, {0.02, 3, true}}) {
    scene.tool.spacing = spacing;
    scene.tool.teeth = teeth;
    EXPECT_EQ(is_taken(scene), taken) << spacing << " " << teeth;
  }
}

TEST(CheckScene, ToolAndRampartMustFitTheShorterSide) {
  for (const bool wide : {true, false}) {
    Scene scene = wide ? stroked_scene(0.3, 150, 0.2, 100) : stroked_scene(0.2, 100, 0.3, 150);
    scene.tool.radius = 0.01;
    const double radii = filter::reach(1.0);  // of rampart and tool
    for (const auto& [ratio, taken] : {std::pair{0.95, true}, {1.05, false}}) {
      scene.tool.radius = ratio * 0.1 / radii;
      EXPECT_EQ(is_taken(scene), taken) << ratio;
    }
  }
}

TEST(CheckScene, CellsMustBeSquareToABillionth) {
  for (const auto& [longer, taken] :
       {std::pair{0.95e-9, true}, {1.05e-9, false}, {-0.95e-9, true}, {-1.05e-9, false}})
    EXPECT_EQ(is_taken(stroked_scene(0.3, 150, 0.2 * (1.0 + longer), 100)), taken) << longer;
}

TEST(CheckScene, OnlyThePapersLawTakesMoreThanAQuarter) {
  Scene scene = stroked_scene(0.3, 150, 0.2, 100);
  for (const RelaxationLaw law : all_laws)
    for (const double share : {0.2375, 0.25, 0.2625}) {
      scene.relaxation.law = law;
      scene.relaxation.share = share;
      EXPECT_EQ(is_taken(scene), law == RelaxationLaw::paper || share <= 0.25) << share;
    }
}

TEST(CheckScene, CellsAreBetweenTheLimitsOfTheirVolumes) {
  for (const auto& [dx, taken] :
       {std::pair{0.95e-100, false}, {1.05e-100, true}, {0.95e100, true}, {1.05e100, false}}) {
    Scene scene;
    scene.bed.cols = scene.bed.rows = 10;
    scene.bed.width = scene.bed.depth = 10 * dx;
    EXPECT_EQ(is_taken(scene), taken) << dx;
  }
}

TEST(CheckScene, FilesThatAreNeededMustBeNamed) {
  Scene scene = stroked_scene(0.3, 150, 0.2, 100);
  EXPECT_TRUE(is_taken(scene));
  scene.stroke->file.clear();
  EXPECT_FALSE(is_taken(scene));
  scene.stroke.reset();
  EXPECT_TRUE(is_taken(scene));
  scene.bed.surface.kind = SurfaceKind::file;
  EXPECT_FALSE(is_taken(scene));
  scene.bed.surface.file = "run.h5";
  EXPECT_TRUE(is_taken(scene));
}

TEST(ModelPreset, SetsEachOfItsChoicesAndBackAgain) {
  Scene scene;
  for (const ModelPreset preset : {ModelPreset::accurate, ModelPreset::paper}) {
    const bool paper = preset == ModelPreset::paper;
    scene.preset = preset;
    apply_model_preset(scene);
    EXPECT_EQ(scene.tool.profile, paper ? ToolProfile::paper : ToolProfile::sphere);
    EXPECT_EQ(scene.tool.solid, !paper);
    EXPECT_EQ(scene.displacement.deposit, paper ? Deposit::ring : Deposit::outward);
    EXPECT_EQ(scene.relaxation.law, paper ? RelaxationLaw::paper : RelaxationLaw::faces);
    EXPECT_EQ(scene.relaxation.method, paper ? RelaxationMethod::passes : RelaxationMethod::rkl);
    EXPECT_EQ(scene.relaxation.rate, paper ? 60.0 : 0.0);
    EXPECT_EQ(scene.relaxation.way, paper ? 0.0 : 0.4);
    EXPECT_EQ(scene.relaxation.way_at_rim, paper ? 0.0 : 0.05);
  }
}

}  // namespace
}  // namespace sandstroke
