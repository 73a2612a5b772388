#include "record/recorder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "core/error.h"
#include "core/interrupt.h"
#include "record/journal.h"
#include "record/seen_device.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

/// Recordings on the real clock: what is asserted holds whatever the machine does to it.
class RecorderTest : public testing::Test {
 protected:
  RecorderTest() {
    device.description.model = "fake";
    device.description.max_force = 12.0;
    device.description.switches = 2;
    settings.lock_memory = false;  // of the whole test program
    settings.servo.duration = 0.2;
    settings.servo.force.max_force = 8.0;
    // A machine that stands still is no subject here.
    settings.watchdog = settings.servo.silence = 1e3;
  }
  RecordingReport run(FeltWorld* world = nullptr, const RecordingWatcher& watcher = {}) {
    return record(*seen(device), world, settings, {}, journal, watcher);
  }
  void expect_device_left_safe() const {
    EXPECT_EQ(device.opened, 1);
    EXPECT_EQ(device.closed, 1);
    EXPECT_GE(device.released, 1);
    EXPECT_EQ(device.held, Vector3d::Zero());
  }
  /// The content of the journal: how many samples, and whether there is a footer.
  std::pair<std::int64_t, std::optional<RecordingFooter>> kept() const {
    JournalReader reader(journal);
    std::int64_t samples = 0;
    for (auto some = reader.next(1000); !some.empty(); some = reader.next(1000)) {
      samples += static_cast<std::int64_t>(some.size());
    }
    return {samples, reader.footer()};
  }

  TestFolder folder;
  std::filesystem::path journal = folder.path() / "a.h5.recording";
  FakeDevice device;
  RecorderSettings settings;
};

TEST_F(RecorderTest, AccountsForEachTickAndKeepsEachSample) {
  settings.servo.duration = 1.0;
  FakeWorld world([](double time) { return FeltForce{{0.0, 0.0, time}, 0}; });
  int looks = 0;
  std::int64_t told = 0;
  RecordingHeader known;
  known.source = "fake:";
  const RecordingReport report =
      record(*seen(device), &world, settings, known, journal, [&](const ServoProgress& progress) {
        EXPECT_LE(progress.recorded, progress.elapsed);
        ++looks;
        told = progress.elapsed;
        return std::nullopt;
      });
  EXPECT_GT(looks, 0);
  EXPECT_EQ(report.disk_error, "");
  EXPECT_EQ(report.footer.reason, StopReason::duration);
  const TickCounts& ticks = report.footer.ticks;
  EXPECT_EQ(ticks.elapsed, 1000);
  EXPECT_EQ(told, 1000) << "the last look sees all";
  EXPECT_EQ(ticks.elapsed, ticks.recorded + ticks.skipped + ticks.unread + ticks.dropped);
  EXPECT_EQ(ticks.unread + ticks.dropped, 0);
  expect_device_left_safe();
  EXPECT_EQ(device.calibrated, 0) << "for nobody asked for it";

  const auto [samples, footer] = kept();
  EXPECT_EQ(samples, ticks.recorded);
  ASSERT_TRUE(footer);
  EXPECT_EQ(footer->ticks.elapsed, ticks.elapsed);
  EXPECT_EQ(footer->ticks.skipped, ticks.skipped);
  EXPECT_EQ(footer->reason, StopReason::duration);
  JournalReader reader(journal);
  const RecordingHeader header = reader.header();
  EXPECT_EQ(header.source, "fake:");
  EXPECT_EQ(header.device.model, "fake");
  EXPECT_EQ(header.nominal_rate, 1000.0);
  EXPECT_EQ(header.force_limit, 8.0);
  EXPECT_EQ(header.started.size(), 24u) << header.started;
  EXPECT_GT(header.started_monotonic, 0.0);
  EXPECT_LT(header.started_monotonic, 1e-9 * static_cast<double>(reader.next(1).at(0).time));
  EXPECT_EQ(header.scheduling.policy, report.header.scheduling.policy);
  EXPECT_EQ(header.scheduling.advice.empty(), header.scheduling.policy == "SCHED_FIFO");
}

