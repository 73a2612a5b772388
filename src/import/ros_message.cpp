#include "import/ros_message.h"

#include <algorithm>
#include <array>

#include "import/cdr.h"

namespace sandstroke {
namespace {

/// The fields of a message type, in order (geometry_msgs of ROS 2). h: header, s: string; vectors: p
/// position, q orientation, f force, t torque.
struct RosType {
  std::string_view name, fields;
};

constexpr std::array<RosType, 8> ros_types{{
    {"geometry_msgs/msg/PoseStamped", "hpq"},
    {"geometry_msgs/msg/PointStamped", "hp"},
    {"geometry_msgs/msg/TransformStamped", "hspq"},
    {"geometry_msgs/msg/WrenchStamped", "hft"},
    {"geometry_msgs/msg/Pose", "pq"},
    {"geometry_msgs/msg/Point", "p"},
    {"geometry_msgs/msg/Transform", "pq"},
    {"geometry_msgs/msg/Wrench", "ft"},
}};

std::string_view fields_of(std::string_view type) {
  for (const RosType& known : ros_types)
    if (known.name == type) return known.fields;
  return {};
}

std::vector<SampleColumn> columns_of(char field) {
  switch (field) {
    case 'p':
      return {{"x", "m", {}}, {"y", "m", {}}, {"z", "m", {}}};
    case 'q':
      return {{"qx", "", {}}, {"qy", "", {}}, {"qz", "", {}}, {"qw", "", {}}};
    case 'f':
      return {{"fx", "N", {}}, {"fy", "N", {}}, {"fz", "N", {}}};
    case 't':
      return {{"tx", "N m", {}}, {"ty", "N m", {}}, {"tz", "N m", {}}};
    default:
      return {};
  }
}

}  // namespace

std::vector<SampleColumn> ros_message_columns(std::string_view type) {
  std::vector<SampleColumn> columns;
  for (const char field : fields_of(type))
    for (SampleColumn& column : columns_of(field)) columns.push_back(std::move(column));
  return columns;
}

std::optional<RosMessage> ros_message(std::string_view type, std::string_view bytes) {
  CdrReader reader(bytes);
  RosMessage message;
  for (const char field : fields_of(type)) {
    if (field == 'h') {
      const auto seconds = static_cast<std::int32_t>(reader.integer());
      message.stamp = std::int64_t{1'000'000'000} * seconds + reader.integer();
    }
    if (field == 'h' || field == 's') reader.pass_text();
    const std::size_t numbers = columns_of(field).size();
    for (std::size_t i = 0; i < numbers; ++i) message.values.push_back(reader.number());
  }
  if (!reader.sound() || message.values.empty()) return {};
  return message;
}

}  // namespace sandstroke
