#include "import/ros_message.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include "cdr_writer.h"

namespace sandstroke {
namespace {

using testing::ElementsAre;

/// The only message in these bytes.
std::optional<RosMessage> ros_message(std::string_view type, std::string_view bytes,
                                      RosEncoding encoding = RosEncoding::cdr) {
  const auto messages = ros_messages(type, bytes, encoding);
  if (!messages || messages->size() != 1) return {};
  return messages->front();
}

constexpr const char* pose = "geometry_msgs/msg/PoseStamped";

std::string pose_message(CdrWriter writer, const std::string& frame) {
  writer.header(-1, 999'999'999, frame);
  for (const double value : {0.1, -0.2, 0.3, 0.0, 0.6, 0.0, 0.8}) writer.number(value);
  return writer.bytes();
}

/// Frames of any length: numbers are aligned after each.
TEST(RosMessage, APoseInAnyByteOrderAndVersion) {
  for (const bool little_endian : {false, true})
    for (const int version : {1, 2})
      for (const char* frame : {"", "a", "ab", "abc", "base", "base_", "base_li", "base_link"}) {
        const auto message = ros_message(pose, pose_message(CdrWriter(little_endian, version), frame));
        ASSERT_TRUE(message);
        EXPECT_EQ(message->stamp, -1);
        EXPECT_THAT(message->values, ElementsAre(0.1, -0.2, 0.3, 0.0, 0.6, 0.0, 0.8));
      }
}

TEST(RosMessage, APoseOfRos1) {
  const auto message = ros_message("geometry_msgs/PoseStamped",
                                   CdrWriter(true, 0)
                                       .header(-1, 5, "base")  // seconds have no sign: a time in 2106
                                       .numbers({0.1, -0.2, 0.3, 0.0, 0.6, 0.0, 0.8})
                                       .bytes(),
                                   RosEncoding::ros1);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->stamp, 4'294'967'295'000'000'005);
  EXPECT_EQ(message->frame, "base");
  EXPECT_THAT(message->values, ElementsAre(0.1, -0.2, 0.3, 0.0, 0.6, 0.0, 0.8));
  const std::string bytes = CdrWriter(true, 0).numbers({1.0, 2.0, 3.0}).bytes();
  EXPECT_TRUE(ros_message("geometry_msgs/Point", bytes, RosEncoding::ros1));
  EXPECT_FALSE(ros_message("geometry_msgs/Point", bytes + "more", RosEncoding::ros1));
}

/// A pose, then its covariance; then a velocity and its covariance, which are not read.
TEST(RosMessage, PosesWithCovarianceAndOdometry) {
  const std::vector<double> values{1.0, 2.0, 3.0, 0.0, 0.0, 0.6, 0.8}, covariance(36, 9.0), velocity(6, 7.0);
  for (const int version : {0, 1, 2}) {
    const RosEncoding encoding = version == 0 ? RosEncoding::ros1 : RosEncoding::cdr;
    CdrWriter writer(true, version);
    writer.header(2, 5, "map").numbers(values).numbers(covariance);
    const auto posed = ros_message("geometry_msgs/msg/PoseWithCovarianceStamped", writer.bytes(), encoding);
    ASSERT_TRUE(posed);
    EXPECT_EQ(posed->values, values);

    CdrWriter odometry(true, version);
    odometry.header(2, 5, "odom").text("base_link").numbers(values).numbers(covariance).numbers(velocity);
    EXPECT_FALSE(ros_message("nav_msgs/msg/Odometry", odometry.bytes(), encoding));  // cut off
    odometry.numbers(covariance);
    const auto moved = ros_message("nav_msgs/msg/Odometry", odometry.bytes(), encoding);
    ASSERT_TRUE(moved);
    EXPECT_EQ(moved->values, values);
    EXPECT_EQ(moved->frame, "odom");
    EXPECT_EQ(moved->child, "base_link");
  }
  EXPECT_TRUE(ros_type_has_velocity("nav_msgs/Odometry"));
  EXPECT_TRUE(ros_type_names_child("nav_msgs/Odometry"));
  EXPECT_FALSE(ros_type_names_child(pose));
}

TEST(RosMessage, AListOfTransforms) {
  for (const int version : {0, 1, 2}) {
    const RosEncoding encoding = version == 0 ? RosEncoding::ros1 : RosEncoding::cdr;
    CdrWriter writer(true, version);
    if (version == 2) writer.integer(1000);  // the list's size in bytes
    writer.integer(2);
    writer.header(1, 0, "base").text("tool").numbers({1, 2, 3, 0, 0, 0, 1});
    writer.header(2, 0, "map").text("a").numbers({4, 5, 6, 0, 0, 1, 0});
    const auto messages = ros_messages("tf2_msgs/msg/TFMessage", writer.bytes(), encoding);
    ASSERT_TRUE(messages);
    ASSERT_EQ(messages->size(), 2u);
    EXPECT_EQ((*messages)[0].child, "tool");
    EXPECT_EQ((*messages)[1].frame, "map");
    EXPECT_EQ((*messages)[1].stamp, 2'000'000'000);
    EXPECT_THAT((*messages)[1].values, ElementsAre(4, 5, 6, 0, 0, 1, 0));
    std::string many = writer.bytes();
    many.replace(version == 0 ? 0 : version == 1 ? 4 : 8, 4, "\xFF\xFF\xFF\xFF");
    EXPECT_FALSE(ros_messages("tf2_msgs/msg/TFMessage", many, encoding));
  }
}

TEST(RosMessage, ATransformHasTwoFramesAndAWrenchForceFirst) {
  CdrWriter transform, wrench;
  transform.header(2, 5, "base").text("tool0");
  for (const double value : {1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0}) transform.number(value);
  const auto moved = ros_message("geometry_msgs/msg/TransformStamped", transform.bytes());
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->stamp, 2'000'000'005);
  EXPECT_THAT(moved->values, ElementsAre(1, 2, 3, 0, 0, 0, 1));

  for (const double value : {4.0, 5.0, 6.0, 7.0, 8.0, 9.0}) wrench.number(value);
  const auto felt = ros_message("geometry_msgs/msg/Wrench", wrench.bytes());
  ASSERT_TRUE(felt);
  EXPECT_THAT(felt->values, ElementsAre(4, 5, 6, 7, 8, 9));
  std::vector<std::string> names;
  for (const SampleColumn& one : ros_message_columns("geometry_msgs/msg/WrenchStamped"))
    names.push_back(one.name);
  EXPECT_THAT(names, ElementsAre("fx", "fy", "fz", "tx", "ty", "tz"));
}

TEST(RosMessage, OneThatIsCutOffIsNone) {
  const std::string whole = pose_message(CdrWriter(), "base_link");
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(ros_message(pose, whole.substr(0, size))) << size;
  EXPECT_TRUE(ros_message(pose, whole + "more"));
}

TEST(RosMessage, OneWithAFrameBeyondItsEndIsNone) {
  CdrWriter writer;
  writer.integer(0).integer(0).integer(0xFFFFFFFF);
  for (int i = 0; i < 7; ++i) writer.number(0.0);
  EXPECT_FALSE(ros_message(pose, writer.bytes()));
}

TEST(RosMessage, OtherEncodingsAndTypesAreNone) {
  std::string parameters = pose_message(CdrWriter(), "base");
  parameters[1] = 2;  // a list of parameters
  EXPECT_FALSE(ros_message(pose, parameters));
  EXPECT_FALSE(ros_message("sensor_msgs/msg/Image", pose_message(CdrWriter(), "base")));
  EXPECT_TRUE(ros_message_columns("sensor_msgs/msg/Image").empty());
}

}  // namespace
}  // namespace sandstroke
