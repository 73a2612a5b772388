#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "import/ros_bytes.h"
#include "import/sample_table.h"

namespace sandstroke {

/// The content of a message about a hand or a tool.
struct RosMessage {
  std::int64_t stamp = 0;      ///< ns, from its header; 0 without one
  std::string frame;           ///< in which it is, from its header; empty without one
  std::string child;           ///< the frame that moves in it, if the type names one
  std::vector<double> values;  ///< one for each of ros_message_columns()
};

/// The columns of a type of message, without values; empty if messages of the type are not read. Types are
/// named as in ROS 2 ("geometry_msgs/msg/Pose") or ROS 1 ("geometry_msgs/Pose").
std::vector<SampleColumn> ros_message_columns(std::string_view type);

/// True if each message of the type names the frame that moves: messages of one topic may be about several.
bool ros_type_names_child(std::string_view type);

/// True if messages of the type also have a velocity, which is not read: it is in the frame that moves.
bool ros_type_has_velocity(std::string_view type);

/// The types that are read, for people.
std::string ros_types_read();

/// A message from its bytes; those in it, if it is a list of transforms. None if they do not fit the type.
std::optional<std::vector<RosMessage>> ros_messages(std::string_view type, std::string_view bytes,
                                                    RosEncoding encoding);

}  // namespace sandstroke
