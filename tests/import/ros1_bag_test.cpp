#include "import/ros1_bag.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include "cdr_writer.h"
#include "complaint.h"
#include "import/formats.h"
#include "recording_bytes.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

SampleTable read_bag_bytes(const std::string& bytes, const std::string& part = "") {
  const TestFolder folder;
  put_text(folder / "a.bag", bytes);
  TableSettings settings;
  settings.part = part;
  const auto table = read_known_format(folder / "a.bag", settings);
  return table ? *table : SampleTable{};
}

std::string bag_point(int i) {
  const std::string bytes =
      CdrWriter(true, 0).header(1'700'000'000 + i, 5, "base").numbers({0.1 * i, 2, 3}).bytes();
  return ros1::message(3, static_cast<std::uint32_t>(1'700'000'000 + i), 9, bytes);
}
std::string bag_topics() {
  return ros1::connection(3, "/tool", "geometry_msgs/PointStamped") +
         ros1::connection(4, "/sound", "audio/Data");
}

void expect_bag_points(const SampleTable& table, std::size_t count) {
  ASSERT_EQ(table.size(), count);
  EXPECT_EQ(column(table, "time").origin, 1'700'000'000'000'000'005);
  EXPECT_EQ(column(table, "recorded").origin, 1'700'000'000'000'000'009);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(column(table, "time").values[i], 1e9 * static_cast<double>(i));
    EXPECT_EQ(column(table, "x").values[i], 0.1 * static_cast<double>(i));
  }
}

/// A bag from wiki.ros.org/Bags/Format/2.0, byte by byte, that was not closed.
TEST(Ros1Bag, AFileByHand) {
  const std::string record_of_file = std::string("\x1E\0\0\0", 4) + std::string("\x04\0\0\0op=\x03", 8) +
                                     std::string("\x12\0\0\0index_pos=\0\0\0\0\0\0\0\0", 22) +
                                     std::string("\x02\0\0\0  ", 6);
  const std::string connection = std::string("\x21\0\0\0", 4) + std::string("\x04\0\0\0op=\x07", 8) +
                                 std::string("\x09\0\0\0conn=\x02\0\0\0", 13) +
                                 std::string("\x08\0\0\0topic=/a", 12) + std::string("\x1C\0\0\0", 4) +
                                 std::string("\x18\0\0\0type=geometry_msgs/Point", 28);
  const std::string message = std::string("\x26\0\0\0", 4) + std::string("\x04\0\0\0op=\x02", 8) +
                              std::string("\x09\0\0\0conn=\x02\0\0\0", 13) +
                              std::string("\x0D\0\0\0time=\x01\0\0\0\x03\0\0\0", 17) +
                              std::string("\x18\0\0\0", 4) +
                              std::string("\0\0\0\0\0\0\xF0\x3F\0\0\0\0\0\0\0\xC0\0\0\0\0\0\0\xE0\x3F", 24);
  const SampleTable table = read_bag_bytes("#ROSBAG V2.0\n" + record_of_file + connection + message);
  EXPECT_EQ(column(table, "time").origin, 1'000'000'003);
  EXPECT_THAT(column(table, "x").values, ElementsAre(1.0));
  EXPECT_THAT(column(table, "y").values, ElementsAre(-2.0));
  EXPECT_THAT(column(table, "z").values, ElementsAre(0.5));
  EXPECT_THAT(table.warnings, ElementsAre(HasSubstr("was not closed")));
}

TEST(Ros1Bag, ChunksOfEveryPackingWithAndWithoutIndex) {
  for (const char* packing : {"none", "lz4", "bz2"}) {
    const std::string sound = ros1::message(4, 1, 0, "sound");
    const std::string first = ros1::chunk(bag_topics() + bag_point(0) + sound + bag_point(1), packing);
    const std::string data = first + ros1::chunk(bag_point(2), packing);
    const std::size_t at = ros1::head(0).size();
    const SampleTable table =
        read_bag_bytes(ros1::file(data, bag_topics() + ros1::chunk_info(at, {{3, 2}, {4, 1}}) +
                                            ros1::chunk_info(at + first.size(), {{3, 1}})));
    expect_bag_points(table, 3);
    EXPECT_THAT(table.warnings, ElementsAre()) << packing;
    EXPECT_THAT(table.description, HasSubstr("ROS 1 bag: 3 messages of /tool"));
    expect_bag_points(read_bag_bytes(ros1::file(data, "")), 3);  // not closed
  }
}

TEST(Ros1Bag, OneThatIsCutOffIsReadAsFarAsItGoes) {
  const std::string whole = ros1::file(ros1::chunk(bag_topics() + bag_point(0) + bag_point(1), "none"), "");
  for (std::size_t size = whole.size() - bag_point(1).size(); size < whole.size(); ++size) {
    const SampleTable table = read_bag_bytes(whole.substr(0, size));
    expect_bag_points(table, 1);
    EXPECT_THAT(table.warnings, ElementsAre(AllOf(HasSubstr("was not closed"), HasSubstr("byte"))));
  }
}

TEST(Ros1Bag, EveryDamageHasASentenceWithItsByte) {
  const auto complaint = [](const std::string& data) {
    const std::string index = bag_topics() + ros1::chunk_info(ros1::head(0).size(), {{3, 1}});
    return complaint_of([&] { read_bag_bytes(ros1::file(data, index), "/tool"); });
  };
  const std::string at = fmt::format("byte {}", ros1::head(0).size());
  EXPECT_THAT(complaint(ros1::chunk(bag_topics() + bag_point(0) + "xyz", "lz4")),
              HasSubstr("of the chunk at " + at));
  EXPECT_THAT(complaint(ros1::record(9, {}, "")), HasSubstr(at + ": a record of the unknown kind 9"));
  EXPECT_THAT(complaint(ros1::record(2, {{"conn", number_bytes(3, 4)}}, "")), HasSubstr("no field time"));
  EXPECT_THAT(complaint(ros1::record(2, {{"conn", "x"}}, "")),
              HasSubstr("field conn of its header has 1 bytes"));
  for (const std::string& header :
       {std::string("nothing"), std::string("abc"), counted_text("nothing"), counted_text("")})
    EXPECT_THAT(complaint(counted_text(header) + counted_text("")), HasSubstr("fields NAME=VALUE")) << header;
  EXPECT_THAT(complaint(ros1::message(3, 1, 0, "short")),
              HasSubstr(at + " of /tool is not a geometry_msgs/Point"));
  EXPECT_THAT(complaint(ros1::record(5, {{"compression", "xz"}, {"size", number_bytes(9, 4)}}, "")),
              HasSubstr("is packed by 'xz'"));
}

/// Whatever a byte is changed to, the reader ends with samples or a sentence.
TEST(Ros1Bag, NoChangedByteIsFatal) {
  const std::string first = ros1::chunk(bag_topics() + bag_point(0), "bz2");
  const std::size_t at = ros1::head(0).size();
  const std::string whole = ros1::file(
      first + ros1::chunk(bag_point(1), "lz4") + bag_point(2),
      bag_topics() + ros1::chunk_info(at, {{3, 1}}) + ros1::chunk_info(at + first.size(), {{3, 1}}));
  const TestFolder folder;
  for (std::size_t i = ros1::magic.size(); i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ "\x01\x80\xFF"[i % 3]);
    std::filesystem::remove(folder / "a.bag");  // truncating would wait for the disk
    put_text(folder / "a.bag", changed);
    complaint_of([&] { EXPECT_GT(read_ros1_bag(folder / "a.bag", "/tool").size(), 0u); });
  }
}

}  // namespace
}  // namespace sandstroke