TEST_F(RecorderTest, KeepsWhatTheDeviceGaveBitByBit) {
  std::vector<DeviceReading> given;
  std::int64_t errors = 0;
  device.reads = [&](double, DeviceReading& reading) {
    const double n = static_cast<double>(given.size());
    reading.position = Vector3d(std::sin(n), -1.0 / (1.0 + n), 1e-9 * n);
    reading.velocity = Vector3d(std::cos(n), n, -0.0);
    reading.switches = 0x9e3779b9U * static_cast<std::uint32_t>(given.size());
    DeviceReading sound = reading;
    const std::size_t kind = (given.size() + static_cast<std::size_t>(errors)) % 20;
    if (kind == 7) reading.position.y() = std::numeric_limits<double>::quiet_NaN();
    if (kind == 11) reading.velocity.x() = std::numeric_limits<double>::infinity();
    if (kind == 7 || kind == 11 || kind == 13) {
      ++errors;
    } else {
      given.push_back(sound);
    }
    return kind != 13;
  };
  const TickCounts ticks = run().footer.ticks;
  EXPECT_GT(errors, 0);
  EXPECT_EQ(ticks.unread, errors);
  ASSERT_EQ(ticks.dropped, 0);
  JournalReader reader(journal);
  const std::vector<RecordedSample> samples = reader.next(1000);
  ASSERT_EQ(samples.size(), given.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(std::memcmp(samples[i].position, given[i].position.data(), sizeof samples[i].position), 0);
    EXPECT_EQ(std::memcmp(samples[i].velocity, given[i].velocity.data(), sizeof samples[i].velocity), 0);
    EXPECT_EQ(samples[i].switches, given[i].switches);
  }
}

TEST_F(RecorderTest, KeepsTheRecordingOfADeviceThatIsUnplugged) {
  settings.servo.duration.reset();
  settings.servo.silence = 0.02;
  std::int64_t readings = 0;
  device.reads = [&](double, DeviceReading&) { return ++readings <= 50; };
  FakeWorld world([](double) { return FeltForce{{0.0, 0.0, 5.0}, 0}; });
  const RecordingReport report = run(&world);
  EXPECT_EQ(report.footer.reason, StopReason::device_lost);
  EXPECT_EQ(report.footer.ticks.recorded, 50);
  EXPECT_EQ(kept().first, 50);
  EXPECT_EQ(kept().second->reason, StopReason::device_lost);
  expect_device_left_safe();
}

TEST_F(RecorderTest, GivesNoForceWithoutAWorld) {
  EXPECT_EQ(run().header.force_limit, 0.0);
  expect_device_left_safe();
}

TEST_F(RecorderTest, SaysHowMuchForceTheDeviceCouldGive) {
  settings.servo.force.max_force = 20.0;
  FakeWorld world([](double) { return FeltForce{}; });
  EXPECT_EQ(run(&world).header.force_limit, 12.0);
}

TEST_F(RecorderTest, CalibratesWhereItIsAsked) {
  settings.calibrate = true;
  run();
  EXPECT_EQ(device.calibrated, 1);
}

TEST_F(RecorderTest, GivesNoForceOnADeviceThatIsNotCalibratedUnlessToldSo) {
  settings.servo.duration = 0.001;
  FakeWorld world([](double) { return FeltForce{}; });
  const auto refused = [&](std::optional<bool> is_right, FeltWorld* felt) {
    std::filesystem::remove(journal);
    device.is_right = is_right;
    try {
      run(felt);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      for (const char* way : {"--calibrate", "--allow-uncalibrated"})
        EXPECT_NE(std::string(error.what()).find(way), std::string::npos) << error.what();
      EXPECT_FALSE(std::filesystem::exists(journal));
      return true;
    }
    return false;
  };
  EXPECT_TRUE(refused(false, &world));
  EXPECT_FALSE(refused(true, &world));
  EXPECT_FALSE(refused(std::nullopt, &world)) << "where nobody knows";
  EXPECT_FALSE(refused(false, nullptr)) << "where no force is given";
  settings.allow_uncalibrated = true;
  EXPECT_FALSE(refused(false, &world));
  settings.allow_uncalibrated = false;
  settings.calibrate = true;
  EXPECT_FALSE(refused(false, &world));
  EXPECT_EQ(device.opened, device.closed);
}

TEST_F(RecorderTest, RefusesAStartSwitchThatTheDeviceHasNot) {
  settings.servo.start.start_switch = 2;
  EXPECT_THROW(run(), Error);
  EXPECT_EQ(device.opened, device.closed);
}

TEST_F(RecorderTest, StopsWhenTheWatcherSaysSo) {
  settings.servo.duration.reset();
  const RecordingReport report = run(nullptr, [](const ServoProgress&) { return StopReason::key; });
  EXPECT_EQ(report.footer.reason, StopReason::key);
  EXPECT_EQ(kept().second->reason, StopReason::key);
  expect_device_left_safe();
}

TEST_F(RecorderTest, KeepsTheRecordingOfAWatcherThatThrows) {
  settings.servo.duration.reset();
  EXPECT_THROW(
      run(nullptr,
          [](const ServoProgress&) -> std::optional<StopReason> { throw std::runtime_error("no terminal"); }),
      std::runtime_error);
  ASSERT_TRUE(kept().second);
  EXPECT_EQ(kept().second->reason, StopReason::error);
  EXPECT_EQ(kept().first, kept().second->ticks.recorded);
  expect_device_left_safe();
}

