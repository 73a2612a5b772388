#pragma once

#include <filesystem>
#include <optional>

#include "haptics/recording.h"

namespace sandstroke {

/// How a stroke file was recorded.
struct RecordingInfo {
  RecordingHeader header;
  RecordingFooter footer;
  bool complete() const { return is_complete(footer.reason); }
};

/// Writes a recording as a stroke file (for read_stroke_file()) by way of PATH.part, and returns its header
/// and footer. It adds the columns `sequence`, `monotonic_time` [ns] and `flags` to the stroke's, and to its
/// attributes those of recording_fields.h, `clock` and `clock_start` [ns], the first sample's. Each column
/// has a `long_name` and, if it has a unit, `units`. Counts of recorded ticks are those of the samples there
/// are; without a footer all counts are made from them. Error: io; input, if there is no sample.
RecordingInfo write_recording_file(const std::filesystem::path& path, Recording& recording);

/// None if no recorder made the stroke. Error: io, input.
std::optional<RecordingInfo> read_recording_info(const std::filesystem::path& path);

}  // namespace sandstroke
