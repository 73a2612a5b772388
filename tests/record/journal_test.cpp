#include "record/journal.h"

#include <fcntl.h>
#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <random>

#include "core/error.h"
#include "core/hash.h"
#include "core/input_file.h"
#include "core/output_file.h"
#include "record/made_recording.h"
#include "record/recording_json.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr std::size_t sample_block = 16 + 128;  // bytes, as journal.h says

std::vector<RecordedSample> first(const std::vector<RecordedSample>& samples, std::size_t count) {
  return {samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(count)};
}

std::vector<RecordedSample> all_samples(JournalReader& reader, std::size_t most = 7) {
  std::vector<RecordedSample> all;
  for (std::vector<RecordedSample> some = reader.next(most); !some.empty(); some = reader.next(most)) {
    EXPECT_LE(some.size(), most);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

template <class Call>
std::string complaint(ErrorKind kind, const Call& call) {
  try {
    call();
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), kind) << failure.what();
    return failure.what();
  }
  return "";
}

/// A file that is on no disk.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("journal", MFD_CLOEXEC)) {}
  MemoryFile(const MemoryFile&) = delete;
  ~MemoryFile() { close(descriptor_); }
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

class Journal : public testing::Test {
 protected:
  /// The bytes of a journal with these samples; where one is given, with a footer.
  std::string bytes_of(const std::vector<RecordedSample>& samples,
                       const std::optional<RecordingFooter>& footer = {}) {
    const fs::path path = folder_ / "whole";
    fs::remove(path);
    JournalWriter writer(path, full_header());
    writer.append(samples);
    if (footer) writer.finish(*footer);
    return read_text_file(path);
  }
  /// A folder in memory, for thousands of files would keep a disk busy.
  fs::path file_of(const std::string& bytes) {
    EXPECT_EQ(ftruncate(memory_.get(), 0), 0);
    EXPECT_EQ(pwrite(memory_.get(), bytes.data(), bytes.size(), 0), static_cast<ssize_t>(bytes.size()));
    return "/proc/self/fd/" + std::to_string(memory_.get());
  }

  TestFolder folder_;
  MemoryFile memory_;
};

TEST_F(Journal, LiesBesideItsStroke) {
  EXPECT_EQ(journal_path("a.b/stroke.h5"), fs::path("a.b/stroke.h5.recording"));
}

/// The checksums are right: only a writer gone wrong, or an enemy, makes such files.
TEST_F(Journal, NumbersBeyondAllCountsAreDamage) {
  std::vector<RecordedSample> samples = made_samples(3);
  samples[2].sequence = std::uint64_t{1} << 62;
  JournalReader far(file_of(bytes_of(samples)));
  EXPECT_EQ(all_samples(far).size(), 2u);
  EXPECT_EQ(far.lost_bytes(), journal_sample_bytes);

  for (const std::int64_t count : {std::numeric_limits<std::int64_t>::min(), std::int64_t{-1}, most_ticks + 1,
                                   std::numeric_limits<std::int64_t>::max()}) {
    RecordingFooter footer = full_footer();
    footer.ticks.unread = count;
    JournalReader reader(file_of(bytes_of(made_samples(3), footer)));
    EXPECT_EQ(all_samples(reader).size(), 3u);
    EXPECT_FALSE(reader.footer());
  }
  nlohmann::ordered_json header = as_json(full_header());
  for (const double count : {1.5, 1e300, -1e300}) {
    header["device_switches"] = count;
    EXPECT_THROW(header_from_json(header), nlohmann::json::exception);
  }
}

TEST(RecordingJson, ANumberThatIsNoneIsNullAndReadsAsNone) {
  RecordingFooter footer = full_footer();
  footer.lateness.p99 = std::numeric_limits<double>::quiet_NaN();
  const auto text = as_json(footer).dump();
  const RecordingFooter back = footer_from_json(nlohmann::ordered_json::parse(text));
  EXPECT_NE(text.find("\"lateness_p99\":null"), std::string::npos) << text;
  EXPECT_TRUE(std::isnan(back.lateness.p99));
  EXPECT_EQ(back.lateness.max, footer.lateness.max);
}

