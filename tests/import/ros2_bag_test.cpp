#include "import/ros2_bag.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>

#include "cdr_writer.h"
#include "complaint.h"
#include "import/import_stroke.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A bag with the tables of rosbag2.
class BagFile {
 public:
  explicit BagFile(const std::filesystem::path& path) {
    EXPECT_EQ(sqlite3_open(path.c_str(), &database_), SQLITE_OK);
    run("PRAGMA synchronous = OFF; PRAGMA journal_mode = OFF;"
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT, "
        "offered_qos_profiles TEXT);"
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)");
  }
  ~BagFile() { sqlite3_close(database_); }

  void run(const std::string& sql) {
    EXPECT_EQ(sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
  }
  void topic(int id, const std::string& name, const std::string& type) {
    run(fmt::format("INSERT INTO topics VALUES({}, '{}', '{}', 'cdr', '')", id, name, type));
  }
  void message(int topic, std::int64_t time, const std::string& bytes) {
    std::string hex;
    for (const char c : bytes) hex += fmt::format("{:02x}", static_cast<unsigned char>(c));
    run(fmt::format("INSERT INTO messages(topic_id, timestamp, data) VALUES({}, {}, x'{}')", topic, time,
                    hex));
  }

 private:
  sqlite3* database_ = nullptr;
};

std::string point(std::int32_t seconds, std::uint32_t nanoseconds, double x) {
  return CdrWriter().header(seconds, nanoseconds, "base").number(x).number(2.0).number(3.0).bytes();
}
std::string wrench(double fx) {
  CdrWriter writer;
  writer.header(7, 0, "sensor").number(fx);
  for (int i = 0; i < 5; ++i) writer.number(0.0);
  return writer.bytes();
}

/// Positions out of their order in the file, and a picture that is no stroke.
void fill(BagFile& bag) {
  bag.topic(1, "/camera", "sensor_msgs/msg/Image");
  bag.topic(4, "/tool", "geometry_msgs/msg/PointStamped");
  bag.message(4, 2000, point(10, 500'000'000, 0.2));
  bag.message(1, 1500, "pixels");
  bag.message(4, 1000, point(10, 250'000'000, 0.1));
}

TEST(Ros2Bag, TheOneTopicThatFitsIsTaken) {
  const TestFolder folder;
  const std::filesystem::path path = folder / "a bag #1 50%?.db3";
  BagFile bag(path);
  fill(bag);
  const SampleTable table = read_ros2_bag(path);
  EXPECT_THAT(column(table, "time").values, ElementsAre(0, 250'000'000));
  EXPECT_EQ(column(table, "time").origin, 10'250'000'000);
  EXPECT_EQ(column(table, "time").unit, "ns");
  EXPECT_THAT(column(table, "x").values, ElementsAre(0.1, 0.2));
  EXPECT_EQ(column(table, "x").unit, "m");
  EXPECT_THAT(table.description, AllOf(HasSubstr("2 messages of /tool"), HasSubstr("headers")));
}

TEST(Ros2Bag, AsksForOneOfSeveralTopics) {
  const TestFolder folder;
  BagFile bag(folder / "bag.db3");
  fill(bag);
  bag.topic(2, "/force", "geometry_msgs/msg/WrenchStamped");
  bag.message(2, 1000, wrench(5.0));
  bag.topic(3, "/silent", "geometry_msgs/msg/PoseStamped");
  EXPECT_THAT(complaint_of([&] { read_ros2_bag(folder / "bag.db3"); }),
              AllOf(HasSubstr("--part): /force (geometry_msgs/msg/WrenchStamped, 1 messages), /tool"),
                    Not(HasSubstr("/camera")), Not(HasSubstr("/silent"))));
  EXPECT_THAT(complaint_of([&] { read_ros2_bag(folder / "bag.db3", "/camera"); }),
              HasSubstr("'/camera' cannot be read"));
  EXPECT_THAT(column(read_ros2_bag(folder / "bag.db3", "/force"), "fx").values, ElementsAre(5.0));
  EXPECT_EQ(read_ros2_bag(folder / "bag.db3", "/tool").size(), 2u);
}

TEST(Ros2Bag, TakesTheBagsTimeWithoutStamps) {
  const TestFolder folder;
  BagFile bag(folder / "bag.db3");
  bag.topic(1, "/tool", "geometry_msgs/msg/Point");
  bag.message(1, 1'700'000'000'250'000'000, CdrWriter().number(1.0).number(2.0).number(3.0).bytes());
  const SampleTable table = read_ros2_bag(folder / "bag.db3");
  EXPECT_THAT(column(table, "time").values, ElementsAre(0));
  EXPECT_EQ(column(table, "time").origin, 1'700'000'000'250'000'000);
  EXPECT_THAT(table.description, HasSubstr("time from the recorder"));
}

TEST(Ros2Bag, ASimulationMayBeginAtZero) {
  const TestFolder folder;
  BagFile bag(folder / "bag.db3");
  bag.topic(1, "/tool", "geometry_msgs/msg/PointStamped");
  bag.message(1, 1'700'000'000'000'000'000, point(0, 0, 0.1));
  bag.message(1, 1'700'000'001'000'000'000, point(1, 0, 0.2));
  EXPECT_THAT(column(read_ros2_bag(folder / "bag.db3"), "time").values, ElementsAre(0, 1e9));
}

/// A receiver may see an older message later.
TEST(Ros2Bag, RowsAreInTheOrderOfTheirStamps) {
  const TestFolder folder;
  BagFile bag(folder / "bag.db3");
  bag.topic(1, "/tool", "geometry_msgs/msg/PointStamped");
  bag.message(1, 1000, point(3, 1, 0.3));
  bag.message(1, 2000, point(2, 999'999'999, 0.2));
  bag.message(1, 3000, point(3, 2, 0.4));
  const SampleTable table = read_ros2_bag(folder / "bag.db3");
  EXPECT_THAT(column(table, "time").values, ElementsAre(0, 2, 3));
  EXPECT_THAT(column(table, "x").values, ElementsAre(0.2, 0.3, 0.4));
}

/// The position from one topic, the force from another of the same bag, by their stamps to the nanosecond.
TEST(Ros2Bag, TwoTopicsOfOneBagAreMerged) {
  const TestFolder folder;
  BagFile bag(folder / "bag.db3");
  bag.topic(1, "/tool", "geometry_msgs/msg/PointStamped");
  bag.topic(2, "/force", "geometry_msgs/msg/WrenchStamped");
  for (int i = 0; i <= 8; ++i) bag.message(1, 1000 + i, point(i, 0, 0.1 * i));
  bag.message(2, 1500, wrench(5.0));  // at 7 s
  TableSettings settings;
  settings.part = "/tool";
  settings.merge = "bag.db3";
  settings.merge_part = "/force";
  settings.force_sign = ForceSign::on_device;
  const Stroke stroke = import_stroke(folder / "bag.db3", settings).stroke;
  ASSERT_EQ(stroke.size(), 1u);  // that the force covers
  EXPECT_EQ(stroke.position[0], Eigen::Vector3d(0.1 * 7, 2.0, 3.0));
  EXPECT_EQ(stroke.force[0], Eigen::Vector3d(5.0, 0.0, 0.0));
}

TEST(Ros2Bag, TheFileIsLeftAsItIs) {
  const TestFolder folder;
  {
    BagFile bag(folder / "bag.db3"), fill_it(folder / "other.db3");
    fill(bag);
  }
  std::filesystem::remove(folder / "other.db3");
  std::filesystem::permissions(folder / "bag.db3", std::filesystem::perms::owner_read);
  const auto time = std::filesystem::last_write_time(folder / "bag.db3");
  read_ros2_bag(folder / "bag.db3");
  EXPECT_EQ(std::filesystem::last_write_time(folder / "bag.db3"), time);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(Ros2Bag, SaysWhatIsWrong) {
  const TestFolder folder;
  int count = 0;
  const auto complaint = [&](const auto& make) {
    const std::filesystem::path path = folder / fmt::format("{}.db3", ++count);
    {
      BagFile bag(path);
      make(bag);
    }
    return complaint_of([&] { read_ros2_bag(path); });
  };
  EXPECT_THAT(complaint([](BagFile& bag) { bag.run("DROP TABLE messages"); }),
              HasSubstr("without ROS messages"));
  EXPECT_THAT(complaint([](BagFile&) {}), HasSubstr("the ROS 2 bag has: none"));
  EXPECT_THAT(complaint([](BagFile& bag) { bag.topic(1, "/camera", "sensor_msgs/msg/Image"); }),
              HasSubstr("the ROS 2 bag has: /camera (sensor_msgs/msg/Image, 0 messages)"));
  EXPECT_THAT(complaint([](BagFile& bag) {
                fill(bag);
                bag.message(4, 0, "short");
              }),
              HasSubstr("message 1 of /tool"));
  EXPECT_THAT(complaint([](BagFile& bag) {
                fill(bag);
                bag.message(4, 9000, "\x28\xB5\x2F\xFD...");
              }),
              AllOf(HasSubstr("message 3"), HasSubstr("compressed")));
  // Things that a stranger may put in place of a table.
  EXPECT_THAT(complaint([](BagFile& bag) {
                bag.run(
                    "DROP TABLE messages; CREATE VIEW messages AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL "
                    "SELECT i + "
                    "1 FROM n) SELECT i AS topic_id, i AS timestamp, zeroblob(100) AS data FROM n");
              }),
              HasSubstr("without ROS messages"));
  put_text(folder / "half.db3", std::string("SQLite format 3\0", 16) + std::string(200, 'x'));
  EXPECT_THAT(complaint_of([&] { read_ros2_bag(folder / "half.db3"); }), Not(""));
  {
    BagFile bag(folder / "open.db3");
    fill(bag);
  }
  put_text(folder / "open.db3-wal", "not yet in the bag");
  EXPECT_THAT(complaint_of([&] { read_ros2_bag(folder / "open.db3"); }), HasSubstr("was not closed"));
}

}  // namespace
}  // namespace sandstroke
