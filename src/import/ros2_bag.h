#pragma once

#include <filesystem>
#include <string>

#include "import/sample_table.h"

namespace sandstroke {

/// Reads one topic of a ROS 2 bag (.db3, SQLite): position, orientation, force and torque of
/// ros_message_columns(), and time in ns since the first stamp. The stamps are those of the messages'
/// headers, or the bag's own if they have none. They count from 1970 or from the simulation's beginning.
/// Messages with a number that is not finite are left out. The file is not changed, and no files are made
/// beside it. `topic` may be empty if only one can be read. Error: io; input, listing the topics.
SampleTable read_ros2_bag(const std::filesystem::path& path, const std::string& topic = "");

}  // namespace sandstroke
