#include "io/recording_file.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>

#include "any_hdf5.h"
#include "core/error.h"
#include "core/output_file.h"
#include "haptics/recording_fields.h"
#include "hdf5/hdf5_file.h"
#include "io/stroke_file.h"
#include "record/made_recording.h"
#include "sanitized.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// A recording of samples in memory.
class KeptRecording : public Recording {
 public:
  KeptRecording(std::vector<RecordedSample> samples, std::optional<RecordingFooter> footer,
                RecordingHeader header = full_header())
      : header_(std::move(header)), samples_(std::move(samples)), last_(std::move(footer)) {}

  const RecordingHeader& header() const override { return header_; }
  std::vector<RecordedSample> next(std::size_t most) override {
    const std::size_t count = std::min(most, samples_.size() - given_);
    given_ += count;
    if (count == 0) footer_ = last_;  // known only then, as of a journal
    return {samples_.data() + given_ - count, samples_.data() + given_};
  }
  const std::optional<RecordingFooter>& footer() const override { return footer_; }

 private:
  RecordingHeader header_;
  std::vector<RecordedSample> samples_;
  std::size_t given_ = 0;
  std::optional<RecordingFooter> last_, footer_;
};

std::string as_text(const std::string& text) { return text; }
std::string as_text(StopReason reason) { return stop_reason_text(reason); }
template <class Number>
std::string as_text(const Number& number) {
  return fmt::format("{:.17g}", static_cast<double>(number));
}

/// Every field of header and footer.
std::vector<std::string> fields(const RecordingInfo& info) {
  std::vector<std::string> all;
  const auto add = [&all](const char* name, const auto& field) {
    all.push_back(name + (": " + as_text(field)));
  };
  visit_header(info.header, add);
  visit_footer(info.footer, add);
  all.push_back(fmt::format("complete: {}", info.complete()));
  return all;
}

/// A column as it is in the file, of a type that this must be.
template <class Number>
std::vector<Number> column(const fs::path& path, const char* name) {
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, without_locks()), H5Fclose);
  const Hdf5Handle dataset(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  EXPECT_GT(H5Tequal(type, hdf5_type(Number{})), 0) << name;
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  std::vector<Number> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
  return values;
}

class RecordingFile : public testing::Test {
 protected:
  RecordingInfo write(std::vector<RecordedSample> samples, const std::optional<RecordingFooter>& footer,
                      const RecordingHeader& header = full_header()) {
    KeptRecording recording(std::move(samples), footer, header);
    std::filesystem::remove(path_);  // none is replaced
    return write_recording_file(path_, recording);
  }

  TestFolder folder_;
  fs::path path_ = folder_ / "recorded.h5";
};

TEST_F(RecordingFile, SaysOfEachColumnWhatItIsAndInWhichUnit) {
  for (const double force_limit : {0.0, 3.0}) {
    RecordingHeader header = full_header();
    header.force_limit = force_limit;
    header.device.measures_velocity = header.device.measures_orientation = force_limit > 0.0;
    write(made_samples(3), full_footer(), header);
    const Hdf5Reader file(path_);
    const std::map<std::string, std::string> units = {
        {"time", "s"},    {"position", "m"},   {"velocity", "m/s"},
        {"force", "N"},   {"orientation", ""}, {"switches", ""},
        {"sequence", ""}, {"flags", ""},       {"monotonic_time", "ns"}};
    for (const auto& [name, unit] : units) {
      const std::string column = "/stroke/" + name;
      ASSERT_EQ(file.has(column),
                force_limit > 0.0 || (name != "velocity" && name != "force" && name != "orientation"))
          << name;
      if (!file.has(column)) continue;
      EXPECT_FALSE(file.text_attribute(column, "long_name").empty()) << name;
      EXPECT_EQ(file.has_attribute(column, "units") ? file.text_attribute(column, "units") : "", unit);
    }
    for (std::uint32_t flag = late_sample; flag <= unfelt_force; flag *= 2)
      EXPECT_THAT(file.text_attribute("/stroke/flags", "long_name"), HasSubstr(fmt::format(" {} ", flag)));
  }
}

TEST_F(RecordingFile, SaysHowLongItLastedAndWhetherTheLoopWasStarved) {
  RecordingFooter footer = full_footer();
  footer.ticks.elapsed = 1001;
  for (const std::int64_t skipped : {100, 101}) {
    footer.ticks.skipped = skipped;
    write(made_samples(3), footer);
    const Stroke stroke = read_stroke_file(path_);
    EXPECT_EQ(stroke.starved, skipped == 101);
    EXPECT_EQ(stroke.nominal_rate, full_header().nominal_rate);
    EXPECT_DOUBLE_EQ(Hdf5Reader(path_).number_attribute("/stroke", "duration"),
                     1000.0 / full_header().nominal_rate);
  }
}

