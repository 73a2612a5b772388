#include "record/servo_loop.h"

#include <gtest/gtest.h>

#include <limits>

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
    settings.force = {8.0, 0.0, 1e9};  // neither ramp nor rate
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
    EXPECT_EQ(ticks.held, with(held_sand));
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

TEST_F(ServoLoopTest, EndsWhenTheStopSwitchIsHeld) {
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
  FakeWorld world([](double time) { return FeltForce{{0.0, 0.0, 20.0 * time}, held_sand}; });
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
  EXPECT_EQ(footer.ticks.held, 100);
  EXPECT_EQ(device.commands, 101);
}

TEST_F(ServoLoopTest, KeepsToTheSmallerLimitOfUserAndDevice) {
  FakeWorld world([](double) { return FeltForce{{0.0, 100.0, 0.0}, 0}; });
  for (const auto& [user, motor] : {std::pair{8.0, 12.0}, {12.0, 8.0}, {0.0, 8.0}, {8.0, 0.0}}) {
    samples.clear();
    settings.force.max_force = user;
    device.description.max_force = motor;
    EXPECT_EQ(run(&world).ticks.clamped, 100);
    for (const RecordedSample& s : samples) EXPECT_NEAR(s.force[1], std::min(user, motor), 1e-12);
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

TEST_F(ServoLoopTest, GivesNoForceWhileTheDeviceIsNotReadAndRisesFromZeroAgain) {
  settings.force.rate = 1000.0;
  FakeWorld world([](double) { return FeltForce{{0.0, 0.0, 5.0}, 0}; });
  device.reads = [&](double time, DeviceReading&) {
    if (in_tick(time, 51, 53)) {
      EXPECT_EQ(device.held, Vector3d::Zero());
    }
    return !in_tick(time, 50, 52);
  };
  run(&world);
  EXPECT_EQ(samples[49].force[2], 5.0);
  EXPECT_EQ(samples[50].sequence, 53u);
  EXPECT_EQ(samples[50].force[2], 1.0);
}

TEST_F(ServoLoopTest, GivesNoForceForOneThatIsNoNumberAndGoesOn) {
  FakeWorld world([&](double time) {
    return FeltForce{{0.0, 0.0, in_tick(time, 50, 59) ? no_number : 5.0}, 0};
  });
  const RecordingFooter footer = run(&world);
  EXPECT_EQ(footer.reason, StopReason::duration);
  EXPECT_EQ(footer.ticks.recorded, 100);
  EXPECT_EQ(footer.ticks.refused, 10);
  for (const RecordedSample& s : samples) {
    EXPECT_EQ(s.force[2], s.sequence >= 50 && s.sequence < 60 ? 0.0 : 5.0);
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
  for (std::size_t tick = 3; tick < 13; ++tick) EXPECT_NEAR(samples[tick].force[2], 2.0, 1e-12);
  EXPECT_NEAR(samples[13].force[2], 3.0, 1e-12) << "no jump from what it really held";
  EXPECT_NEAR(samples[15].force[2], 5.0, 1e-12);
}

TEST_F(ServoLoopTest, TakesADeviceThatTakesNoForceForLost) {
  settings.duration.reset();
  FakeWorld world([](double) { return FeltForce{{0.0, 0.0, 5.0}, 0}; });
  device.takes_force = [](const Vector3d&) { return false; };
  const RecordingFooter footer = run(&world);
  EXPECT_EQ(footer.reason, StopReason::device_lost);
  EXPECT_EQ(footer.ticks.recorded, 101);
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
    return FeltForce{{0.0, 0.0, 5.0}, 0};
  });
  const RecordingFooter footer = run(&world);
  EXPECT_EQ(footer.ticks.elapsed, 31);
  EXPECT_EQ(samples[29].force[2], 5.0);
  EXPECT_EQ(samples[30].force[2], 0.0);
}

TEST_F(ServoLoopTest, TellsHowFarItIs) {
  settings.force.rate = 1000.0;
  FakeWorld world([](double) { return FeltForce{{0.0, 0.0, 5.0}, 0}; });
  device.reads = [&](double time, DeviceReading&) {
    const auto tick = std::llround(time * 1000);
    const ServoProgress progress = made->progress();
    EXPECT_EQ(progress.elapsed, tick);
    EXPECT_EQ(progress.recorded, tick);
    EXPECT_NEAR(progress.time, 1e-3 * static_cast<double>(std::max(tick - 1, 0LL)), 1e-9);
    EXPECT_NEAR(progress.force, static_cast<double>(std::min(tick, 5LL)), 1e-12);
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

TEST_F(ServoLoopTest, AllocatesNothing) {
  if (!allocations_are_counted()) GTEST_SKIP() << "sanitizers bring their own allocator";
  settings.duration = 10.0;
  settings.stop_switch = 0;
  settings.force = {8.0, 1.0, 1000.0};
  FakeWorld world([](double time) {
    return FeltForce{Vector3d::Constant(10.0 * std::sin(time)), held_sand};
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
