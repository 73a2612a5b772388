#pragma once

#include <filesystem>
#include <string>

#include "import/sample_table.h"

namespace sandstroke {

/// One topic of a ROS 2 bag (.db3, SQLite): position, orientation, force and torque of ros_message_columns(),
/// and time in s since 1970 (or the simulation's begin) by the messages' headers; by the bag's own stamps
/// where they have none. Messages in which a number is not finite are left out. The file is not changed, nor
/// are files made beside it. `topic` may be empty where only one can be read. Error: io; input, listing the
/// topics.
SampleTable read_ros2_bag(const std::filesystem::path& path, const std::string& topic = "");

}  // namespace sandstroke
