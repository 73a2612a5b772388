#include "import/ros_message.h"

#include <spdlog/fmt/fmt.h>

#include <array>

namespace sandstroke {
namespace {

/// The fields of a message type, in order. h: header, c: the frame that moves (a string); vectors: p
/// position, q orientation, f force, t torque; without columns: C covariance, v velocity. A * before them: a
/// list of such messages.
struct RosType {
  std::string_view name, fields;
};

constexpr std::array<RosType, 13> ros_types{{
    {"geometry_msgs/PoseStamped", "hpq"},
    {"geometry_msgs/PoseWithCovarianceStamped", "hpqC"},
    {"geometry_msgs/PointStamped", "hp"},
    {"geometry_msgs/TransformStamped", "hcpq"},
    {"geometry_msgs/WrenchStamped", "hft"},
    {"geometry_msgs/Pose", "pq"},
    {"geometry_msgs/PoseWithCovariance", "pqC"},
    {"geometry_msgs/Point", "p"},
    {"geometry_msgs/Transform", "pq"},
    {"geometry_msgs/Wrench", "ft"},
    {"nav_msgs/Odometry", "hcpqCvC"},
    {"tf2_msgs/TFMessage", "*hcpq"},
    {"tf/tfMessage", "*hcpq"},  // of ROS 1, before tf2
}};

std::string_view fields_of(std::string_view type) {
  std::string name(type);
  if (const auto at = name.find("/msg/"); at != std::string::npos) name.erase(at, 4);
  for (const RosType& known : ros_types)
    if (known.name == name) return known.fields;
  return {};
}

/// The numbers of a field, and their columns; those without names are not kept.
struct RosField {
  char field;
  int numbers;
  std::array<const char*, 4> names;
  const char* unit;
};

constexpr std::array<RosField, 6> ros_fields{{
    {'p', 3, {"x", "y", "z"}, "m"},
    {'q', 4, {"qx", "qy", "qz", "qw"}, ""},
    {'f', 3, {"fx", "fy", "fz"}, "N"},
    {'t', 3, {"tx", "ty", "tz"}, "N m"},
    {'v', 6, {}, ""},
    {'C', 36, {}, ""},
}};

RosMessage read_one(std::string_view fields, RosReader& reader, RosEncoding encoding) {
  RosMessage message;
  for (const char field : fields) {
    if (field == 'h') {
      if (encoding == RosEncoding::ros1) reader.integer();  // a running number
      message.stamp = reader.stamp();
      message.frame = reader.text();
    }
    if (field == 'c') message.child = reader.text();
    for (const RosField& known : ros_fields)
      for (int i = 0; known.field == field && i < known.numbers; ++i)
        if (const double number = reader.number(); known.names[0]) message.values.push_back(number);
  }
  return message;
}

}  // namespace

std::vector<SampleColumn> ros_message_columns(std::string_view type) {
  std::vector<SampleColumn> columns;
  for (const char field : fields_of(type))
    for (const RosField& known : ros_fields)
      for (const char* name : known.names)
        if (known.field == field && name) columns.push_back({name, known.unit, {}});
  return columns;
}

bool ros_type_names_child(std::string_view type) {
  return fields_of(type).find('c') != std::string_view::npos;
}

bool ros_type_has_velocity(std::string_view type) {
  return fields_of(type).find('v') != std::string_view::npos;
}

std::string ros_types_read() {
  std::vector<std::string_view> names;
  for (const RosType& type : ros_types) names.push_back(type.name.substr(type.name.find('/') + 1));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::optional<std::vector<RosMessage>> ros_messages(std::string_view type, std::string_view bytes,
                                                    RosEncoding encoding) {
  std::string_view fields = fields_of(type);
  if (fields.empty()) return {};
  RosReader reader(bytes, encoding);
  std::uint32_t count = 1;
  if (fields.starts_with('*')) {
    count = reader.count_of_messages();
    fields.remove_prefix(1);
  }
  std::vector<RosMessage> messages;
  for (std::uint32_t i = 0; i < count && reader.sound(); ++i)
    messages.push_back(read_one(fields, reader, encoding));
  const bool whole = encoding == RosEncoding::cdr || reader.at_end();  // CDR may be padded
  if (!reader.sound() || !whole) return {};
  return messages;
}

}  // namespace sandstroke
