#pragma once

#include <filesystem>
#include <optional>

#include "haptics/recording.h"

namespace sandstroke {

/// What a stroke file says of how it was recorded.
struct RecordingInfo {
  RecordingHeader header;
  RecordingFooter footer;
  bool complete() const { return is_complete(footer.reason); }
};

/// Writes a recording as a stroke file (read_stroke_file takes it) by way of PATH.part, and gives back what
/// it says. Beside the stroke's columns there are `sequence`, `monotonic_time` [ns] and `flags`; beside its
/// attributes those of recording_fields.h, `clock` and `clock_start` [ns], the first sample's; each column
/// has a `description` and, where it has a unit, `units`. Counts of recorded ticks are those of the samples
/// that are there; without a footer all are made from them. Error: io; input, where there is no sample.
RecordingInfo write_recording_file(const std::filesystem::path& path, Recording& recording);

/// None where no recorder made the stroke. Error: io, input.
std::optional<RecordingInfo> read_recording_info(const std::filesystem::path& path);

}  // namespace sandstroke
