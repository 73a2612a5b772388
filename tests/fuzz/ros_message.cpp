// A message of a ROS 2 bag (CDR): which type, and its bytes.
#include "import/ros_message.h"

#include <string>

#include "fuzz.h"

using namespace sandstroke;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view bytes = as_text(data, size);
  const std::string type = "geometry_msgs/msg/" + std::string(take_line(bytes));
  const std::size_t numbers = ros_message_columns(type).size();
  const std::optional<RosMessage> message = ros_message(type, bytes);
  require(!message || (message->values.size() == numbers && numbers > 0));
  return 0;
}
