#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "haptics/recording.h"

namespace sandstroke {

/// Gives the next samples, in order; none at the end.
using NextSamples = std::function<std::vector<RecordedSample>()>;

/// Writes a recording as a stroke file (read_stroke_file takes it) with the recorder's columns `sequence`,
/// `monotonic_time` (ns), `flags`, and what header and footer say as attributes of /stroke; by way of
/// PATH.part. footer: none, where it was cut off: then the counts are made from the samples. Error: io;
/// input, where there is no sample.
void write_recording_file(const std::filesystem::path& path, const RecordingHeader& header,
                          const std::optional<RecordingFooter>& footer, const NextSamples& next);

/// What a stroke file says of how it was recorded; none where no recorder made it. Error: io, input.
struct RecordingInfo {
  RecordingHeader header;
  RecordingFooter footer;
  bool complete = false;
};
std::optional<RecordingInfo> read_recording_info(const std::filesystem::path& path);

}  // namespace sandstroke
