#include "chai3d/chai3d_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <latch>
#include <limits>
#include <thread>

#include "core/error.h"
#include "devices/CHapticDeviceHandler.h"
#include "fake_chai3d.h"
#include "system/CThread.h"

namespace sandstroke {
namespace {

using Calls = std::vector<std::string>;
using Eigen::Vector3d;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Opened {
  explicit Opened(chai3d::cHapticDeviceModel model = chai3d::C_HAPTIC_DEVICE_OMEGA_3)
      : fake(std::make_shared<FakeChai3d>(model)), device(fake) {
    device.open();
  }
  std::shared_ptr<FakeChai3d> fake;
  Chai3dDevice device;
};

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Chai3dLibrary, HasClassesOfTheSizeThatItsHeadersSayHere) {
  // Without LINUX defined this class is smaller here than in the library, whose constructor then writes past
  // it.
  using chai3d::cThread;
  constexpr unsigned char untouched = 0xa5;
  alignas(cThread) unsigned char memory[2 * sizeof(cThread)];
  std::fill(std::begin(memory), std::end(memory), untouched);
  cThread* thread = new (memory) cThread;
  EXPECT_EQ(thread->getPriority(), chai3d::CTHREAD_PRIORITY_GRAPHICS);
  EXPECT_TRUE(std::all_of(memory + sizeof(cThread), std::end(memory),
                          [](unsigned char byte) { return byte == untouched; }));
}

TEST(Chai3dLibrary, ListsNothingWithoutADeviceAndSaysWhatToDo) {
  if (chai3d::cHapticDeviceHandler().getNumDevices() > 0)
    GTEST_SKIP() << "a haptic device is connected: what is said without one is not tested";
  EXPECT_TRUE(list_chai3d_devices().empty());
  const std::string sentence = refusal([] { make_chai3d_device(0); });
  EXPECT_NE(sentence.find("CHAI3D finds no haptic device: connect it"), std::string::npos) << sentence;
}

TEST(Chai3dLibrary, GivesOutADummyThatIsRefused) {
  chai3d::cHapticDeviceHandler handler;
  chai3d::cGenericHapticDevicePtr dummy;
  ASSERT_FALSE(handler.getDevice(dummy, chai3d::C_MAX_HAPTIC_DEVICES));
  ASSERT_TRUE(dummy);
  const std::string sentence = refusal([&] { Chai3dDevice{dummy}; });
  EXPECT_NE(sentence.find("\"no device\" is not a real haptic device"), std::string::npos) << sentence;
}

TEST(Chai3dDevice, RefusesAVirtualOne) {
  const auto fake = std::make_shared<FakeChai3d>(chai3d::C_HAPTIC_DEVICE_VIRTUAL);
  EXPECT_NE(refusal([&] { Chai3dDevice{fake}; }), "");
}

TEST(Chai3dDevice, SaysOfItselfWhatCHAI3DSays) {
  Opened opened;
  const DeviceSpecification& specification = opened.device.specification();
  EXPECT_EQ(specification.model, "fake");
  EXPECT_EQ(specification.manufacturer, "nobody");
  EXPECT_EQ(specification.frame, "device");
  EXPECT_EQ(specification.max_force, 12.0);
  EXPECT_EQ(specification.max_stiffness, 5000.0);
  EXPECT_EQ(specification.max_damping, 30.0);
  EXPECT_EQ(specification.workspace_radius, 0.075);
  EXPECT_TRUE(specification.measures_velocity);
}

TEST(Chai3dDevice, HasNoForceWhereItHasNoMotors) {
  const auto tracker = std::make_shared<FakeChai3d>(chai3d::C_TRACKER_DEVICE_LEAP);
  tracker->m_specifications.m_actuatedPosition = false;
  EXPECT_EQ(Chai3dDevice(tracker).specification().max_force, 0.0);
}

TEST(Chai3dDevice, OpensWithoutMovingOrForce) {
  Opened opened;
  EXPECT_EQ(opened.fake->calls(), Calls{"open"});
}

TEST(Chai3dDevice, ThatDoesNotOpenSaysWhatToDo) {
  const auto fake = std::make_shared<FakeChai3d>();
  fake->opens = false;
  Chai3dDevice device(fake);
  const std::string sentence = refusal([&] { device.open(); });
  EXPECT_NE(sentence.find("the haptic device fake cannot be opened: end other programs"), std::string::npos);
  DeviceReading reading;
  EXPECT_FALSE(device.read(0.0, reading));
  EXPECT_FALSE(device.command(Vector3d::UnitX()));
  device.release();
  device.close();
  EXPECT_EQ(fake->calls(), Calls{"open"});
}

TEST(Chai3dDevice, CalibratesWhatNeedsItAndLeavesMotorsOff) {
  Opened opened;
  opened.device.calibrate();
  EXPECT_EQ(opened.fake->calls(), (Calls{"open", "calibrate", "motors off"}));
  opened.fake->calibrates = false;
  EXPECT_NE(refusal([&] { opened.device.calibrate(); }), "");
  EXPECT_FALSE(opened.fake->motors());
}

TEST(Chai3dDevice, SaysWhetherItIsCalibratedWhereItsDriverDoes) {
  Opened opened;
  EXPECT_EQ(opened.device.is_calibrated(), std::nullopt) << "only Force Dimension's driver says";
  bool is_right = false;
  Chai3dDevice device(std::make_shared<FakeChai3d>(), [&] { return is_right; });
  device.open();
  EXPECT_EQ(device.is_calibrated(), false);
  is_right = true;
  device.calibrate();
  EXPECT_EQ(device.is_calibrated(), true);
}

TEST(Chai3dDevice, GivesOutWhatCHAI3DRead) {
  Opened opened;
  opened.fake->position.set(0.1, -0.2, 0.3);
  opened.fake->velocity.set(-1.0, 2.0, -3.0);
  opened.fake->switches = 0x80000005u;
  opened.fake->rotation.set(0, -1, 0, 1, 0, 0, 0, 0, 1);  // +x to +y
  DeviceReading reading;
  ASSERT_TRUE(opened.device.read(0.0, reading));
  EXPECT_EQ(reading.position, Vector3d(0.1, -0.2, 0.3));
  EXPECT_EQ(reading.velocity, Vector3d(-1.0, 2.0, -3.0));
  EXPECT_EQ(reading.switches, 0x80000005u);
  EXPECT_LT((reading.orientation * Vector3d::UnitX() - Vector3d::UnitY()).norm(), 1e-15);
}

TEST(Chai3dDevice, GivesNothingWhereAnythingOfAReadingIsMissing) {
  for (bool FakeChai3d::*given :
       {&FakeChai3d::gives_position, &FakeChai3d::gives_velocity, &FakeChai3d::gives_switches}) {
    Opened opened;
    (*opened.fake).*given = false;
    DeviceReading reading;
    EXPECT_FALSE(opened.device.read(0.0, reading));
    (*opened.fake).*given = true;
    EXPECT_TRUE(opened.device.read(0.0, reading));
  }
}

TEST(Chai3dDevice, GivesNothingOnceUnplugged) {
  for (const auto model : {chai3d::C_HAPTIC_DEVICE_OMEGA_3, chai3d::C_HAPTIC_DEVICE_PHANTOM_TOUCH}) {
    Opened opened(model);
    opened.fake->unplug();
    DeviceReading reading;
    EXPECT_FALSE(opened.device.read(0.0, reading));
  }
}

TEST(Chai3dDevice, TakesAPhantomsPositionThoughTheReadingSaysThatItFailed) {
  for (const auto model : {chai3d::C_HAPTIC_DEVICE_PHANTOM_TOUCH, chai3d::C_HAPTIC_DEVICE_PHANTOM_OMNI,
                           chai3d::C_HAPTIC_DEVICE_PHANTOM_DESKTOP, chai3d::C_HAPTIC_DEVICE_PHANTOM_15_6DOF,
                           chai3d::C_HAPTIC_DEVICE_PHANTOM_30_6DOF, chai3d::C_HAPTIC_DEVICE_PHANTOM_OTHER}) {
    const auto fake = std::make_shared<FakePhantom>(model);
    Chai3dDevice device(fake);
    device.open();
    fake->position.set(0.01, 0.02, 0.03);
    DeviceReading reading;
    ASSERT_TRUE(device.read(0.0, reading)) << model;
    EXPECT_EQ(reading.position, Vector3d(0.01, 0.02, 0.03));
  }
}

TEST(Chai3dDevice, SwitchesMotorsOnForTheFirstForceThatIsNotZero) {
  Opened opened;
  for (int tick = 0; tick < 3; ++tick) EXPECT_TRUE(opened.device.command(Vector3d::Zero()));
  EXPECT_EQ(opened.fake->calls(), Calls{"open"});
  EXPECT_TRUE(opened.device.command({1.0, -2.0, 3.0}));
  EXPECT_EQ(opened.fake->held(), Vector3d(1.0, -2.0, 3.0));
  EXPECT_TRUE(opened.device.command(Vector3d::Zero()));
  EXPECT_EQ(opened.fake->held(), Vector3d::Zero());
  EXPECT_EQ(opened.fake->calls(), (Calls{"open", "motors on", "force", "force"}));
}

TEST(Chai3dDevice, SendsAForceAsItIs) {  // also one beyond the device's: cutting it is the guard's part
  Opened opened;
  EXPECT_TRUE(opened.device.command({0.0, 0.0, 50.0}));
  EXPECT_EQ(opened.fake->held(), Vector3d(0.0, 0.0, 50.0));
}

TEST(Chai3dDevice, MakesAForceThatIsNoNumberNone) {
  Opened opened;
  EXPECT_FALSE(opened.device.command({0.0, nan, 0.0}));
  EXPECT_EQ(opened.fake->calls(), Calls{"open"});
  ASSERT_TRUE(opened.device.command(Vector3d::UnitX()));
  EXPECT_FALSE(opened.device.command({std::numeric_limits<double>::infinity(), 0.0, 0.0}));
  EXPECT_EQ(opened.fake->held(), Vector3d::Zero());
}

TEST(Chai3dDevice, SaysWhereAForceWasNotTaken) {
  Opened opened;
  opened.fake->takes_force = false;
  EXPECT_FALSE(opened.device.command(Vector3d::UnitX()));
}

TEST(Chai3dDevice, TakesNoForceForGivenWhileItsMotorsDoNotSwitchOn) {
  Opened opened;
  opened.fake->switches_on = false;
  for (int tick = 0; tick < 3; ++tick) EXPECT_FALSE(opened.device.command(Vector3d::UnitX()));
  EXPECT_EQ(opened.fake->held(), Vector3d::Zero());
  opened.fake->switches_on = true;
  EXPECT_TRUE(opened.device.command(Vector3d::UnitX()));
  EXPECT_TRUE(opened.fake->motors());
  EXPECT_EQ(opened.fake->held(), Vector3d::UnitX());
}

TEST(Chai3dDevice, HasNoForceAndNoMotorsAfterRelease) {
  Opened opened;
  ASSERT_TRUE(opened.device.command(Vector3d::UnitX()));
  opened.device.release();
  EXPECT_EQ(opened.fake->held(), Vector3d::Zero());
  EXPECT_FALSE(opened.fake->motors());
  EXPECT_FALSE(opened.device.command(Vector3d::UnitX()));
  EXPECT_TRUE(opened.device.command(Vector3d::Zero()));  // it has that
  EXPECT_EQ(opened.fake->held(), Vector3d::Zero());
  EXPECT_FALSE(opened.fake->motors());
  DeviceReading reading;
  EXPECT_TRUE(opened.device.read(0.0, reading));
}

TEST(Chai3dDevice, IsReleasedWhileACommandHangs) {
  Opened opened;
  std::latch hangs(1), released(1);
  opened.fake->on_force = [&](const Vector3d& force) {
    if (force.isZero(0.0)) return;
    hangs.count_down();
    released.wait();  // and takes the force afterwards
  };
  std::thread loop([&] { opened.device.command(Vector3d::UnitX()); });
  hangs.wait();
  opened.device.release();
  EXPECT_FALSE(opened.fake->motors());
  released.count_down();
  loop.join();
  EXPECT_EQ(opened.fake->held(), Vector3d::Zero());
  EXPECT_FALSE(opened.fake->motors());
}

TEST(Chai3dDevice, IsReleasedWhateverTheLoopIsDoing) {
  for (int round = 0; round < 200; ++round) {
    Opened opened;
    std::latch start(2);
    std::thread loop([&] {
      start.arrive_and_wait();
      for (int tick = 0; tick < 20; ++tick) opened.device.command({1.0 + tick, 0.0, 0.0});
    });
    start.arrive_and_wait();
    opened.device.release();
    loop.join();
    ASSERT_EQ(opened.fake->held(), Vector3d::Zero());
    ASSERT_FALSE(opened.fake->motors());
  }
}

TEST(Chai3dDevice, ClosesOnceAndWithoutForce) {
  for (const auto model : {chai3d::C_HAPTIC_DEVICE_OMEGA_3, chai3d::C_HAPTIC_DEVICE_PHANTOM_TOUCH}) {
    const auto fake = std::make_shared<FakeChai3d>(model);
    {
      Chai3dDevice device(fake);
      device.close();  // not open: nothing
      device.open();
      ASSERT_TRUE(device.command(Vector3d::UnitX()));
      device.close();
      device.close();
      DeviceReading reading;
      EXPECT_FALSE(device.read(0.0, reading));
      EXPECT_FALSE(device.command(Vector3d::UnitX()));
      device.release();
    }
    EXPECT_EQ(fake->held(), Vector3d::Zero());
    EXPECT_FALSE(fake->motors());
    EXPECT_EQ(fake->calls(),
              (Calls{"open", "motors on", "force", "force", "motors off", "motors off", "close"}));
  }
}

TEST(Chai3dDevice, ClosesWhenItIsGone) {
  const auto fake = std::make_shared<FakeChai3d>();
  {
    Chai3dDevice device(fake);
    device.open();
    ASSERT_TRUE(device.command(Vector3d::UnitX()));
  }
  EXPECT_EQ(fake->held(), Vector3d::Zero());
  EXPECT_EQ(fake->calls().back(), "close");
}

TEST(Chai3dDevice, WorksAgainWhenOpenedAgain) {
  Opened opened;
  opened.device.release();
  opened.device.close();
  opened.device.open();
  EXPECT_TRUE(opened.device.command(Vector3d::UnitX()));
  EXPECT_EQ(opened.fake->held(), Vector3d::UnitX());
  EXPECT_TRUE(opened.fake->motors());
}

}  // namespace
}  // namespace sandstroke
