#include "view/pointer_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "record/fake_device.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t ms = 1'000'000;  // ns

Scene scene_of_a_slope() {
  Scene scene;
  scene.tool.radius = 0.02;
  scene.stroke.emplace();
  scene.stroke->placement.scale = 2.0;
  scene.stroke->placement.rotate_z = 30.0;
  scene.stroke->placement.offset = {0.1, -0.2, 0.05};
  scene.device.scale = 4.0;
  scene.device.offset = {0.01, 0.02, 0.03};
  return scene;
}

/// A plane that falls along x, 0.4 m x 0.2 m.
HeightField slope() {
  HeightGrid heights(20, 40);
  for (int row = 0; row < 20; ++row)
    for (int col = 0; col < 40; ++col) heights(row, col) = -0.1 * (col - 19.5) * 0.01;
  return {heights, 0.01};
}
constexpr double highest = 0.0195, radius = 0.02, hover = highest + radius;

/// A pointer in the hand of a test, at 1 kHz.
class Hand {
 public:
  /// Lets the time go on; where the tip is then in the bed.
  Vector3d wait(std::int64_t time) {
    for (const std::int64_t end = time_ + time; time_ < end;) {
      time_ += ms;
      clock_.add(ms);
      now_ = tip();
      lowest_ = std::min(lowest_, now_.z());
    }
    return now_;
  }
  void point(double x, double y, double pressure, std::int64_t delay = 0, std::uint32_t switches = 0) {
    const PointerSample sample{1e-6 * static_cast<double>(time_ + page_clock), static_cast<float>(x),
                               static_cast<float>(y), static_cast<float>(pressure), switches};
    device.take({&sample, 1}, clock_.now() + delay);
  }
  std::uint32_t switches() {
    DeviceReading reading;
    return device.read(1e-9 * static_cast<double>(time_), reading) ? reading.switches : 0;
  }
  Vector3d tip() {
    DeviceReading reading;
    if (!device.read(1e-9 * static_cast<double>(time_), reading))
      return Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(reading.velocity, Vector3d::Zero());
    const PointPlacement placement = point_placement(scene.stroke->placement, device.specification().frame);
    return tip_of(scene.device, placement.position(reading.position));
  }
  /// m, that the tip came to since the last time it was asked.
  double lowest() { return std::exchange(lowest_, 1.0); }

  static constexpr std::int64_t page_clock = 777'777 * ms;
  Scene scene = scene_of_a_slope();

 private:
  FakeClock clock_;
  std::int64_t time_ = 0;
  double lowest_ = 1.0;
  Vector3d now_ = Vector3d::Zero();

 public:
  PointerDevice device{scene, slope(), clock_};
};

TEST(PointerDevice, SaysHonestlyWhatItIs) {
  Hand hand;
  const DeviceSpecification& said = hand.device.specification();
  EXPECT_TRUE(said.model.starts_with("pointer"));
  EXPECT_NE(said.model.find("60 to 120 Hz"), std::string::npos);
  EXPECT_NE(said.model.find(std::to_string(PointerDevice::latency / ms) + " ms"), std::string::npos);
  EXPECT_EQ(said.max_force, any_force);
  EXPECT_FALSE(said.hand_feels);
  EXPECT_FALSE(said.measures_velocity);
  EXPECT_FALSE(hand.device.duration());
  EXPECT_EQ(hand.device.scale().radius, radius);
}

TEST(PointerDevice, NothingIsReadBeforeAPointerIsThereAndThenItAppearsOutOfTheSand) {
  Hand hand;
  EXPECT_TRUE(std::isnan(hand.wait(1000 * ms).z()));
  EXPECT_GT(hand.device.longest_silence(), 1e6);  // and is not lost for it
  hand.point(0.0625, 0.03125, 0.0);               // numbers that are the same in single precision
  EXPECT_LT((hand.wait(ms) - Vector3d(0.0625, 0.03125, hover)).norm(), 1e-12);
  EXPECT_LT((hand.wait(1000 * ms) - Vector3d(0.0625, 0.03125, hover)).norm(), 1e-12);
}

TEST(PointerDevice, ARepeatedPositionIsNoMotion) {
  Hand hand;
  hand.point(0.0, 0.0, 0.5);
  const Vector3d there = hand.wait(500 * ms);
  hand.point(0.0, 0.0, 0.5);  // a browser does so, right before what moves
  hand.wait(ms);
  hand.point(0.03, 0.0, 0.5);
  double fastest = 0.0;  // m per tick
  Vector3d before = there;
  for (int tick = 0; tick < 200; ++tick) {
    const Vector3d now = hand.wait(ms);
    fastest = std::max(fastest, (now - before).head<2>().norm());
    before = now;
  }
  EXPECT_NEAR(before.x(), 0.03, 1e-6);
  EXPECT_LT(fastest, 0.03 * 1.6 / 16.0);  // within a sample's time, not within a tick
}

TEST(PointerDevice, IsWhereThePointerWasALatencyAgo) {
  Hand hand;
  const auto x_at = [](std::int64_t k) { return -0.1 + 0.002 * static_cast<double>(k); };
  for (std::int64_t k = 0; k < 80; ++k) {
    hand.point(x_at(k), 0.05, 0.5);
    const Vector3d tip = hand.wait(16 * ms);
    if (k < 8) continue;
    // The tip goes at the constant speed of 0.002 m in 16 ms.
    const double x = x_at(k) + 0.002 * (1.0 - static_cast<double>(PointerDevice::latency) / (16.0 * ms));
    EXPECT_NEAR(tip.x(), x, 1e-8);  // of a float's rounding
    EXPECT_NEAR(tip.y(), 0.05, 1e-8);
    EXPECT_NEAR(tip.z(), -0.1 * x - 0.5 * hand.device.scale().depth, 1e-8);  // below the slope of the start
  }
}

