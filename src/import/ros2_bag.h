#pragma once

#include <filesystem>
#include <string>

#include "import/sample_table.h"

namespace sandstroke {

/// Reads one topic of a ROS 2 bag (.db3, SQLite), as ros_samples(). The file is not changed, and no files are
/// made beside it. Error: io; input, listing the topics.
SampleTable read_ros2_bag(const std::filesystem::path& path, const std::string& part = "");

}  // namespace sandstroke
