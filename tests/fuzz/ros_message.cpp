// A message of ROS: its encoding and type, and its bytes.
#include "import/ros_message.h"

#include "fuzz.h"

using namespace sandstroke;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view bytes = as_text(data, size);
  std::string_view name = take_line(bytes);
  const bool ros1 = name.starts_with("1 ");
  if (ros1) name.remove_prefix(2);
  const std::string type =
      name.find('/') == std::string_view::npos ? "geometry_msgs/msg/" + std::string(name) : std::string(name);
  const std::size_t numbers = ros_message_columns(type).size();
  const auto messages = ros_messages(type, bytes, ros1 ? RosEncoding::ros1 : RosEncoding::cdr);
  require(!messages || numbers > 0);
  if (!messages) return 0;
  for (const RosMessage& message : *messages) require(message.values.size() == numbers);
  return 0;
}
