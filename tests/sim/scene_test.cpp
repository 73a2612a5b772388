#include "sim/scene.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/machine.h"

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

TEST(CheckScene, AWayThatIsNoneIsRefused) {
  Scene scene;
  for (const double travel : {0.0, 0.01, 2.0, 1e9}) {
    scene.relaxation.travel = travel;
    EXPECT_NO_THROW(check_scene(scene, "scene.toml")) << travel;
  }
  for (const double travel : {1e-300, 1e-16, 0.0099}) {  // sand would slip for ever
    scene.relaxation.travel = travel;
    try {
      check_scene(scene, "scene.toml");
      ADD_FAILURE() << travel;
    } catch (const Error& failure) {
      EXPECT_NE(std::string(failure.what()).find("relaxation.travel"), std::string::npos) << failure.what();
    }
  }
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

}  // namespace
}  // namespace sandstroke
