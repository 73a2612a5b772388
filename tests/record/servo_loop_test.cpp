#include "record/servo_loop.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "allocations.h"
#include "record/seen_device.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t ms = 1'000'000;  // ns, a tick at 1 kHz
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// A loop of 1 kHz on a device that works, for 100 ticks, until a test changes it.
class ServoLoopTest : public testing::Test {
 protected:
  ServoLoopTest() {
    device.description.max_force = 12.0;
    settings.duration = 0.1;
    settings.force = {8.0, 0.0, 1e9, 0.0};  // neither ramp nor rate; one reading opens the interlock
  }

  std::shared_ptr<HapticDevice> open_device() {
    const auto opened = seen(device);
    opened->open();
    return opened;
  }

  /// The loop's footer, after what holds of any recording.
  RecordingFooter run(FeltWorld* world = nullptr) {
    start = clock.now();
    const auto opened = open_device();
    ServoLoop loop(*opened, world, clock, ring, settings);
    made = &loop;
    const RecordingFooter footer = loop.run();
    made = nullptr;
    EXPECT_EQ(loop.heartbeat(), 0);
    EXPECT_EQ(loop.progress().held, Vector3d::Zero());

    RecordedSample sample;
    while (ring.pop(sample)) samples.push_back(sample);
    const TickCounts& ticks = footer.ticks;
    EXPECT_EQ(ticks.elapsed, ticks.recorded + ticks.skipped + ticks.unread + ticks.dropped);
    EXPECT_EQ(ticks.recorded, static_cast<std::int64_t>(samples.size()));
    EXPECT_EQ(ticks.late, with(late_sample));
    EXPECT_EQ(ticks.clamped, with(clamped_force));
    EXPECT_EQ(ticks.ramped, with(ramped_force));
    EXPECT_EQ(ticks.rate_limited, with(rate_limited_force));
    EXPECT_EQ(ticks.refused, with(refused_force));
    EXPECT_EQ(ticks.deferred, with(deferred_sand));
    EXPECT_EQ(ticks.interlocked, with(interlocked_force));
    EXPECT_EQ(device.held, Vector3d::Zero());
    std::uint64_t expected = 0;
    for (const RecordedSample& s : samples) {
      EXPECT_GE(s.sequence, expected);
      EXPECT_EQ((s.flags & after_skipped_ticks) != 0, s.sequence != expected) << s.sequence;
      EXPECT_LT(s.sequence, static_cast<std::uint64_t>(ticks.elapsed));
      expected = s.sequence + 1;
    }
    return footer;
  }

  std::int64_t with(SampleFlag flag) const {
    return std::count_if(samples.begin(), samples.end(),
                         [&](const auto& s) { return (s.flags & flag) != 0; });
  }
  std::vector<std::uint64_t> flagged(SampleFlag flag) const {
    std::vector<std::uint64_t> numbers;
    for (const RecordedSample& s : samples) {
      if (s.flags & flag) numbers.push_back(s.sequence);
    }
    return numbers;
  }
  /// The device's read in this tick takes so many ticks.
  void delay_read(double tick, double ticks) {
    device.reads = [this, tick, ticks](double time, DeviceReading&) {
      if (std::abs(time * 1000.0 - tick) < 0.01) clock.add(std::llround(ticks * ms));
      return true;
    };
  }
  /// A world for a hand that is out of the sand in tick 0, and then gets this force.
  static FakeWorld world_of(const Vector3d& force) {
    return FakeWorld(
        [force](double time) { return FeltForce{in_tick(time, 0, 0) ? Vector3d::Zero() : force}; });
  }
  static bool in_tick(double time, double first, double last) {
    return time > first * 1e-3 - 1e-6 && time < last * 1e-3 + 1e-6;
  }

  FakeClock clock;
  FakeDevice device;
  SpscRing<RecordedSample> ring{1 << 15};
  ServoSettings settings;
  std::int64_t start = 0;
  ServoLoop* made = nullptr;  // while it runs
  std::vector<RecordedSample> samples;
};

TEST_F(ServoLoopTest, RecordsEachTickWhereNothingHappens) {
  device.description.max_force = 0.0;
  const RecordingFooter footer = run();
  EXPECT_EQ(footer.reason, StopReason::duration);
  EXPECT_EQ(footer.ticks.elapsed, 100);
  EXPECT_EQ(footer.ticks.recorded, 100);
  EXPECT_EQ(footer.lateness.max, 0.0);
  ASSERT_EQ(samples.size(), 100u);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(samples[i].sequence, i);
    EXPECT_EQ(samples[i].time, start + static_cast<std::int64_t>(i) * ms);
    EXPECT_DOUBLE_EQ(samples[i].position[0], 1e-3 * static_cast<double>(i));
    EXPECT_EQ(samples[i].flags, 0u);
  }
  EXPECT_EQ(device.commands, 1) << "a device without motors is left alone, but for the end";
}