TEST_F(RecorderTest, OverwritesNoJournalAndLeavesTheDeviceSafe) {
  std::ofstream(journal) << "another's";
  EXPECT_THROW(run(), Error);
  expect_device_left_safe();
  std::string text;
  std::getline(std::ifstream(journal), text);
  EXPECT_EQ(text, "another's");
}

TEST_F(RecorderTest, RefusesASwitchThatTheDeviceHasNot) {
  for (const auto& [number, switches, right] : {std::tuple{2, 2, false},
                                                {1, 2, true},
                                                {31, 0, true},
                                                {32, 0, false},
                                                {32, 64, false},
                                                {-1, 2, false}}) {
    std::filesystem::remove(journal);
    device.description.switches = switches;
    settings.servo.duration = 0.001;
    settings.servo.stop_switch = number;
    if (right) {
      EXPECT_NO_THROW(run());
    } else {
      EXPECT_THROW(run(), Error) << number << " of " << switches;
    }
    EXPECT_EQ(device.opened, device.closed);
  }
}

TEST_F(RecorderTest, KeepsWhatADiskTookBeforeItWasFull) {
  settings.servo.duration.reset();
  // The system refuses files beyond a size as it refuses a full disk's.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 20'000;
  setrlimit(RLIMIT_FSIZE, &small);
  const RecordingReport report = run();
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_DFL);

  EXPECT_EQ(report.footer.reason, StopReason::disk);
  EXPECT_NE(report.disk_error.find(journal.string()), std::string::npos) << report.disk_error;
  const auto [samples, footer] = kept();
  EXPECT_FALSE(footer);
  EXPECT_GT(samples, 100);
  EXPECT_EQ(samples, report.footer.ticks.recorded);
  const TickCounts& ticks = report.footer.ticks;
  EXPECT_EQ(ticks.elapsed, ticks.recorded + ticks.skipped + ticks.unread + ticks.dropped);
  expect_device_left_safe();
}

/// A device whose read hangs in one tick, until somebody releases it.
class HangingDevice : public FakeDevice {
 public:
  bool read(double, DeviceReading&) noexcept override {
    if (++reads_ < 20) return true;
    while (!free_) std::this_thread::yield();
    return true;
  }
  void release() noexcept override { free_ = true; }

 private:
  int reads_ = 0;
  std::atomic<bool> free_ = false;
};

TEST_F(RecorderTest, FreesALoopThatHangsInTheDevice) {
  HangingDevice hanging;
  hanging.description.max_force = 12.0;
  settings.servo.duration.reset();
  settings.watchdog = 0.05;
  FakeWorld world([](double) { return FeltForce{{0.0, 0.0, 1.0}, 0}; });
  const RecordingReport report = record(*seen(hanging), &world, settings, {}, journal, {});
  EXPECT_EQ(report.footer.reason, StopReason::stall);
  EXPECT_EQ(kept().second->reason, StopReason::stall);
  EXPECT_EQ(hanging.held, Vector3d::Zero());
  EXPECT_EQ(hanging.closed, 1);
}

TEST_F(RecorderTest, GoesOnAfterAHangWhereNoForceCouldBeGiven) {
  FakeDevice slow;
  int reads = 0;
  slow.reads = [&](double, DeviceReading&) {
    if (++reads == 20) std::this_thread::sleep_for(std::chrono::milliseconds(60));
    return true;
  };
  settings.servo.duration = 0.1;
  settings.watchdog = 0.01;
  const RecordingReport report = record(*seen(slow), nullptr, settings, {}, journal, {});
  EXPECT_EQ(report.footer.reason, StopReason::duration);
  EXPECT_GE(report.footer.ticks.skipped, 58);
}

using RecorderDeathTest = RecorderTest;  // run first, before there are threads that a fork would lose

TEST_F(RecorderDeathTest, StopsAtAnInterrupt) {
  settings.servo.duration.reset();
  device.reads = [readings = 0](double, DeviceReading&) mutable {
    if (++readings == 5) std::raise(SIGINT);
    return true;
  };
  EXPECT_EXIT(
      {
        catch_interrupts();
        _exit(run().footer.reason == StopReason::signal ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
  EXPECT_EQ(kept().second->reason, StopReason::signal);
}

TEST_F(RecorderDeathTest, DoesNotBeginAfterAnInterrupt) {  // while the arm moved to calibrate, say
  settings.servo.duration.reset();
  EXPECT_EXIT(
      {
        catch_interrupts();
        std::raise(SIGINT);
        _exit(run().footer.reason == StopReason::signal ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
  EXPECT_EQ(kept().second->reason, StopReason::signal);
  EXPECT_EQ(kept().second->ticks.elapsed, 0);
}

}  // namespace
}  // namespace sandstroke