TEST(RecordingJson, FieldsThatAnEarlierVersionLeftOutHaveDefaults) {
  nlohmann::ordered_json header = as_json(full_header()), footer = as_json(full_footer());
  header.erase("device_max_damping");
  header.erase("device_hand_feels");
  footer.erase("ticks_interlocked");
  EXPECT_EQ(header_from_json(header).device.max_damping, 0.0);
  EXPECT_TRUE(header_from_json(header).device.hand_feels);
  EXPECT_EQ(header_from_json(header).device.max_stiffness, full_header().device.max_stiffness);
  EXPECT_EQ(footer_from_json(footer).ticks.interlocked, 0);
  EXPECT_EQ(footer_from_json(footer).ticks.deferred, full_footer().ticks.deferred);
}

TEST(RecordingJson, AReasonOfALaterVersionIsNotTakenForOneOfThis) {
  nlohmann::ordered_json json = as_json(full_footer());
  json["stop_reason"] = "the moon was full";
  EXPECT_EQ(footer_from_json(json).reason, StopReason::cut_off);
}

TEST_F(Journal, ComesBackToTheBit) {
  const fs::path path = folder_ / "a";
  const std::vector<RecordedSample> samples = made_samples(100);
  {
    JournalWriter writer(path, full_header());
    writer.append({samples.data(), 1});
    writer.append({});
    writer.append({samples.data() + 1, 99});
    writer.sync();
    writer.finish(full_footer());
    JournalReader reader(path);  // which the writer, done, does not keep out
    EXPECT_EQ(as_json(reader.header()), as_json(full_header()));
    EXPECT_FALSE(reader.footer());
    EXPECT_TRUE(same_bytes(all_samples(reader), samples));
    ASSERT_TRUE(reader.footer());
    EXPECT_EQ(as_json(*reader.footer()), as_json(full_footer()));
    EXPECT_EQ(reader.lost_bytes(), 0u);
    EXPECT_TRUE(reader.next(1).empty());
  }
}

TEST_F(Journal, IsReadFromTheVersionBefore) {  // whose samples were 96 bytes and had no orientation
  const std::vector<RecordedSample> samples = made_samples(1);
  std::string bytes = bytes_of(samples);
  bytes[20] = 1;
  std::string block = bytes.substr(bytes.size() - sample_block, 16 + 96);
  block[4] = 96;
  ContentHash hash;
  hash.add(block.substr(0, 8) + block.substr(16));
  const std::uint64_t checksum = hash.value();
  std::memcpy(block.data() + 8, &checksum, 8);
  const fs::path path = folder_ / "before.h5.recording";
  std::ofstream(path, std::ios::binary) << bytes.substr(0, bytes.size() - sample_block) << block;
  JournalReader reader(path);
  const std::vector<RecordedSample> back = reader.next(7);
  ASSERT_EQ(back.size(), 1u);
  EXPECT_EQ(std::memcmp(back.data(), samples.data(), 96), 0);
  EXPECT_TRUE(std::equal(back[0].orientation, back[0].orientation + 4, RecordedSample{}.orientation));
}

TEST_F(Journal, IsWhatItsHeaderSays) {  // by another program's eyes
  const std::vector<RecordedSample> samples = made_samples(1);
  const std::string bytes = bytes_of(samples);
  EXPECT_EQ(bytes.substr(0, 24), std::string("sandstroke.recording\2\0\0\0", 24));
  const std::string sample = bytes.substr(bytes.size() - sample_block);
  EXPECT_EQ(sample.substr(0, 8), std::string("\2\0\0\0\x80\0\0\0", 8));
  EXPECT_EQ(std::memcmp(sample.data() + 16, samples.data(), 128), 0);
  ContentHash hash;
  hash.add(sample.substr(0, 8) + sample.substr(16));
  std::uint64_t checksum = 0;
  std::memcpy(&checksum, sample.data() + 8, 8);
  EXPECT_EQ(hash.value(), checksum);
}

TEST_F(Journal, NumbersThatAreNoneComeBackAsSuch) {
  RecordingHeader header = full_header();
  header.device.max_force = std::numeric_limits<double>::infinity();
  header.source = "scripted:\xff.toml";  // a file's name may be any bytes
  JournalWriter(folder_ / "a", header);
  const JournalReader reader(folder_ / "a");
  EXPECT_TRUE(std::isnan(reader.header().device.max_force));
  EXPECT_EQ(reader.header().source, "scripted:\xef\xbf\xbd.toml");
}

TEST_F(Journal, AnEarlierRecordingIsNeverOverwritten) {
  JournalWriter(folder_ / "a", full_header());
  const std::string before = read_text_file(folder_ / "a");
  EXPECT_THAT(complaint(ErrorKind::io, [&] { JournalWriter(folder_ / "a", full_header()); }),
              AllOf(HasSubstr("/a:"), HasSubstr("sandstroke stroke repair")));
  EXPECT_EQ(read_text_file(folder_ / "a"), before);
}