TEST_F(ServoLoopTest, KeepsRatesThatAreNoWholeNumberOfNanosecondsWithoutDrift) {
  for (const double rate : {333.3, 3000.0, 1000.0 / 7.0}) {
    samples.clear();
    settings.rate = rate;
    settings.duration = 10'000 / rate;
    EXPECT_EQ(run().ticks.recorded, 10'000);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      ASSERT_NEAR(static_cast<double>(samples[i].time - start), static_cast<double>(i) * 1e9 / rate, 0.501);
    }
  }
}

TEST_F(ServoLoopTest, LastsTheDurationToTheNearestTick) {
  for (const auto& [duration, ticks] :
       {std::pair{0.0, 0}, {0.0004, 0}, {0.0006, 1}, {0.1, 100}, {0.29, 290}}) {
    samples.clear();
    settings.duration = duration;
    EXPECT_EQ(run().ticks.elapsed, ticks) << duration;
  }
}

TEST_F(ServoLoopTest, EndsWithTheTickInWhichAStrokeEnds) {
  settings.duration.reset();
  device.length = 0.05;
  RecordingFooter footer = run();
  EXPECT_EQ(footer.reason, StopReason::stroke_end);
  EXPECT_EQ(footer.ticks.elapsed, 51);
  EXPECT_EQ(samples.back().time - samples.front().time, 50 * ms) << "the recording is as long as the stroke";

  samples.clear();
  settings.duration = 0.05;
  footer = run();
  EXPECT_EQ(footer.reason, StopReason::duration);
  EXPECT_EQ(footer.ticks.elapsed, 50);
}

TEST_F(ServoLoopTest, ForgivesAReadThatIsOverBeforeTheNextTick) {
  delay_read(10, 0.3);
  const RecordingFooter footer = run();
  EXPECT_EQ(footer.ticks.recorded, 100);
  EXPECT_EQ(footer.ticks.late, 0);
  EXPECT_EQ(footer.lateness.max, 0.0);
}

