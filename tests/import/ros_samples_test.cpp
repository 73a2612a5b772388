#include "import/ros_samples.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "cdr_writer.h"
#include "complaint.h"

namespace sandstroke {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr std::int64_t first_stamp = 1'700'000'000'123'456'789;  // ns, as recorders count

/// A recording in memory.
class Recording : public RosRecording {
 public:
  const char* kind() const override { return "recording"; }
  const std::string& name() const override { return name_; }
  std::vector<RosTopic> topics() override { return topics_; }
  void read(const std::set<std::int64_t>& ids, const Take& take) override {
    for (const std::int64_t id : ids)
      for (const auto& [recorded, bytes] : messages_[id]) take(recorded, bytes);
  }
  std::string place() const override { return "a message"; }

  void topic(std::int64_t id, const std::string& name, const std::string& type,
             const std::string& encoding = "cdr") {
    topics_.push_back({name, type, encoding, 0, {id}});
  }
  void message(std::int64_t id, std::int64_t recorded, const std::string& bytes) {
    messages_[id].emplace_back(recorded, bytes);
    for (RosTopic& topic : topics_) topic.messages += topic.ids.contains(id);
  }
  std::vector<RosTopic> topics_;

 private:
  std::string name_ = "memory";
  std::map<std::int64_t, std::vector<std::pair<std::int64_t, std::string>>> messages_;
};

CdrWriter stamped(std::int64_t stamp, const std::string& frame) {
  CdrWriter writer;
  return writer.header(static_cast<std::int32_t>(stamp / 1'000'000'000),
                       static_cast<std::uint32_t>(stamp % 1'000'000'000), frame);
}
std::string stamped_point(std::int64_t stamp, double x, const std::string& frame = "base") {
  return stamped(stamp, frame).numbers({x, 2.0, 3.0}).bytes();
}
std::string stamped_pose(std::int64_t stamp, const std::vector<double>& orientation) {
  return stamped(stamp, "base").numbers({1.0, 2.0, 3.0}).numbers(orientation).bytes();
}
std::string stamped_transform(std::int64_t stamp, const std::string& child, double x) {
  return stamped(stamp, "base").text(child).numbers({x, 0, 0, 0, 0, 0, 1}).bytes();
}

/// Points of /tool, one per second, that were recorded 1 ms after their stamps.
Recording some_points(int count = 3) {
  Recording recording;
  recording.topic(1, "/tool", "geometry_msgs/msg/PointStamped");
  for (int i = 0; i < count; ++i) {
    const std::int64_t stamp = first_stamp + i * 1'000'000'000LL;
    recording.message(1, stamp + 1'000'000, stamped_point(stamp, i));
  }
  return recording;
}

TEST(RosSamples, TimesAreExactToTheNanosecond) {
  Recording recording = some_points();
  const SampleTable table = ros_samples(recording, "");
  EXPECT_EQ(column(table, "time").origin, first_stamp);
  EXPECT_THAT(column(table, "time").values, ElementsAre(0, 1e9, 2e9));
  EXPECT_EQ(column(table, "recorded").origin, first_stamp + 1'000'000);
  EXPECT_THAT(column(table, "x").values, ElementsAre(0, 1, 2));
  EXPECT_THAT(table.warnings, ElementsAre());
  EXPECT_THAT(table.description,
              HasSubstr("3 messages of /tool (geometry_msgs/msg/PointStamped) in frame base"));
}

/// Two programs that send to one topic: messages are in the order of their times.
TEST(RosSamples, IdsOfOneTopicAreJoined) {
  Recording recording = some_points(2);
  recording.topic(7, "/tool", "geometry_msgs/msg/PointStamped");
  recording.message(7, first_stamp + 500'000'000, stamped_point(first_stamp + 500'000'000, 0.5));
  EXPECT_THAT(column(ros_samples(recording, "/tool"), "x").values, ElementsAre(0, 0.5, 1));
}

/// Messages with equal stamps stay in the order in which they were recorded.
TEST(RosSamples, EqualStampsAreOrderedByTheRecorder) {
  Recording recording;
  recording.topic(1, "/tool", "geometry_msgs/msg/PointStamped");
  recording.message(1, 2000, stamped_point(5, 0.2));
  recording.message(1, 1000, stamped_point(5, 0.1));
  EXPECT_THAT(column(ros_samples(recording, ""), "x").values, ElementsAre(0.1, 0.2));
}

TEST(RosSamples, AFrameOfSeveralIsNamed) {
  Recording recording;
  recording.topic(1, "/tf", "tf2_msgs/msg/TFMessage");
  CdrWriter both;
  both.integer(2);
  both.header(5, 0, "base").text("tool").numbers({1, 0, 0, 0, 0, 0, 1});
  both.header(5, 0, "base").text("camera").numbers({2, 0, 0, 0, 0, 0, 1});
  CdrWriter one;
  one.integer(1).header(6, 0, "base").text("tool").numbers({3, 0, 0, 0, 0, 0, 1});
  recording.message(1, 5'000'000'000, both.bytes());
  recording.message(1, 6'000'000'000, one.bytes());
  for (const char* part : {"", "/tf"})
    EXPECT_THAT(
        complaint_of([&] { ros_samples(recording, part); }),
        HasSubstr("--part): /tf:camera (tf2_msgs/msg/TFMessage, 1 messages, in base), /tf:tool (tf2_msgs/"
                  "msg/TFMessage, 2 messages, in base)"));
  EXPECT_THAT(complaint_of([&] { ros_samples(recording, "/tf:hand"); }),
              AllOf(HasSubstr("'/tf:hand' cannot be read"), HasSubstr("/tf:tool")));
  const SampleTable table = ros_samples(recording, "/tf:tool");
  EXPECT_THAT(column(table, "x").values, ElementsAre(1, 3));
  EXPECT_THAT(column(table, "time").values, ElementsAre(0, 1e9));
  EXPECT_THAT(table.description, HasSubstr("frame tool in frame base"));
  EXPECT_THAT(table.warnings, ElementsAre());
}

TEST(RosSamples, TheOnlyFrameNeedsNoName) {
  Recording recording;
  recording.topic(1, "/hand", "geometry_msgs/msg/TransformStamped");
  recording.message(1, 5, stamped_transform(5, "hand", 1.0));
  for (const char* part : {"", "/hand", "/hand:hand"})
    EXPECT_EQ(ros_samples(recording, part).size(), 1u) << part;
  recording.message(1, 6, stamped_transform(6, "glove", 1.0));
  EXPECT_THAT(complaint_of([&] { ros_samples(recording, ""); }), HasSubstr("/hand:glove"));
}

TEST(RosSamples, OdometryLeavesOutItsVelocity) {
  Recording recording;
  recording.topic(1, "/odom", "nav_msgs/msg/Odometry");
  CdrWriter writer = stamped(5, "odom").text("base_link");
  writer.numbers({1, 2, 3, 0, 0, 0, 1}).numbers(std::vector<double>(78, 9.0));
  recording.message(1, 5, writer.bytes());
  const SampleTable table = ros_samples(recording, "");
  EXPECT_EQ(table.columns.size(), 9u);  // time, 3 of position, 4 of orientation, recorded
  EXPECT_THAT(table.description, HasSubstr("velocity left out because it is in the frame that moves"));
}

TEST(RosSamples, OrientationsOfZerosAreLeftOut) {
  Recording recording;
  recording.topic(1, "/tool", "geometry_msgs/msg/PoseStamped");
  recording.message(1, 5, stamped_pose(5, {0, 0, 0, 0}));
  EXPECT_THAT(ros_samples(recording, "").description, HasSubstr("orientation left out"));
  EXPECT_EQ(ros_samples(recording, "").columns.size(), 5u);
  recording.message(1, 6, stamped_pose(6, {0, 0, 0, 1}));
  EXPECT_EQ(ros_samples(recording, "").columns.size(), 9u);
}

TEST(RosSamples, NumbersThatAreNotFiniteAreNan) {
  Recording recording = some_points(2);
  recording.message(1, first_stamp + 2'000'000'000,
                    stamped_point(first_stamp + 2'000'000'000, std::numeric_limits<double>::infinity()));
  const SampleTable table = ros_samples(recording, "");
  EXPECT_EQ(table.size(), 3u);
  EXPECT_TRUE(std::isnan(column(table, "x").values[2]));
  EXPECT_EQ(column(table, "y").values[2], 2.0);
  EXPECT_THAT(table.description, HasSubstr("1 with numbers that are not finite"));
  Recording none;
  none.topic(1, "/tool", "geometry_msgs/msg/Point");
  none.message(1, 5, CdrWriter().numbers({std::nan(""), 0, 0}).bytes());
  EXPECT_THAT(complaint_of([&] { ros_samples(none, ""); }),
              HasSubstr("no message of /tool has finite numbers"));
}

/// Each warning names both things that disagree.
TEST(RosSamples, WarnsOfWhatDisagrees) {
  const auto warning = [](const auto& change) {
    Recording recording = some_points();
    change(recording);
    const SampleTable table = ros_samples(recording, "");
    return table.warnings.size() == 1 ? table.warnings[0] : fmt::format("{} warnings", table.warnings.size());
  };
  EXPECT_THAT(warning([](Recording& recording) {
                recording.message(1, first_stamp + 2'000'000'000,
                                  stamped_point(first_stamp + 2'000'000'000, 0.0, "map"));
              }),
              AllOf(HasSubstr("'base'"), HasSubstr("'map'")));
  EXPECT_THAT(warning([](Recording& recording) {
                recording.message(1, first_stamp + 3'000'000'000,
                                  stamped_point(first_stamp + 13'000'000'000, 0.0));
              }),
              AllOf(HasSubstr("span 13.000 s"), HasSubstr("recorder's times 2.999 s"), HasSubstr("--time")));
  EXPECT_THAT(warning([](Recording& recording) { recording.topics_[0].messages = 4; }),
              AllOf(HasSubstr("has 3 messages"), HasSubstr("counts 4")));
  Recording simulated;
  simulated.topic(1, "/tool", "geometry_msgs/msg/PointStamped");
  simulated.message(1, first_stamp, stamped_point(1, 0.0));
  EXPECT_THAT(ros_samples(simulated, "").warnings,
              ElementsAre(HasSubstr("begin 1700000000.123 s before the recorder's times")));
}

TEST(RosSamples, NamesWhatCannotBeRead) {
  Recording recording;
  recording.topic(1, "/joints", "sensor_msgs/msg/JointState");
  recording.message(1, 5, "...");
  recording.topic(2, "/pose", "foxglove.PoseInFrame", "protobuf");
  recording.message(2, 5, "...");
  recording.topic(3, "/json", "", "json");
  const std::string complaint = complaint_of([&] { ros_samples(recording, ""); });
  EXPECT_THAT(complaint, AllOf(HasSubstr("/joints (sensor_msgs/msg/JointState, 1 messages)"),
                               HasSubstr("/pose (foxglove.PoseInFrame in protobuf, 1 messages)"),
                               HasSubstr("/json (no type in json, 0 messages)"), HasSubstr("PoseStamped"),
                               HasSubstr("Odometry"), HasSubstr("TFMessage")));
  recording.topic(4, "/tool", "geometry_msgs/msg/PointStamped");
  recording.message(4, 5, stamped_point(5, 0.0));
  EXPECT_THAT(
      complaint_of([&] { ros_samples(recording, "/joints"); }),
      AllOf(HasSubstr("'/joints' cannot be read"), HasSubstr("--part): /tool"), Not(HasSubstr("/pose"))));
  EXPECT_EQ(ros_samples(recording, "").size(), 1u);
  recording.message(4, 6, "\x28\xB5\x2F\xFD...");
  EXPECT_THAT(complaint_of([&] { ros_samples(recording, "/tool"); }),
              AllOf(HasSubstr("a message of /tool"), HasSubstr("compressed")));
}

}  // namespace
}  // namespace sandstroke