TEST_F(RecordingFile, HoldsTheSamplesToTheBit) {
  for (const int count : {1, 4095, 4096, 4097, 10000}) {  // about the blocks it is written in
    const std::vector<RecordedSample> samples = made_samples(count);
    write(samples, full_footer());
    const auto sequence = column<std::uint64_t>(path_, "/stroke/sequence");
    const auto time = column<std::int64_t>(path_, "/stroke/monotonic_time");
    const auto flags = column<std::uint32_t>(path_, "/stroke/flags");
    const auto switches = column<std::uint32_t>(path_, "/stroke/switches");
    const auto position = column<double>(path_, "/stroke/position");
    const auto velocity = column<double>(path_, "/stroke/velocity");
    const auto force = column<double>(path_, "/stroke/force");
    const auto orientation = column<double>(path_, "/stroke/orientation");
    const auto seconds = column<double>(path_, "/stroke/time");
    ASSERT_EQ(sequence.size(), samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      RecordedSample back;
      back.sequence = sequence.at(i);
      back.time = time.at(i);
      std::copy_n(&position.at(3 * i), 3, back.position);
      std::copy_n(&velocity.at(3 * i), 3, back.velocity);
      std::copy_n(&force.at(3 * i), 3, back.force);
      std::copy_n(&orientation.at(4 * i), 4, back.orientation);
      back.switches = switches.at(i);
      back.flags = flags.at(i);
      ASSERT_EQ(std::memcmp(&back, &samples[i], sizeof back), 0) << i;
      // The double nearest to so many nanoseconds.
      EXPECT_EQ(seconds.at(i), static_cast<double>(samples[i].time - samples[0].time) / 1e9);
    }
  }
}

TEST_F(RecordingFile, IsAStroke) {
  const std::vector<RecordedSample> samples = made_samples(20);
  write(samples, full_footer());
  const Stroke stroke = read_stroke_file(path_);
  ASSERT_EQ(stroke.size(), 20u);
  EXPECT_EQ(stroke.time.front(), 0.0);
  EXPECT_EQ(stroke.time.back(), 19 * 2000003 / 1e9);
  EXPECT_EQ(stroke.velocity.size(), 20u);
  EXPECT_EQ(stroke.force.size(), 20u);
  EXPECT_EQ(stroke.switches.front(), 0xffffffffu);
  EXPECT_TRUE(stroke.contact.empty());
  EXPECT_EQ(stroke.frame, "device");
  EXPECT_EQ(stroke.source, full_header().source);
  EXPECT_EQ(stroke.nominal_rate, full_header().nominal_rate);
  EXPECT_EQ(stroke.gap_threshold, Stroke{}.gap_threshold);
  EXPECT_TRUE(stroke.complete);
}

TEST_F(RecordingFile, HasNoColumnOfWhatWasNotMeasuredOrGiven) {
  RecordingHeader header = full_header();
  header.device.measures_velocity = false;
  header.force_limit = 0.0;
  write(made_samples(3), full_footer(), header);
  const Stroke stroke = read_stroke_file(path_);
  EXPECT_TRUE(stroke.velocity.empty());
  EXPECT_TRUE(stroke.force.empty());
  EXPECT_EQ(stroke.size(), 3u);
}

TEST_F(RecordingFile, SaysHowItWasRecorded) {
  for (int reason = 0; reason < static_cast<int>(StopReason::cut_off); ++reason) {
    RecordingInfo expected{full_header(), full_footer()};
    expected.footer.reason = static_cast<StopReason>(reason);
    // made_samples(20) has the flags 0, 1, ..., 19.
    TickCounts& ticks = expected.footer.ticks;
    ticks.late = 10;
    ticks.clamped = 8;
    ticks.ramped = 8;
    ticks.rate_limited = 4;
    ticks.refused = ticks.deferred = ticks.interlocked = 0;
    const RecordingInfo written = write(made_samples(20), expected.footer);
    EXPECT_EQ(fields(written), fields(expected));
    const std::optional<RecordingInfo> back = read_recording_info(path_);
    ASSERT_TRUE(back);
    EXPECT_EQ(fields(*back), fields(expected));
    EXPECT_EQ(read_stroke_file(path_).complete, expected.complete());
  }
  const Hdf5Reader file(path_);
  EXPECT_EQ(file.text_attribute("/stroke", "clock"), "CLOCK_MONOTONIC");
  EXPECT_EQ(file.number_attribute("/stroke", "clock_start"), std::pow(2.0, 52));
}