TEST_F(ServoLoopTest, FlagsTheSampleAfterAReadThatRunsIntoItsTick) {
  delay_read(10, 1.7);
  const RecordingFooter footer = run();
  EXPECT_EQ(footer.ticks.recorded, 100);
  EXPECT_EQ(flagged(late_sample), std::vector<std::uint64_t>{11});
  EXPECT_EQ(samples[11].time, start + 11 * ms + 700'000);
  EXPECT_EQ(samples[12].time, start + 12 * ms) << "the times are absolute: nothing is put off";
  EXPECT_DOUBLE_EQ(footer.lateness.max, 0.7e-3);
  EXPECT_DOUBLE_EQ(footer.lateness.mean, 0.7e-5);
}

TEST_F(ServoLoopTest, TakesHalfATickForLateAndAWholeOneForSkipped) {
  for (const auto& [ticks, late, skipped] :
       {std::tuple{1.5, 0, 0}, {1.500001, 1, 0}, {1.999999, 1, 0}, {2.0, 0, 1}, {2.5, 0, 1}, {2.6, 1, 1}}) {
    samples.clear();
    delay_read(10, ticks);
    const RecordingFooter footer = run();
    EXPECT_EQ(footer.ticks.late, late) << ticks;
    EXPECT_EQ(footer.ticks.skipped, skipped) << ticks;
  }
}

TEST_F(ServoLoopTest, SkipsTicksWhoseTimeHasPassedAndMakesUpNone) {
  delay_read(10, 5.0);
  const RecordingFooter footer = run();
  EXPECT_EQ(footer.ticks.elapsed, 100);
  EXPECT_EQ(footer.ticks.skipped, 4);
  EXPECT_EQ(footer.ticks.recorded, 96);
  EXPECT_EQ(footer.ticks.late, 0);
  EXPECT_EQ(flagged(after_skipped_ticks), std::vector<std::uint64_t>{15});
  EXPECT_EQ(samples[11].time, start + 15 * ms);
  EXPECT_DOUBLE_EQ(footer.lateness.max, 4e-3) << "tick 11's";
}

TEST_F(ServoLoopTest, ReadsWhereItWakesHoweverLateAndHoweverBusyTheMachine) {
  // Other programs take the core for 20 ticks whenever the loop sleeps in vain. One late tick costs what was
  // late, no more.
  clock.past_sleep = 20 * ms;
  delay_read(10, 5.3);
  const RecordingFooter footer = run();
  EXPECT_EQ(footer.ticks.skipped, 4);
  EXPECT_EQ(footer.ticks.recorded, 96);
  EXPECT_EQ(samples[11].sequence, 15U) << "of the tick in which it woke";
  EXPECT_EQ(samples[11].time, start + 15 * ms + 300'000) << "and stamped with the true time";
  EXPECT_EQ(samples[12].time, start + 16 * ms) << "no burst";
  EXPECT_DOUBLE_EQ(footer.lateness.max, 4.3e-3);
  EXPECT_DOUBLE_EQ(footer.lateness.mean, 1e-5 * (4.3 + 3.3 + 2.3 + 1.3 + 0.3));
}

TEST_F(ServoLoopTest, EndsOnTimeThoughTheEndIsSkipped) {
  delay_read(97, 1000.0);
  const RecordingFooter footer = run();
  EXPECT_EQ(footer.reason, StopReason::duration);
  EXPECT_EQ(footer.ticks.elapsed, 100);
  EXPECT_EQ(footer.ticks.skipped, 2);
}

TEST_F(ServoLoopTest, CountsTicksInWhichTheDeviceGaveNothing) {
  device.reads = [&](double time, DeviceReading&) {
    return !in_tick(time, 0, 0) && !in_tick(time, 20, 20) && !in_tick(time, 50, 59);
  };
  const RecordingFooter footer = run();
  EXPECT_EQ(footer.reason, StopReason::duration);
  EXPECT_EQ(footer.ticks.unread, 12);
  EXPECT_EQ(footer.ticks.recorded, 88);
  EXPECT_EQ(flagged(after_skipped_ticks), (std::vector<std::uint64_t>{1, 21, 60}));
}

TEST_F(ServoLoopTest, CountsReadingsThatAreNoNumbersAsNone) {
  device.reads = [&](double time, DeviceReading& reading) {
    if (in_tick(time, 20, 20)) reading.position.y() = no_number;
    if (in_tick(time, 30, 30)) reading.velocity.z() = std::numeric_limits<double>::infinity();
    return true;
  };
  EXPECT_EQ(run().ticks.unread, 2);
  for (const RecordedSample& s : samples) EXPECT_TRUE(s.sequence != 20 && s.sequence != 30);
}

TEST_F(ServoLoopTest, TakesADeviceThatStaysSilentForLost) {
  settings.duration.reset();
  settings.silence = 0.05;
  device.reads = [&](double time, DeviceReading&) { return time < 0.0295; };  // unplugged after tick 29
  const RecordingFooter footer = run();
  EXPECT_EQ(footer.reason, StopReason::device_lost);
  EXPECT_EQ(footer.ticks.recorded, 30);
  EXPECT_EQ(footer.ticks.unread, 51) << "the last one is 0.05 s after the first";
  EXPECT_EQ(footer.ticks.elapsed, 81);
}

TEST_F(ServoLoopTest, TakesADeviceThatNeverAnswersForLost) {
  settings.duration.reset();
  device.reads = [](double, DeviceReading&) { return false; };
  device.takes_force = [](const Vector3d&) { return false; };
  const RecordingFooter footer = run();
  EXPECT_EQ(footer.reason, StopReason::device_lost);
  EXPECT_EQ(footer.ticks.elapsed, 101);
  EXPECT_EQ(footer.ticks.unread, 101);
  EXPECT_EQ(device.released, zero_is_sent_twice ? 1 : 0) << "for it takes no zero force";
}

TEST_F(ServoLoopTest, CountsWhatTheFullRingDidNotTake) {
  settings.duration = 1.0;
  SpscRing<RecordedSample> small(64);
  const auto opened = open_device();
  ServoLoop loop(*opened, nullptr, clock, small, settings);
  RecordedSample sample;
  device.reads = [&](double time, DeviceReading&) {
    if (in_tick(time, 500, 500)) {  // somebody empties it once
      while (small.pop(sample)) {
      }
    }
    return true;
  };
  const RecordingFooter footer = loop.run();
  EXPECT_EQ(footer.ticks.elapsed, 1000);
  EXPECT_EQ(footer.ticks.recorded, 128);
  EXPECT_EQ(footer.ticks.dropped, 872);
  for (std::uint64_t tick = 500; tick < 564; ++tick) {
    ASSERT_TRUE(small.pop(sample));
    EXPECT_EQ(sample.sequence, tick);
    EXPECT_EQ(sample.flags, tick == 500 ? after_skipped_ticks : 0u);
  }
}

TEST_F(ServoLoopTest, EndsWhenTheStopSwitchIsKeptPressed) {
  settings.duration.reset();
  settings.stop_switch = 2;
  device.reads = [&](double time, DeviceReading& reading) {
    const bool bounces = in_tick(time, 30, 35) && std::llround(time * 1000) % 2 == 0;
    const bool held_from_the_start = time < 0.0105;
    reading.switches = 1U | (bounces || held_from_the_start || time > 0.0395 ? 4U : 0U);
    return !in_tick(time, 45, 47);  // silence is no letting go
  };
  const RecordingFooter footer = run();
  EXPECT_EQ(footer.reason, StopReason::stop_switch);
  EXPECT_EQ(footer.ticks.elapsed, 61) << "down in tick 40; 0.02 s later is tick 60";
  EXPECT_EQ(footer.ticks.recorded, 58);
  EXPECT_EQ(samples.back().switches, 5u);
}

TEST_F(ServoLoopTest, GivesWhatTheWorldMakesFelt) {
  FakeWorld world([](double time) { return FeltForce{{0.0, 0.0, 20.0 * time}, deferred_sand}; });
  Vector3d commanded = Vector3d::Zero();
  device.takes_force = [&](const Vector3d& force) {
    commanded = force;
    return true;
  };
  device.reads = [&](double time, DeviceReading&) {
    EXPECT_NEAR(commanded.z(), 20.0 * std::max(0.0, time - 0.001), 1e-12);
    return true;
  };
  const RecordingFooter footer = run(&world);
  for (const RecordedSample& s : samples) {
    EXPECT_NEAR(s.force[2], 0.02 * static_cast<double>(s.sequence), 1e-12);
  }
  EXPECT_EQ(footer.ticks.deferred, 100);
  EXPECT_EQ(device.commands, 101);
}

TEST_F(ServoLoopTest, KeepsToTheSmallerLimitOfUserAndDevice) {
  FakeWorld world = world_of({0.0, 100.0, 0.0});
  for (const auto& [user, motor] : {std::pair{8.0, 12.0}, {12.0, 8.0}, {0.0, 8.0}, {8.0, 0.0}}) {
    samples.clear();
    settings.force.max_force = user;
    device.description.max_force = motor;
    EXPECT_EQ(run(&world).ticks.clamped, std::min(user, motor) > 0.0 ? 99 : 0);  // none: nothing is cut
    for (const RecordedSample& s : samples)
      EXPECT_NEAR(s.force[1], s.sequence == 0 ? 0.0 : std::min(user, motor), 1e-12);
  }
}

TEST_F(ServoLoopTest, HoldsAForceBackFromJumpingOverALateTick) {
  settings.force.rate = 1000.0;  // 1 N per tick
  FakeWorld world([](double time) { return FeltForce{{0.0, 0.0, time < 0.0105 ? 0.0 : 5.0}, 0}; });
  delay_read(10, 20.0);
  const RecordingFooter footer = run(&world);
  EXPECT_EQ(footer.ticks.skipped, 19);
  EXPECT_EQ(footer.ticks.rate_limited, 4);
  for (int tick = 0; tick < 6; ++tick) {
    EXPECT_NEAR(samples[static_cast<std::size_t>(11 + tick)].force[2], std::min(1.0 + tick, 5.0), 1e-12);
  }
}

TEST_F(ServoLoopTest, GivesNoForceOnceTheDeviceWasNotReadUntilTheToolIsLifted) {
  settings.force.rate = 1000.0;
  FakeWorld world([](double time) {
    const bool out = in_tick(time, 0, 0) || in_tick(time, 70, 72);
    return FeltForce{{0.0, 0.0, out ? 0.0 : 5.0}, 0};
  });
  device.reads = [&](double time, DeviceReading&) {
    if (in_tick(time, 51, 53)) {
      EXPECT_EQ(device.held, Vector3d::Zero());
    }
    return !in_tick(time, 50, 52);
  };
  EXPECT_EQ(run(&world).ticks.interlocked, 17);
  EXPECT_EQ(samples[49].force[2], 5.0);
  EXPECT_EQ(samples[50].sequence, 53u);
  for (const RecordedSample& s : samples)
    if (s.sequence > 50) {
      EXPECT_NEAR(s.force[2], s.sequence < 73 ? 0.0 : std::min(static_cast<double>(s.sequence) - 72.0, 5.0),
                  1e-12);
    }
}

TEST_F(ServoLoopTest, GivesNoForceAfterAStallUntilTheToolIsLifted) {
  for (const auto& [ticks, closes] : {std::pair{24.0, false}, {27.0, true}}) {
    samples.clear();
    FakeWorld world([](double time) {
      const bool out = in_tick(time, 0, 0) || in_tick(time, 70, 72);
      return FeltForce{{0.0, 0.0, out ? 0.0 : 5.0}, 0};
    });
    delay_read(10, ticks);
    run(&world);
    for (const RecordedSample& s : samples)
      if (s.sequence > 10) {
        EXPECT_EQ(s.force[2],
                  (closes && s.sequence < 70) || (s.sequence >= 70 && s.sequence <= 72) ? 0.0 : 5.0)
            << s.sequence << " after " << ticks;
      }
  }
}

TEST_F(ServoLoopTest, GivesNoForceToAHandThatRestsInTheSand) {
  settings.duration = 3.0;
  settings.force = ForceLimits{};
  settings.force.max_force = 12.0;
  FakeWorld world([](double time) {
    return FeltForce{{0.0, 0.0, time < 1.0 || time > 1.1 ? 30.0 : 0.0}, 0};
  });
  device.reads = [&](double time, DeviceReading&) {
    const double seen = time - 1e-3;  // what is told is of the tick before
    const bool waits = seen < 1.05 - 1e-6;
    if (seen > 0.0) {
      EXPECT_EQ(made->progress().awaited == Awaited::lift, waits) << time;
    }
    return true;
  };
  const RecordingFooter footer = run(&world);
  EXPECT_EQ(footer.ticks.interlocked, 1000);
  for (const RecordedSample& s : samples) {
    const double open = static_cast<double>(s.sequence) * 1e-3 - 1.05;
    if (open <= 0.0) {
      ASSERT_EQ(s.force[2], 0.0);
    } else if (open > 0.06) {  // from the opening on it fades in for a second
      ASSERT_NEAR(s.force[2], std::min(12.0, 30.0 * std::min(open, 1.0)), 1e-6) << s.sequence;
    }
  }
}

TEST_F(ServoLoopTest, WaitsForNoLiftingWithoutForce) {
  settings.force.max_force = 0.0;
  FakeWorld world([](double) { return FeltForce{{0.0, 0.0, 5.0}, 0}; });
  device.reads = [&](double, DeviceReading&) {
    EXPECT_EQ(made->progress().awaited, Awaited::nothing);
    return true;
  };
  run(&world);
}

TEST_F(ServoLoopTest, GivesNoForceForOneThatIsNoNumberAndGoesOn) {
  FakeWorld world([&](double time) {
    const bool out = in_tick(time, 0, 0) || in_tick(time, 70, 70);
    return FeltForce{{0.0, 0.0, in_tick(time, 50, 59) ? no_number : out ? 0.0 : 5.0}, 0};
  });
  const RecordingFooter footer = run(&world);
  EXPECT_EQ(footer.reason, StopReason::duration);
  EXPECT_EQ(footer.ticks.recorded, 100);
  EXPECT_EQ(footer.ticks.refused, 10);
  for (const RecordedSample& s : samples) {
    EXPECT_EQ(s.force[2], s.sequence == 0 || (s.sequence >= 50 && s.sequence <= 70) ? 0.0 : 5.0);
  }
}

TEST_F(ServoLoopTest, EndsWhereTheForceStaysNoNumber) {
  settings.duration.reset();
  settings.silence = 0.02;
  FakeWorld world([](double time) { return FeltForce{{0.0, 0.0, time > 0.0295 ? no_number : 5.0}, 0}; });
  const RecordingFooter footer = run(&world);
  EXPECT_EQ(footer.reason, StopReason::no_number);
  EXPECT_EQ(footer.ticks.elapsed, 51) << "no number from tick 30 on; 0.02 s later is tick 50";
  EXPECT_EQ(footer.ticks.refused, 21);
}

TEST_F(ServoLoopTest, TakesNoSingleFailureAfterAHangForALastingOne) {
  settings.silence = 0.02;
  FakeWorld world([&](double time) {
    return FeltForce{{0.0, 0.0, in_tick(time, 40, 40) ? no_number : 5.0}, 0};
  });
  device.reads = [&](double time, DeviceReading&) {
    if (in_tick(time, 9, 9) || in_tick(time, 59, 59)) clock.add(31 * ms);
    return !in_tick(time, 90, 90);
  };
  const RecordingFooter footer = run(&world);
  EXPECT_EQ(footer.reason, StopReason::duration);
  EXPECT_EQ(footer.ticks.refused, 1);
  EXPECT_EQ(footer.ticks.unread, 1);
}

TEST_F(ServoLoopTest, RecordsTheForceThatTheDeviceHoldsWhereItTakesNoOther) {
  settings.force.rate = 1000.0;
  FakeWorld world([](double time) { return FeltForce{{0.0, 0.0, 1e3 * std::min(time, 0.005)}, 0}; });
  int refused = 0;
  device.takes_force = [&](const Vector3d& force) {
    const bool refuses = force.z() > 2.5 && refused < 10;
    refused += refuses;
    return !refuses;
  };
  const RecordingFooter footer = run(&world);
  EXPECT_EQ(footer.ticks.recorded, 100);
  EXPECT_NEAR(samples[3].force[2], 2.0, 1e-12);
  for (std::size_t tick = 4; tick < 100; ++tick)
    EXPECT_EQ(samples[tick].force[2], 0.0) << "until the tool is lifted";
}

TEST_F(ServoLoopTest, RecordsTheForceOfADeviceThatTakesNotEvenZero) {
  FakeWorld world = world_of({0.0, 0.0, 5.0});
  device.takes_force = [&](const Vector3d&) {
    const std::int64_t tick = (clock.now() - start) / ms;
    return tick < 10 || tick >= 20;
  };
  EXPECT_EQ(run(&world).reason, StopReason::duration);
  for (const RecordedSample& s : samples)
    EXPECT_EQ(s.force[2], s.sequence == 0 || s.sequence >= 20 ? 0.0 : 5.0) << s.sequence;
}

TEST_F(ServoLoopTest, TakesADeviceThatTakesNoForceForLost) {
  settings.duration.reset();
  FakeWorld world = world_of({0.0, 0.0, 5.0});
  device.takes_force = [](const Vector3d&) { return false; };
  const RecordingFooter footer = run(&world);
  EXPECT_EQ(footer.reason, StopReason::device_lost);
  EXPECT_EQ(footer.ticks.recorded, 102) << "refused from tick 1 on";
  EXPECT_EQ(device.released, 1);
}

TEST_F(ServoLoopTest, DoesNotMissAForceThatIsNotWanted) {
  device.takes_force = [](const Vector3d&) { return false; };
  EXPECT_EQ(run().reason, StopReason::duration);
  EXPECT_EQ(device.released, zero_is_sent_twice ? 1 : 0);
}

TEST_F(ServoLoopTest, StopsForTheFirstReasonGiven) {
  settings.duration.reset();
  device.reads = [&](double time, DeviceReading&) {
    if (in_tick(time, 30, 30)) made->stop(StopReason::key);
    if (in_tick(time, 30, 30)) made->stop(StopReason::disk);
    return true;
  };
  const RecordingFooter footer = run();
  EXPECT_EQ(footer.reason, StopReason::key);
  EXPECT_EQ(footer.ticks.elapsed, 31);
}

TEST_F(ServoLoopTest, RunsNoTickWhereItWasStoppedBefore) {
  const auto opened = open_device();
  ServoLoop loop(*opened, nullptr, clock, ring, settings);
  loop.stop(StopReason::signal);
  const RecordingFooter footer = loop.run();
  EXPECT_EQ(footer.reason, StopReason::signal);
  EXPECT_EQ(footer.ticks.elapsed, 0);
  EXPECT_EQ(device.commands, 1);
}

TEST_F(ServoLoopTest, GivesNoForceAfterAStopInTheMiddleOfATick) {
  settings.duration.reset();
  FakeWorld world([&](double time) {
    if (in_tick(time, 30, 30)) made->stop(StopReason::signal);
    return FeltForce{{0.0, 0.0, in_tick(time, 0, 0) ? 0.0 : 5.0}, 0};
  });
  const RecordingFooter footer = run(&world);
  EXPECT_EQ(footer.ticks.elapsed, 31);
  EXPECT_EQ(samples[29].force[2], 5.0);
  EXPECT_EQ(samples[30].force[2], 0.0);
}

TEST_F(ServoLoopTest, TellsHowFarItIs) {
  settings.force.rate = 1000.0;
  FakeWorld world = world_of({0.0, 0.0, 5.0});
  device.reads = [&](double time, DeviceReading&) {
    const auto tick = std::llround(time * 1000);
    const ServoProgress progress = made->progress();
    EXPECT_EQ(progress.elapsed, tick);
    EXPECT_EQ(progress.recorded, tick);
    EXPECT_NEAR(progress.time, 1e-3 * static_cast<double>(std::max(tick - 1, 0LL)), 1e-9);
    EXPECT_NEAR(progress.force, static_cast<double>(std::clamp(tick - 1, 0LL, 5LL)), 1e-12);
    EXPECT_EQ(made->heartbeat(), clock.now());
    return true;
  };
  run(&world);
}

TEST_F(ServoLoopTest, TellsHowLateItWas) {
  device.reads = [&](double time, DeviceReading&) {
    const auto tick = std::llround(time * 1000);
    const ServoProgress progress = made->progress();
    if (tick == 20) clock.add(5 * ms / 4);  // so that tick 21 is a quarter late
    if (tick == 40) clock.add(7 * ms / 5);  // and tick 41 two fifths
    EXPECT_NEAR(progress.lateness, tick == 22 ? 0.25e-3 : tick == 42 ? 0.4e-3 : 0.0, 1e-9) << tick;
    EXPECT_NEAR(progress.max_lateness, tick < 22 ? 0.0 : tick < 42 ? 0.25e-3 : 0.4e-3, 1e-9) << tick;
    return true;
  };
  run();
}

// --- Before the recording begins ---

/// The world times that a FakeWorld was asked for.
class TimedWorld : public FakeWorld {
 public:
  std::vector<double> times;
  TimedWorld()
      : FakeWorld([this](double time) {
          times.push_back(time);
          return FeltForce{};
        }) {}
};

TEST_F(ServoLoopTest, RecordsFromTheCountdownsEndOn) {
  settings.start.countdown = 0.0305;
  TimedWorld world;
  std::vector<double> played;
  device.reads = [&](double time, DeviceReading&) {
    if (played.size() > 1 && played.size() <= 30) {
      EXPECT_EQ(made->progress().awaited, Awaited::countdown);
      EXPECT_NEAR(made->progress().time, 1e-3 * static_cast<double>(played.size() - 1) - 0.0305, 1e-9);
      EXPECT_EQ(made->progress().elapsed, 0);
      EXPECT_EQ(made->heartbeat(), clock.now());
    }
    played.push_back(time);
    return true;
  };
  const RecordingFooter footer = run(&world);
  EXPECT_EQ(footer.ticks.elapsed, 100) << "the duration counts from there";
  EXPECT_EQ(footer.lateness.max, 0.0);
  EXPECT_EQ(samples.front().time, start + 31 * ms);
  EXPECT_EQ(world.times.size(), 100u) << "nothing is felt before";
  EXPECT_EQ(world.times.front(), 0.0);
  for (int i = 0; i < 31; ++i) EXPECT_EQ(played[static_cast<std::size_t>(i)], 0.0) << "the stand-in waits";
  EXPECT_NEAR(samples.front().position[0], 0.5e-3, 1e-9);
}

TEST_F(ServoLoopTest, AStandInPlaysItsWholeStrokeAfterACountdown) {
  settings.duration.reset();
  settings.start.countdown = 0.2;
  device.length = 0.05;
  const RecordingFooter footer = run();
  EXPECT_EQ(footer.reason, StopReason::stroke_end);
  EXPECT_EQ(footer.ticks.elapsed, 51);
}

TEST_F(ServoLoopTest, ASwitchBeginsAndEndsARecording) {
  settings.duration.reset();
  settings.start.start_switch = settings.stop_switch = 1;
  device.reads = [&](double time, DeviceReading& reading) {
    reading.switches = in_tick(time, 0, 9) || in_tick(time, 50, 99) || in_tick(time, 150, 199) ? 2 : 0;
    return true;
  };
  const RecordingFooter footer = run();
  EXPECT_EQ(footer.reason, StopReason::stop_switch);
  EXPECT_EQ(samples.front().time, start + 70 * ms) << "0.02 s after it is pressed";
  EXPECT_EQ(samples.back().time, start + 170 * ms);
  EXPECT_EQ(footer.ticks.elapsed, 101);
}

TEST_F(ServoLoopTest, AStandInThatMovedWhileItWasWaitedForEndsWithItsStroke) {
  settings.duration.reset();
  settings.start.start_switch = 1;
  device.length = 0.3;
  device.reads = [](double time, DeviceReading& reading) {
    reading.switches = in_tick(time, 50, 99) ? 2 : 0;
    return true;
  };
  const RecordingFooter footer = run();
  EXPECT_EQ(footer.reason, StopReason::stroke_end);
  EXPECT_EQ(samples.back().time, start + 300 * ms);
}

TEST_F(ServoLoopTest, BeginsOneTickBeforeFirstContact) {
  settings.start.at_contact = true;
  settings.duration = 0.05;
  TimedWorld world;
  double last = 0.0;
  device.reads = [&](double time, DeviceReading& reading) {
    reading.position.z() = in_tick(time, 0, 9) || in_tick(time, 70, 1000) ? -1.0 : 1.0;
    const Awaited expected = in_tick(time, 1, 10)    ? Awaited::lift
                             : in_tick(time, 11, 70) ? Awaited::contact
                                                     : Awaited::nothing;
    if (time > last && made->progress().elapsed == 0) {
      EXPECT_EQ(made->progress().awaited, expected) << time;
    }
    last = time;
    return true;
  };
  const RecordingFooter footer = run(&world);
  EXPECT_EQ(footer.ticks.elapsed, 50);
  EXPECT_EQ(footer.ticks.recorded, 50);
  EXPECT_EQ(samples[0].time, start + 69 * ms);
  EXPECT_EQ(samples[0].position[2], 1.0);
  EXPECT_EQ(samples[1].time, start + 70 * ms);
  EXPECT_EQ(samples[1].position[2], -1.0);
  ASSERT_EQ(world.times.size(), 50u);
  EXPECT_EQ(world.times[0], 0.0);
  EXPECT_NEAR(world.times[1], 1e-3, 1e-12);
}

TEST_F(ServoLoopTest, TheWayThroughTheAirBeforeContactOpensTheInterlock) {
  settings.start.at_contact = true;
  settings.force.clear_time = 0.05;
  FakeWorld world([](double time) { return FeltForce{{0.0, 0.0, time > 0.0 ? 5.0 : 0.0}, 0}; });
  for (const auto& [out, force] : {std::pair{60, 5.0}, {40, 0.0}}) {
    samples.clear();
    device.reads = [&, out = out](double time, DeviceReading& reading) {
      reading.position.z() = in_tick(time, 10, 10 + out) ? 1.0 : -1.0;
      return true;
    };
    run(&world);
    EXPECT_EQ(samples[1].force[2], force) << out;
  }
}

TEST_F(ServoLoopTest, AnEndWhileItWaitsLeavesNothing) {
  settings.start.start_switch = 0;
  settings.duration.reset();
  const auto reason = [&] {
    const RecordingFooter footer = run();
    EXPECT_EQ(footer.ticks.elapsed, 0);
    return footer.reason;
  };
  device.reads = [&](double time, DeviceReading&) {
    if (in_tick(time, 30, 30)) made->stop(StopReason::key);
    return true;
  };
  EXPECT_EQ(reason(), StopReason::key);
  device.reads = [](double, DeviceReading&) { return false; };
  EXPECT_EQ(reason(), StopReason::device_lost);
  device.reads = nullptr;
  device.length = 0.5;
  EXPECT_EQ(reason(), StopReason::stroke_end);
}

// --- All of it ---

/// Whatever happens in a loop: readings, gaps, stalls, no numbers, refused commands, depths, waiting.
TEST_F(ServoLoopTest, GivesNoForceThatItMustNotWhateverHappens) {
  int some_force = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    samples.clear();
    std::mt19937 random(seed);
    const auto chance = [&random](double probability) {
      return 0x1p-32 * static_cast<double>(random()) < probability;
    };
    const auto up_to = [&random](double most) { return most * 0x1p-32 * static_cast<double>(random()); };
    settings.duration = 4.0;
    settings.silence = 1e3;
    settings.force = {up_to(10.0), up_to(0.5), 100.0 + up_to(2000.0), 0.05};
    settings.start = {chance(0.3) ? 0.1 : 0.0, chance(0.3) ? std::optional(0) : std::nullopt, chance(0.3)};
    device.takes_force = [&](const Vector3d&) { return !chance(seed % 3 == 0 ? 0.002 : 0.0); };
    const double unread = seed % 2 ? 0.002 : 0.0, stalls = seed % 4 < 2 ? 0.002 : 0.0;
    double z = chance(0.5) ? -0.05 : 0.05;  // m: it may rest in the sand
    bool in_air = false;

    // The readings alone tell what the interlock must allow.
    std::optional<std::int64_t> last, clear_since;
    bool may_open = false;
    std::vector<char> allowed(10'000, 0);  // by ms since the start
    bool read_fails = false;
    device.reads = [&](double, DeviceReading& reading) {
      if (chance(0.005)) in_air = !in_air;
      z += in_air ? up_to(2e-3) * (z < 0.03) : -up_to(2e-3) * (z > -0.05);
      reading.position.z() = z;
      reading.switches = chance(0.5) ? 1 : 0;
      if (clock.now() - start > 500 * ms) reading.switches = clock.now() - start > 520 * ms;
      read_fails = chance(unread);
      const std::int64_t now = clock.now();
      if (read_fails || (last && now - *last > 25 * ms)) {
        may_open = false;
        clear_since.reset();
      }
      last = now;
      if (read_fails || z < 0.0) {
        clear_since.reset();
      } else {
        if (!clear_since) clear_since = now;
        may_open = may_open || now - *clear_since >= 50 * ms;
      }
      allowed[static_cast<std::size_t>((now - start) / ms)] = may_open;
      if (chance(stalls)) clock.add(std::llround(up_to(60.0) * ms));
      return !read_fails;
    };
    FakeWorld world([&](double) {
      Vector3d force(0.0, 0.0, z < 0.0 ? 1.0 - 500.0 * z : 0.0);
      const bool none = z < 0.0 && chance(0.002);
      if (none) force.y() = no_number;
      if (none) {
        may_open = false;
        allowed[static_cast<std::size_t>((*last - start) / ms)] = 0;
      }
      return FeltForce{force, 0};
    });
    run(&world);

    const double step = settings.force.rate / 1000.0, most = settings.force.max_force;
    Vector3d held = Vector3d::Zero();
    double given = 0.0;
    for (const RecordedSample& s : samples) {
      const Vector3d force(s.force[0], s.force[1], s.force[2]);
      const auto at = static_cast<std::size_t>((s.time - start) / ms);
      ASSERT_LE(force.norm(), most * (1.0 + 1e-12)) << seed;
      if (!force.isZero(0.0) && force != held) {  // a device that refuses goes on with what it holds
        ASSERT_TRUE(allowed[at]) << seed << ", tick " << s.sequence;
        ASSERT_EQ(s.flags & (interlocked_force | refused_force), 0u) << seed;
        ASSERT_LE((force - held).norm(), step * (1.0 + 1e-9)) << seed << ", tick " << s.sequence;
      }
      given = std::max(given, force.norm());
      held = force;
    }
    some_force += given > 0.1;
  }
  EXPECT_GT(some_force, 30) << "else nothing was tested";
}

TEST_F(ServoLoopTest, AllocatesNothing) {
  if (!allocations_are_counted()) GTEST_SKIP() << "sanitizers bring their own allocator";
  settings.duration = 10.0;
  settings.stop_switch = 0;
  settings.force = {8.0, 0.02, 1000.0, 0.0};
  FakeWorld world([](double time) {
    return FeltForce{Vector3d::Constant(10.0 * std::sin(time)), deferred_sand};
  });
  device.reads = [&](double time, DeviceReading& reading) {
    const auto tick = std::llround(time * 1000);
    if (tick % 17 == 0) clock.add(3 * ms);
    if (tick % 23 == 0) reading.position.x() = no_number;
    reading.switches = tick % 2 == 0;
    return tick % 29 != 0;
  };
  device.takes_force = [](const Vector3d& force) { return force.x() < 4.5 || force.x() > 4.6; };
  SpscRing<RecordedSample> small(4096);  // and then full
  const auto opened = open_device();
  ServoLoop loop(*opened, &world, clock, small, settings);
  const std::int64_t before = allocations_of_this_thread();
  const RecordingFooter footer = loop.run();
  EXPECT_EQ(allocations_of_this_thread(), before);
  EXPECT_GT(before, 0);
  EXPECT_EQ(footer.reason, StopReason::duration);
  const TickCounts& ticks = footer.ticks;
  EXPECT_EQ(ticks.elapsed, 10'000);
  EXPECT_EQ(ticks.elapsed, ticks.recorded + ticks.skipped + ticks.unread + ticks.dropped);
  for (const std::int64_t some : {ticks.recorded, ticks.skipped, ticks.unread, ticks.dropped})
    EXPECT_GT(some, 0);
}

}  // namespace
}  // namespace sandstroke