TEST_F(Journal, OneThatIsStillWrittenIsNotRead) {
  JournalWriter writer(folder_ / "a", full_header());
  EXPECT_THAT(complaint(ErrorKind::io, [&] { JournalReader(folder_ / "a"); }), HasSubstr("still being"));
  EXPECT_THAT(complaint(ErrorKind::io, [&] { JournalWriter(folder_ / "a", full_header()); }),
              HasSubstr("still being"))
      << "it was not cut off";
}

TEST_F(Journal, CutOffAnywhereGivesTheWholeSamplesBefore) {
  const std::vector<RecordedSample> samples = made_samples(5);
  const std::string whole = bytes_of(samples, full_footer());
  const std::size_t header_end = bytes_of({}).size(), samples_end = bytes_of(samples).size();
  ASSERT_EQ(samples_end, header_end + 5 * sample_block);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const fs::path path = file_of(whole.substr(0, size));
    if (size < header_end) {
      EXPECT_NE(complaint(ErrorKind::input, [&] { JournalReader{path}; }), "") << size;
      continue;
    }
    JournalReader reader(path);
    const std::size_t sound = std::min<std::size_t>(5, (size - header_end) / sample_block);
    EXPECT_TRUE(same_bytes(all_samples(reader), first(samples, sound))) << size;
    EXPECT_FALSE(reader.footer()) << size;
    EXPECT_EQ(reader.lost_bytes(), size - header_end - sound * sample_block) << size;
  }
}

TEST_F(Journal, AFlippedByteLosesOnlyWhatFollows) {
  const std::vector<RecordedSample> samples = made_samples(5);
  const std::string whole = bytes_of(samples, full_footer());
  const std::size_t header_end = bytes_of({}).size();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int flip : {1, 0x80, 0xff}) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      const fs::path path = file_of(bytes);
      if (at < header_end) {
        EXPECT_NE(complaint(ErrorKind::input, [&] { JournalReader{path}; }), "") << at;
        continue;
      }
      JournalReader reader(path);
      const std::size_t sound = std::min<std::size_t>(5, (at - header_end) / sample_block);
      EXPECT_TRUE(same_bytes(all_samples(reader), first(samples, sound))) << at;
      EXPECT_FALSE(reader.footer()) << at;
      EXPECT_EQ(reader.lost_bytes(), whole.size() - header_end - sound * sample_block) << at;
    }
  }
}

TEST_F(Journal, SamplesThatDoNotFollowEachOtherAreDamage) {
  const auto sound_of = [&](const auto& spoil) {
    std::vector<RecordedSample> samples = made_samples(6);
    spoil(samples);
    JournalReader reader(file_of(bytes_of(samples)));
    const std::size_t sound = all_samples(reader).size();
    EXPECT_EQ(reader.lost_bytes(), (6 - sound) * sample_block);
    return sound;
  };
  EXPECT_EQ(sound_of([](auto&) {}), 6u);
  EXPECT_EQ(sound_of([](auto& s) { s[4].sequence = s[3].sequence; }), 4u);
  EXPECT_EQ(sound_of([](auto& s) { s[4].sequence = 0; }), 4u);
  EXPECT_EQ(sound_of([](auto& s) { s[4].sequence = ~std::uint64_t{0}; }), 4u);
  EXPECT_EQ(sound_of([](auto& s) { s[3].time = s[2].time; }), 3u);
  EXPECT_EQ(sound_of([](auto& s) { s[0].time = -1; }), 0u);
}

TEST_F(Journal, BytesAfterTheFooterAreNoSample) {
  const std::string block = bytes_of(made_samples(3)).substr(bytes_of(made_samples(2)).size());
  JournalReader reader(file_of(bytes_of(made_samples(2), full_footer()) + block));
  EXPECT_EQ(all_samples(reader).size(), 2u);
  EXPECT_TRUE(reader.footer());
  EXPECT_EQ(reader.lost_bytes(), sample_block);
}

