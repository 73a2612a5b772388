#pragma once

#include <filesystem>
#include <string>

#include "import/sample_table.h"

namespace sandstroke {

inline constexpr const char* ros1_bag_magic = "#ROSBAG V2.0\n";

/// Reads one topic of a bag of ROS 1 (.bag, format 2.0: wiki.ros.org/Bags/Format/2.0), as ros_samples();
/// chunks packed by bz2, lz4 or not at all. Error: io; input, listing the topics, or naming the byte at which
/// the file is damaged.
SampleTable read_ros1_bag(const std::filesystem::path& path, const std::string& part = "");

}  // namespace sandstroke