TEST(PointerDevice, APointerKeptPressedDoesNotSink) {
  Hand hand;
  hand.point(0.0, 0.0, 1.0);
  const Vector3d once = hand.wait(200 * ms);
  EXPECT_NEAR(once.z(), -hand.device.scale().depth, 1e-9);
  EXPECT_LT((hand.wait(5000 * ms) - once).norm(), 1e-12);
}

TEST(PointerDevice, GoesDownAndUpWhereItIsPressedAndNotOnItsWayThere) {
  Hand hand;
  hand.point(-0.15, 0.0, 0.7);
  hand.wait(300 * ms);
  hand.point(-0.15, 0.0, 0.0);
  hand.wait(300 * ms);
  for (const double pause : {16.0, 300.0}) {
    hand.point(0.15, 0.05, 1.0);  // a finger: set down elsewhere
    for (int k = 0; k < 300; ++k) {
      const Vector3d tip = hand.wait(ms);
      EXPECT_TRUE(tip.z() >= highest || (tip.head<2>() - Eigen::Vector2d(0.15, 0.05)).norm() < 1e-6) << k;
    }
    hand.point(-0.15, 0.0, 0.0);  // and gone, without a word of where it was lifted
    for (int k = 0; k < static_cast<int>(pause); ++k) {
      const Vector3d tip = hand.wait(ms);
      EXPECT_TRUE(tip.z() >= highest || (tip.head<2>() - Eigen::Vector2d(0.15, 0.05)).norm() < 1e-6) << k;
    }
  }
}

TEST(PointerDevice, IsLiftedWhereItsPageIsGoneAndTakesTheClockOfTheNext) {
  Hand hand;
  hand.point(0.1, 0.0, 1.0);
  hand.wait(200 * ms);
  hand.device.leave();
  EXPECT_LT((hand.wait(200 * ms) - Vector3d(0.1, 0.0, hover)).norm(), 1e-7);
  const PointerSample other{5.0, 0.0f, 0.0f, 1.0f, 0};  // a clock that has just begun
  hand.device.take({&other, 1});
  EXPECT_NEAR(hand.wait(200 * ms).z(), -hand.device.scale().depth, 1e-9);
}

TEST(PointerDevice, StaysOnTheBedWhateverAPageSends) {
  Hand hand;
  for (const double far : {1e30, -1e30}) {
    hand.point(far, far, far);
    const Vector3d tip = hand.wait(300 * ms);
    EXPECT_LE(std::abs(tip.x()), 0.2);
    EXPECT_LE(std::abs(tip.y()), 0.1);
    EXPECT_LE(tip.z(), hover + 1e-12);
    EXPECT_GE(tip.z(), -highest - hand.device.scale().depth - 1e-9);
  }
  for (const double time : {1e300, -1e300, 0.0}) {
    const PointerSample sample{time, 0.0f, 0.0f, 0.5f, 0};
    hand.device.take({&sample, 1});
    EXPECT_TRUE(hand.wait(10 * ms).allFinite());
  }
}

TEST(PointerDevice, AMessageThatIsLateDoesNotMoveItsSamples) {
  Hand even, uneven;
  for (int k = 0; k < 200; ++k) {
    even.point(0.001 * k - 0.1, 0.0, 0.0);
    uneven.point(0.001 * k - 0.1, 0.0, 0.0, k % 3 == 2 ? 4 * ms : 0);
    EXPECT_LT((even.wait(16 * ms) - uneven.wait(16 * ms)).norm(), 1e-12) << k;
  }
}

TEST(PointerDevice, ASwitchIsNotLostBehindMessagesThatCameLate) {
  Hand hand;
  hand.point(0.01, 0.0, 0.0, 500 * ms);
  hand.wait(16 * ms);
  hand.point(0.02, 0.0, 0.0, 500 * ms);
  hand.wait(16 * ms);
  hand.point(0.03, 0.0, 0.0, 0, 8);  // in time: it counts as earlier than those before it
  hand.wait(1000 * ms);
  EXPECT_EQ(hand.switches(), 8u);
}

TEST(PageClock, IsThatOfTheFastestMessageLately) {
  PageClock clock;
  const std::int64_t offset = 1000 * ms;
  clock.see(0, offset + 9 * ms);
  EXPECT_EQ(clock.to_monotonic(5 * ms), offset + 14 * ms);
  clock.see(10 * ms, offset + 10 * ms + 2 * ms);
  clock.see(20 * ms, offset + 20 * ms + 7 * ms);
  EXPECT_EQ(clock.to_monotonic(20 * ms), offset + 22 * ms);
  for (int k = 0; k < 1200; ++k)  // the page's clock was set back by a second
    clock.see(k * 10 * ms, offset + k * 10 * ms + 1003 * ms);
  EXPECT_EQ(clock.to_monotonic(12'000 * ms), offset + 12'000 * ms + 1003 * ms);
}

}  // namespace
}  // namespace sandstroke
