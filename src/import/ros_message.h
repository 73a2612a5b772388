#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "import/sample_table.h"

namespace sandstroke {

/// The content of a message about a hand or a tool.
struct RosMessage {
  std::int64_t stamp = 0;      ///< ns, from its header; 0 without one
  std::vector<double> values;  ///< one for each of ros_message_columns()
};

/// The columns of a type of message, without values: geometry_msgs' Point, Pose, Transform and Wrench, with
/// or without a header. Empty for any other type.
std::vector<SampleColumn> ros_message_columns(std::string_view type);

/// A message from its bytes (CDR). None if they do not fit the type.
std::optional<RosMessage> ros_message(std::string_view type, std::string_view bytes);

}  // namespace sandstroke