/// Bytes that follow the signature: anything, also such blocks as could be ones.
std::string garbage(std::mt19937_64& random) {
  const auto upto = [&random](std::uint64_t most) { return random() % (most + 1); };
  std::string bytes;
  for (std::uint64_t parts = upto(6); parts > 0; --parts) {
    std::string content(upto(200), '\0');
    for (char& c : content) c = static_cast<char>(random());
    if (upto(2) == 0) content = "{\"source\": [[[[{}]]]], \"frame\": 1e999}";
    if (upto(3) == 0) content.resize(128, 'x');
    const std::uint32_t frame[2] = {
        static_cast<std::uint32_t>(upto(4)),
        upto(3) == 0 ? static_cast<std::uint32_t>(random()) : static_cast<std::uint32_t>(content.size())};
    ContentHash hash;
    hash.add(frame, sizeof frame);
    hash.add(content);
    const std::uint64_t checksum = upto(3) == 0 ? random() : hash.value();
    bytes.append(reinterpret_cast<const char*>(frame), sizeof frame);
    bytes.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
    bytes += content;
  }
  return bytes.substr(0, upto(3) == 0 ? upto(bytes.size()) : bytes.size());
}

TEST_F(Journal, AnyBytesAreReadToTheirEndOrRefused) {
  std::mt19937_64 random(6);
  const std::string sound = bytes_of(made_samples(2));
  for (int i = 0; i < 2000; ++i) {
    const std::string begin = i % 2 == 0 ? sound : sound.substr(0, 24);
    const std::string bytes = begin + garbage(random);
    try {
      JournalReader reader(file_of(bytes));
      const std::size_t count = all_samples(reader, 1u << 30).size();
      EXPECT_GE(count, i % 2 == 0 ? 2u : 0u);
      EXPECT_LE(reader.lost_bytes() + count * sample_block, bytes.size());
    } catch (const Error& refused) {
      EXPECT_EQ(refused.kind(), ErrorKind::input);
      EXPECT_EQ(i % 2, 1) << refused.what();
    }
  }
}

/// Runs `act` in a child, which must end by itself with exit code 0, or by SIGKILL.
template <class Act>
void in_child(const Act& act) {
  const pid_t child = fork();
  if (child == 0) {
    act();
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE((WIFEXITED(status) && WEXITSTATUS(status) == 0) ||
              (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL))
      << status;
}

/// No file of this process grows beyond that: as on a full disk.
void limit_files(std::uint64_t bytes) {
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_FSIZE, &limit);
  signal(SIGXFSZ, SIG_IGN);
}

TEST_F(Journal, AClaimedLengthTakesNoMemory) {
  std::string bytes = bytes_of(made_samples(2));
  const std::uint32_t frame[4] = {3, 0xfffffff0u, 0, 0};
  bytes.append(reinterpret_cast<const char*>(frame), sizeof frame);
  const fs::path path = file_of(bytes);
  in_child([&] {
    rusage before{}, after{};
    getrusage(RUSAGE_SELF, &before);
    JournalReader reader(path);
    const bool sound = reader.next(~std::size_t{0}).size() == 2 && reader.lost_bytes() == sizeof frame;
    getrusage(RUSAGE_SELF, &after);
    _exit(sound && after.ru_maxrss - before.ru_maxrss < 10000 ? 0 : 1);  // kB
  });
}

TEST_F(Journal, AFullDiskKeepsWhatWasThere) {
  const std::vector<RecordedSample> samples = made_samples(40);
  const std::size_t header_end = bytes_of({}).size();
  for (const std::size_t room : {0ul, 1ul, 111ul, 112ul, 113ul, 1000ul, 10 * sample_block}) {
    const fs::path path = folder_ / ("full" + std::to_string(room));
    in_child([&] {
      limit_files(header_end + room);
      JournalWriter writer(path, full_header());
      int failures = 0;
      for (const std::size_t half : {0u, 20u}) {
        try {
          writer.append({samples.data() + half, 20});
        } catch (const Error& failure) {
          failures += failure.kind() == ErrorKind::io &&
                      std::string(failure.what()).find("free disk space") != std::string::npos;
        }
      }
      _exit(failures == 2 ? 0 : 1);
    });
    JournalReader reader(path);
    EXPECT_TRUE(same_bytes(all_samples(reader), first(samples, room / sample_block))) << room;
    EXPECT_EQ(reader.lost_bytes(), 0u) << "half a record is cut off again";
  }
}

