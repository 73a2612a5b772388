#include "import/mcap.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include "cdr_writer.h"
#include "complaint.h"
#include "import/formats.h"
#include "import/import_stroke.h"
#include "recording_bytes.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::uint64_t begin_time = 1'700'000'000'000'000'000;  // ns

SampleTable read_mcap_bytes(const std::string& bytes, const std::string& part = "") {
  const TestFolder folder;
  put_text(folder / "a.mcap", bytes);
  TableSettings settings;
  settings.part = part;
  const auto table = read_known_format(folder / "a.mcap", settings);
  return table ? *table : SampleTable{};
}

std::string tool_point(int i) {
  return CdrWriter().header(1'700'000'000 + i, 5, "base").numbers({0.1 * i, 2.0, 3.0}).bytes();
}
std::string tool_message(int i) {
  return mcap::message(1, begin_time + static_cast<std::uint64_t>(i) * 1'000'000'000, tool_point(i));
}
std::string tool_channel() {
  return mcap::schema(1, "geometry_msgs/msg/PointStamped") + mcap::channel(1, 1, "/tool");
}
/// Points 2 k and 2 k + 1 of /tool, a message of /camera between them.
std::string tool_records(int k) {
  return tool_message(2 * k) + mcap::message(2, begin_time, std::string(5000, 'p')) + tool_message(2 * k + 1);
}
std::string both_channels() { return tool_channel() + mcap::channel(2, 0, "/camera", "jpeg"); }

void expect_points(const SampleTable& table, int count) {
  ASSERT_EQ(table.size(), static_cast<std::size_t>(count));
  EXPECT_EQ(column(table, "time").origin, 1'700'000'000'000'000'005);
  for (int i = 0; i < count; ++i) {
    EXPECT_EQ(column(table, "time").values[static_cast<std::size_t>(i)], 1e9 * i);
    EXPECT_EQ(column(table, "x").values[static_cast<std::size_t>(i)], 0.1 * i);
  }
}

/// A file from mcap.dev/spec, byte by byte.
TEST(Mcap, AFileByHand) {
  const std::string_view bytes(
      "\x89MCAP0\r\n"
      "\x01\x08\0\0\0\0\0\0\0"  // header of 8 bytes
      "\0\0\0\0"
      "\0\0\0\0"                // profile, library
      "\x03\x25\0\0\0\0\0\0\0"  // schema of 37 bytes
      "\x07\0"                  // its id
      "\x17\0\0\0"
      "geometry_msgs/msg/Point"
      "\0\0\0\0"
      "\0\0\0\0"                // encoding, data
      "\x04\x16\0\0\0\0\0\0\0"  // channel of 22 bytes
      "\x09\0"
      "\x07\0"  // its id, the schema's
      "\x03\0\0\0"
      "/ab"
      "\x03\0\0\0"
      "cdr"
      "\0\0\0\0"                // metadata
      "\x85\x02\0\0\0\0\0\0\0"  // a record of a later kind
      "??"
      "\x05\x32\0\0\0\0\0\0\0"  // message of 50 bytes
      "\x09\0"
      "\x01\0\0\0"              // channel, running number
      "\0\x01\0\0\0\0\0\0"      // recorded at 256 ns
      "\x03\0\0\0\0\0\0\0"      // sent
      "\0\x01\0\0"              // CDR, little-endian
      "\0\0\0\0\0\0\xF0\x3F"    // 1
      "\0\0\0\0\0\0\0\xC0"      // -2
      "\0\0\0\0\0\0\xE0\x3F"    // 0.5
      "\x0F\x04\0\0\0\0\0\0\0"  // end of the data
      "\0\0\0\0"
      "\x02\x14\0\0\0\0\0\0\0"  // footer
      "\0\0\0\0\0\0\0\0"
      "\0\0\0\0\0\0\0\0"
      "\0\0\0\0"
      "\x89MCAP0\r\n",
      8 + 17 + 46 + 31 + 11 + 59 + 13 + 29 + 8);
  const SampleTable table = read_mcap_bytes(std::string(bytes));
  EXPECT_EQ(column(table, "time").origin, 256);
  EXPECT_THAT(column(table, "x").values, ElementsAre(1.0));
  EXPECT_THAT(column(table, "y").values, ElementsAre(-2.0));
  EXPECT_THAT(column(table, "z").values, ElementsAre(0.5));
  EXPECT_THAT(table.warnings, ElementsAre());
  EXPECT_THAT(table.description, HasSubstr("MCAP file: 1 messages of /ab"));
}

TEST(Mcap, ChunksOfEveryPackingWithAndWithoutSummary) {
  for (const char* packing : {"", "lz4", "zstd"}) {
    const std::string first = mcap::chunk(both_channels() + tool_records(0), packing);
    const std::string second =
        mcap::chunk(tool_records(1), packing, 0, tool_records(1).size());  // without checksum
    const std::size_t at = mcap::head().size();
    const std::string summary = both_channels() + mcap::chunk_index(at, {{1, 0}, {2, 0}}) +
                                mcap::chunk_index(at + first.size(), {{1, 0}, {2, 0}}) +
                                mcap::statistics({{1, 4}, {2, 2}});
    for (const std::string& end : {std::string(), summary}) {
      const SampleTable table = read_mcap_bytes(mcap::file(first + second, end));
      expect_points(table, 4);
      EXPECT_THAT(table.warnings, ElementsAre()) << packing;
    }
  }
  expect_points(read_mcap_bytes(mcap::file(both_channels() + tool_records(0) + tool_records(1))),
                4);  // no chunks
}

/// Chunks without the topic are not opened: these bytes are no LZ4.
TEST(Mcap, OnlyChunksWithTheTopicAreRead) {
  const std::string first = mcap::chunk(both_channels() + tool_records(0), "lz4");
  std::string second = mcap::chunk(mcap::message(2, 5, "picture"), "lz4");
  second.replace(second.size() - 20, 20, 20, 'x');
  const std::size_t at = mcap::head().size();
  const auto summary = [&](int channel) {
    return both_channels() + mcap::chunk_index(at, {{1, 0}}) +
           mcap::chunk_index(at + first.size(), {{channel, 0}}) + mcap::statistics({{1, 2}, {2, 2}});
  };
  expect_points(read_mcap_bytes(mcap::file(first + second, summary(2))), 2);
  EXPECT_THAT(
      complaint_of([&] { read_mcap_bytes(mcap::file(first + second, summary(1))); }),
      HasSubstr(fmt::format("of the chunk at byte {}: its packed bytes are damaged", at + first.size())));
}

TEST(Mcap, MessagesInTheBytesOfRos1) {
  const std::string point = CdrWriter(true, 0).header(7, 5, "base").numbers({1.0, 2.0, 3.0}).bytes();
  const SampleTable table = read_mcap_bytes(
      mcap::file(mcap::schema(1, "geometry_msgs/PointStamped", "ros1msg") +
                 mcap::channel(1, 1, "/tool", "ros1") + mcap::message(1, 7'000'000'000, point)));
  EXPECT_EQ(column(table, "time").origin, 7'000'000'005);
  EXPECT_THAT(column(table, "z").values, ElementsAre(3.0));
}

/// The position from one topic, the force from another of the same file; then the recorder's clock.
TEST(Mcap, TwoTopicsOfOneFileAreMerged) {
  const std::string wrench =
      CdrWriter().header(1'700'000'001, 5, "sensor").numbers({5.0, 0, 0, 0, 0, 0}).bytes();
  const std::string data = both_channels() + tool_records(0) +
                           mcap::schema(3, "geometry_msgs/msg/WrenchStamped") +
                           mcap::channel(3, 3, "/force") + mcap::message(3, begin_time, wrench);
  const TestFolder folder;
  put_text(folder / "a.mcap", mcap::file(mcap::chunk(data, "zstd")));
  TableSettings settings;
  settings.part = "/tool";
  settings.time = "recorded";
  EXPECT_EQ(import_stroke(folder / "a.mcap", settings).clock, 1'700'000'000'000'000'000);
  settings.time = "";
  settings.merge = "a.mcap";
  settings.merge_part = "/force";
  settings.force_sign = ForceSign::on_device;
  const Stroke stroke = import_stroke(folder / "a.mcap", settings).stroke;
  ASSERT_EQ(stroke.size(), 1u);  // that the force covers
  EXPECT_EQ(stroke.position[0], Eigen::Vector3d(0.1, 2.0, 3.0));
  EXPECT_EQ(stroke.force[0], Eigen::Vector3d(5.0, 0.0, 0.0));
}

/// A summary that says other things than the file is told of.
TEST(Mcap, ASummaryThatIsWrongIsTold) {
  const std::string data = both_channels() + tool_records(0);
  EXPECT_THAT(read_mcap_bytes(mcap::file(data, both_channels() + mcap::statistics({{1, 3}}))).warnings,
              ElementsAre(AllOf(HasSubstr("has 2 messages"), HasSubstr("counts 3"))));
  std::string damaged = mcap::file(data, both_channels() + mcap::statistics({{1, 2}}));
  damaged[damaged.size() - 40] ^= 1;
  const SampleTable table = read_mcap_bytes(damaged);
  expect_points(table, 2);
  EXPECT_THAT(table.warnings, ElementsAre(HasSubstr("is damaged; the messages themselves are read instead")));
  // Without counts the messages are counted.
  EXPECT_THAT(read_mcap_bytes(mcap::file(data, both_channels())).warnings, ElementsAre());
}

/// A recorder that was killed: whole messages are read, also those of a chunk that is cut off.
TEST(Mcap, ARecordingThatIsCutOffIsReadAsFarAsItGoes) {
  for (const char* packing : {"", "zstd"}) {
    const std::string first = mcap::chunk(both_channels() + tool_records(0), packing);
    const std::string whole = mcap::head() + first + mcap::chunk(tool_records(1), "");
    std::size_t most = 0;
    for (std::size_t size = mcap::head().size() + first.size(); size < whole.size(); size += 53) {
      const SampleTable table = read_mcap_bytes(whole.substr(0, size));
      EXPECT_GE(table.size(), std::max<std::size_t>(most, 2)) << size;
      most = table.size();
      ASSERT_EQ(table.warnings.size(), 1u) << size;
      EXPECT_THAT(table.warnings[0], HasSubstr("was not closed"));
    }
    EXPECT_EQ(most, 3u);
    expect_points(read_mcap_bytes(whole + std::string(1000, '\0')), 4);  // space that was reserved
  }
  const std::string complaint = complaint_of([] { read_mcap_bytes(mcap::magic + "\x01"); });
  EXPECT_THAT(complaint, AllOf(HasSubstr("no topic has messages"), HasSubstr("was not closed")));
}

TEST(Mcap, EveryDamageHasASentenceWithItsByte) {
  const auto complaint = [](const std::string& data) {
    return complaint_of([&] { read_mcap_bytes(mcap::file(data), "/tool"); });
  };
  const std::string two = both_channels() + tool_records(0);
  const std::size_t at = mcap::head().size();
  const std::string here = fmt::format("chunk at byte {}: ", at);
  EXPECT_THAT(complaint(mcap::chunk(two, "zstd", 1, two.size())),
              AllOf(HasSubstr(here + "its checksum is "), HasSubstr("but 00000001 was written")));
  EXPECT_THAT(complaint(mcap::chunk(two, "zstd", 0, two.size() - 1)),
              HasSubstr("bytes is longer than what is left"));
  EXPECT_THAT(complaint(mcap::chunk(two, "lz4", 0, two.size() + 1)),
              HasSubstr(here + fmt::format("it unpacks to {0} instead of {1}", two.size(), two.size() + 1)));
  EXPECT_THAT(complaint(mcap::chunk(both_channels() + tool_message(0) + mcap::record(12, "12345678"), "zstd",
                                    0, both_channels().size() + tool_message(0).size())),
              HasSubstr("it unpacks to more than"));
  EXPECT_THAT(complaint(mcap::chunk(two, "zstd", 0, 1'000'000'000'000)),
              HasSubstr("say that they unpack to 1e+12"));
  EXPECT_THAT(complaint(mcap::chunk(two, "", 0, two.size() + 1)), HasSubstr("that are not packed"));
  EXPECT_THAT(complaint(mcap::chunk(two, "brotli")), HasSubstr("is packed by 'brotli'"));
  EXPECT_THAT(complaint(mcap::chunk(mcap::chunk(two, ""), "")), HasSubstr("a chunk in a chunk"));
  EXPECT_THAT(complaint(tool_channel() + mcap::message(9, 0, "x")),
              HasSubstr("topic 9, which was not described"));
  EXPECT_THAT(complaint(tool_channel() + mcap::channel(1, 1, "/other")), HasSubstr("same number as /tool"));
  EXPECT_THAT(complaint(mcap::record(4, "ab")), HasSubstr("too short for its kind"));
  EXPECT_THAT(complaint(tool_channel() + std::string(9, '\0')), HasSubstr("no record begins there"));
  EXPECT_THAT(complaint(mcap::schema(1, std::string(20'000, 'n'))), HasSubstr("a name of 20000 bytes"));
  EXPECT_THAT(complaint(tool_channel() + mcap::message(1, 0, "short")),
              HasSubstr(fmt::format("byte {} of /tool is not a geometry_msgs/msg/PointStamped",
                                    at + tool_channel().size())));
}

/// Whatever a byte is changed to, the reader ends with samples or a sentence.
TEST(Mcap, NoChangedByteIsFatal) {
  const std::string first = mcap::chunk(tool_channel() + tool_message(0), "zstd");
  const std::string whole = mcap::file(
      first + mcap::chunk(tool_message(1), "lz4") + tool_message(2),
      tool_channel() + mcap::chunk_index(mcap::head().size(), {{1, 0}}) + mcap::statistics({{1, 3}}));
  const TestFolder folder;
  for (std::size_t i = mcap::magic.size(); i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ "\x01\x80\xFF"[i % 3]);
    std::filesystem::remove(folder / "a.mcap");  // truncating would wait for the disk
    put_text(folder / "a.mcap", changed);
    complaint_of([&] { EXPECT_GT(read_mcap(folder / "a.mcap", "/tool").size(), 0u); });
  }
}

}  // namespace
}  // namespace sandstroke
