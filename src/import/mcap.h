#pragma once

#include <filesystem>
#include <string>

#include "import/sample_table.h"

namespace sandstroke {

inline constexpr const char* mcap_magic = "\x89MCAP0\r\n";

/// Reads one topic of an MCAP file (mcap.dev/spec), as ros_samples(): messages in CDR (ROS 2) or in the bytes
/// of ROS 1; chunks packed by lz4, zstd or not at all; with or without a summary. Error: io; input, listing
/// the topics, or naming the byte at which the file is damaged.
SampleTable read_mcap(const std::filesystem::path& path, const std::string& part = "");

}  // namespace sandstroke