TEST_F(Journal, GoesOnAfterAFullDisk) {
  const std::vector<RecordedSample> samples = made_samples(4);
  const std::size_t header_end = bytes_of({}).size();
  in_child([&] {
    JournalWriter writer(folder_ / "a", full_header());
    const rlimit little{header_end + 2 * sample_block + 50, RLIM_INFINITY};
    setrlimit(RLIMIT_FSIZE, &little);
    signal(SIGXFSZ, SIG_IGN);
    try {
      writer.append(samples);
      _exit(1);
    } catch (const Error&) {
    }
    const rlimit enough{RLIM_INFINITY, RLIM_INFINITY};
    setrlimit(RLIMIT_FSIZE, &enough);
    writer.append({samples.data() + 3, 1});
    writer.finish(full_footer());
  });
  JournalReader reader(folder_ / "a");
  EXPECT_TRUE(same_bytes(all_samples(reader), {samples[0], samples[1], samples[3]}));
  EXPECT_TRUE(reader.footer());
}

TEST_F(Journal, OneThatSomebodyRemovedOrReplacedIsNotWrittenOnInVain) {
  const fs::path path = folder_ / "a";
  for (const bool replaced : {false, true}) {
    fs::remove(path);
    JournalWriter writer(path, full_header());
    writer.append(made_samples(10));
    writer.sync();
    fs::remove(path);
    if (replaced) put_text(path, "another's");
    EXPECT_THROW(writer.sync(), Error);
    EXPECT_THROW(writer.finish(full_footer()), Error);
  }
  EXPECT_EQ(read_text_file(path), "another's");
}

TEST_F(Journal, LeavesNothingWithoutRoomForTheHeader) {
  in_child([&] {
    limit_files(100);
    try {
      JournalWriter(folder_ / "a", full_header());
      _exit(1);
    } catch (const Error&) {
    }
  });
  EXPECT_FALSE(fs::exists(folder_ / "a"));
}

TEST_F(Journal, AKillLosesNothingThatWasAppended) {
  const std::vector<RecordedSample> samples = made_samples(200000);
  int told[2];
  ASSERT_EQ(pipe(told), 0);
  const pid_t child = fork();
  if (child == 0) {
    JournalWriter writer(folder_ / "a", full_header());
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
      writer.append({&samples[i], 1});
      const std::uint32_t appended = i + 1;
      if (::write(told[1], &appended, sizeof appended) != sizeof appended) _exit(1);
    }
    _exit(0);
  }
  close(told[1]);
  std::uint32_t appended = 0;
  for (std::uint32_t count = 0; read(told[0], &count, sizeof count) == sizeof count; appended = count)
    if (count == 1000) kill(child, SIGKILL);
  close(told[0]);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status));
  JournalReader reader(folder_ / "a");
  const std::vector<RecordedSample> back = all_samples(reader, 1000);
  EXPECT_GE(appended, 1000u);
  EXPECT_GE(back.size(), appended);
  EXPECT_LE(back.size(), appended + 1u);
  EXPECT_TRUE(same_bytes(back, first(samples, back.size())));
  EXPECT_FALSE(reader.footer());
}

TEST_F(Journal, SaysWhatCannotBeRead) {
  EXPECT_THAT(complaint(ErrorKind::io, [&] { JournalReader{folder_ / "absent"}; }), HasSubstr("absent"));
  EXPECT_THAT(complaint(ErrorKind::io, [&] { JournalReader{folder_.path()}; }), HasSubstr("folder"));
  EXPECT_THAT(complaint(ErrorKind::io, [&] { JournalReader{"/dev/zero"}; }), HasSubstr("regular file"));
  // Nothing is at address 0 of this process: reading it is an error of the disk.
  EXPECT_THAT(complaint(ErrorKind::io, [&] { JournalReader{"/proc/self/mem"}; }),
              HasSubstr("cannot be read (Input/output error)"));
  EXPECT_THAT(complaint(ErrorKind::input, [&] { JournalReader{file_of("no journal")}; }),
              HasSubstr("not the journal"));
  std::string later = bytes_of({});
  later[20] = 3;
  EXPECT_THAT(complaint(ErrorKind::input, [&] { JournalReader{file_of(later)}; }),
              AllOf(HasSubstr("format 3"), HasSubstr("reads format 2")));
}

TEST_F(Journal, SaysWhereItCannotBeWritten) {
  EXPECT_THAT(
      complaint(ErrorKind::io, [&] { JournalWriter(folder_.path() / "no" / "where", full_header()); }),
      HasSubstr("choose another place"));
  if (geteuid() == 0) return;  // who may write anywhere
  fs::permissions(folder_.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_NE(complaint(ErrorKind::io, [&] { JournalWriter(folder_ / "a", full_header()); }), "");
  fs::permissions(folder_.path(), fs::perms::owner_all);
}

}  // namespace
}  // namespace sandstroke
