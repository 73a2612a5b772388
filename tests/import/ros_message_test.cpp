#include "import/ros_message.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include "cdr_writer.h"
#include "import/cdr.h"

namespace sandstroke {
namespace {

using testing::ElementsAre;

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