TEST_F(RecordingFile, CountsItsTicksWithoutAFooter) {
  write(made_samples(20), std::nullopt);
  const RecordingInfo info = *read_recording_info(path_);
  EXPECT_FALSE(info.complete());
  EXPECT_FALSE(read_stroke_file(path_).complete);
  EXPECT_EQ(info.footer.reason, StopReason::cut_off);
  EXPECT_EQ(Hdf5Reader(path_).text_attribute("/stroke", "stop_reason"), "cut off");
  const TickCounts& ticks = info.footer.ticks;
  EXPECT_EQ(ticks.elapsed, 39);  // sequence 0, 2, ..., 38
  EXPECT_EQ(ticks.recorded, 20);
  EXPECT_EQ(ticks.skipped, 19);
  EXPECT_EQ(ticks.unread + ticks.dropped, 0);
  EXPECT_EQ(ticks.late, 10);
  EXPECT_EQ(ticks.clamped, 8);
  EXPECT_TRUE(std::isnan(info.footer.lateness.mean));
  EXPECT_TRUE(std::isnan(info.footer.lateness.p99));
  EXPECT_TRUE(std::isnan(info.footer.lateness.max));
}

TEST_F(RecordingFile, SamplesThatTheDiskDidNotTakeAreDropped) {
  RecordingFooter footer = full_footer();  // 20 recorded, 3 dropped, by the loop
  footer.reason = StopReason::disk;
  write(made_samples(12), footer);
  const RecordingInfo info = *read_recording_info(path_);
  const TickCounts& ticks = info.footer.ticks;
  EXPECT_EQ(ticks.recorded, 12);
  EXPECT_EQ(ticks.dropped, 3 + 8);
  EXPECT_EQ(ticks.elapsed, ticks.recorded + ticks.skipped + ticks.unread + ticks.dropped);
  EXPECT_FALSE(info.complete());
}

TEST_F(RecordingFile, NothingRecordedMakesNoFile) {
  try {
    write({}, full_footer());
    FAIL();
  } catch (const Error& refused) {
    EXPECT_EQ(refused.kind(), ErrorKind::input);
    EXPECT_THAT(refused.what(), AllOf(HasSubstr("recorded.h5"), HasSubstr("no sample")));
  }
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(RecordingFile, OtherStrokesWereNotRecorded) {
  Stroke stroke;
  stroke.time = {0.0};
  stroke.position = {{1, 2, 3}};
  write_stroke_file(path_, stroke);
  EXPECT_FALSE(read_recording_info(path_));
}

TEST_F(RecordingFile, RefusesCountsThatAreNone) {
  for (const double count : {std::nan(""), 1e300, -1e300}) {
    Hdf5Writer file(path_, any_hdf5);
    file.write("/stroke/time", std::vector<double>{0.0});
    file.attribute("/stroke", "format", std::string("sandstroke.stroke"));
    file.attribute("/stroke", "format_version", 1.0);
    const RecordingInfo info{full_header(), full_footer()};
    const auto put = [&](const char* name, const auto& field) {
      if constexpr (std::is_convertible_v<decltype(field), std::string>)
        file.attribute("/stroke", name, std::string(field));
      else
        file.attribute("/stroke", name, static_cast<double>(field));
    };
    visit_header(info.header, put);
    visit_footer(info.footer, put);
    file.attribute("/stroke", "stop_reason", std::string(stop_reason_text(StopReason::key)));
    file.attribute("/stroke", "ticks_skipped", count);
    file.finish();
    try {
      read_recording_info(path_);
      ADD_FAILURE() << count;
    } catch (const Error& refused) {
      EXPECT_THAT(refused.what(), AllOf(HasSubstr("ticks_skipped"), HasSubstr("not a count")));
    }
  }
}

/// A recording as long as one likes.
class LongRecording : public Recording {
 public:
  explicit LongRecording(std::uint64_t samples) : left_(samples) {}
  const RecordingHeader& header() const override { return header_; }
  std::vector<RecordedSample> next(std::size_t most) override {
    std::vector<RecordedSample> samples(std::min<std::uint64_t>(most, left_));
    for (RecordedSample& sample : samples) {
      sample.sequence = sequence_++;
      sample.time = time_ += 1000000;
    }
    left_ -= samples.size();
    return samples;
  }
  const std::optional<RecordingFooter>& footer() const override { return none_; }

 private:
  RecordingHeader header_ = full_header();
  std::uint64_t left_, sequence_ = 0;
  std::int64_t time_ = 0;
  std::optional<RecordingFooter> none_;
};

TEST_F(RecordingFile, ALongOneTakesNoMoreMemory) {
  if (sanitized) GTEST_SKIP() << "the sanitizer keeps what was freed";
  const pid_t child = fork();
  if (child == 0) {
    const auto peak = [this](std::uint64_t samples) {
      std::filesystem::remove(path_);
      LongRecording recording(samples);
      write_recording_file(path_, recording);
      rusage usage{};
      getrusage(RUSAGE_SELF, &usage);
      return usage.ru_maxrss;  // kB
    };
    const long of_few = peak(300000), of_many = peak(900000);  // 29 and 86 MB of samples
    _exit(of_many - of_few < 8000 ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

}  // namespace
}  // namespace sandstroke
