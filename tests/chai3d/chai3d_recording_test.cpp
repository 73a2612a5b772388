#include <gtest/gtest.h>

#include "chai3d/chai3d_device.h"
#include "fake_chai3d.h"
#include "record/recorder.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

/// A whole recording, of 0.1 s and without force.
RecordingReport record_without_force(const std::shared_ptr<FakeChai3d>& fake) {
  const TestFolder folder;
  RecorderSettings settings;
  settings.lock_memory = false;  // of the whole test program
  settings.servo.duration = 0.1;
  settings.watchdog = settings.servo.silence = 1e3;  // whatever the machine does
  Chai3dDevice device(fake);
  return record(device, nullptr, settings, {}, folder.path() / "a.h5.recording", {});
}

TEST(Chai3dRecording, LeavesMotorsAndCalibrationAloneWithoutForce) {
  const auto fake = std::make_shared<FakeChai3d>();
  const RecordingReport report = record_without_force(fake);
  EXPECT_EQ(report.footer.reason, StopReason::duration);
  EXPECT_EQ(report.header.device.model, "fake");
  EXPECT_EQ(fake->calls(), (std::vector<std::string>{"open", "motors off", "close"}));
}

TEST(Chai3dRecording, GoesOnWithAPhantomThoughEachReadingSaysThatItFailed) {
  const auto fake = std::make_shared<FakePhantom>(chai3d::C_HAPTIC_DEVICE_PHANTOM_TOUCH);
  const TickCounts ticks = record_without_force(fake).footer.ticks;
  EXPECT_EQ(ticks.elapsed, 100);
  EXPECT_EQ(ticks.recorded + ticks.skipped, 100);
  EXPECT_GT(ticks.recorded, 0);
}

}  // namespace
}  // namespace sandstroke
