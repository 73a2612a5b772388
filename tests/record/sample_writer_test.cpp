#include "record/sample_writer.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"
#include "record/made_recording.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// A device that has nothing to say, however long it is asked: so a loop ends only where something else ends
/// it.
class IdleDevice : public HapticDevice {
 public:
  void open() override {}
  void calibrate() override {}
  const DeviceSpecification& specification() const override { return specification_; }
  double longest_silence() const override { return 1e6; }
  bool read(double, DeviceReading&) noexcept override { return false; }
  bool command(const Eigen::Vector3d&) noexcept override { return true; }
  void release() noexcept override {}
  void close() noexcept override {}

 private:
  DeviceSpecification specification_;
};

/// All that a writer stands between.
struct Parts {
  explicit Parts(const fs::path& path, std::size_t ring_size)
      : ring(ring_size), journal(path, full_header()) {}

  SpscRing<RecordedSample> ring;
  JournalWriter journal;
  IdleDevice device;
  MonotonicClock clock;
  ServoLoop loop{device, nullptr, clock, ring, ServoSettings{}};
};

void push(SpscRing<RecordedSample>& ring, const std::vector<RecordedSample>& samples) {
  for (const RecordedSample& sample : samples)
    while (!ring.push(sample)) std::this_thread::yield();
}

bool holds(const fs::path& path, const std::vector<RecordedSample>& samples) {
  JournalReader reader(path);
  return same_bytes(reader.next(samples.size() + 1), samples);
}

TEST(SampleWriter, WritesAllThatGoesIntoTheRing) {
  const TestFolder folder;
  const std::vector<RecordedSample> samples = made_samples(5000);
  {
    Parts parts(folder / "a", 1500);  // so that it has to keep up
    SampleWriter writer(parts.ring, parts.journal, parts.loop);
    push(parts.ring, samples);
    writer.finish();
    parts.journal.finish(full_footer());
  }
  EXPECT_TRUE(holds(folder / "a", samples));
}

TEST(SampleWriter, WritesWhileItIsFilled) {
  const TestFolder folder;
  Parts parts(folder / "a", 100);
  SampleWriter writer(parts.ring, parts.journal, parts.loop);
  const auto empty = fs::file_size(folder / "a");
  push(parts.ring, made_samples(10));
  while (fs::file_size(folder / "a") != empty + 10 * journal_sample_bytes) std::this_thread::yield();
  EXPECT_EQ(parts.ring.size(), 0u);
}

TEST(SampleWriter, WritesNothingWithoutSamples) {
  const TestFolder folder;
  {
    Parts parts(folder / "a", 100);
    SampleWriter writer(parts.ring, parts.journal, parts.loop);
    writer.finish();
  }
  EXPECT_TRUE(holds(folder / "a", {}));
}

TEST(SampleWriter, AFullDiskStopsTheLoopAndKeepsWhatWasThere) {
  const TestFolder folder;
  const std::vector<RecordedSample> samples = made_samples(3000);
  JournalWriter(folder / "header", full_header());
  const std::uint64_t header = fs::file_size(folder / "header");
  const pid_t child = fork();
  if (child == 0) {
    const rlimit limit{header + 2000 * journal_sample_bytes + 5, header + 2000 * journal_sample_bytes + 5};
    setrlimit(RLIMIT_FSIZE, &limit);
    signal(SIGXFSZ, SIG_IGN);  // writing fails instead, as on a full disk
    Parts parts(folder / "a", 4096);
    push(parts.ring, samples);
    SampleWriter writer(parts.ring, parts.journal, parts.loop);
    const bool stopped = parts.loop.run().reason == StopReason::disk;  // and would not end otherwise
    try {
      writer.finish();
    } catch (const Error& failure) {
      _exit(stopped && failure.kind() == ErrorKind::io ? 0 : 1);
    }
    _exit(2);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  EXPECT_TRUE(holds(folder / "a", {samples.begin(), samples.begin() + 2000}));
}

}  // namespace
}  // namespace sandstroke
