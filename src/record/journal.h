#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "core/file_lock.h"
#include "haptics/recording.h"

namespace sandstroke {

/// Where the samples of STROKE.h5 are until the recording is over: STROKE.h5.recording.
std::filesystem::path journal_path(const std::filesystem::path& stroke_file);

/// A recording while it goes on: a file that is only ever appended to, sample by sample with a checksum each,
/// so that whatever ends the program, all that was written can be read. Error: io.
class JournalWriter {
 public:
  /// Error: io, also where the file is there (an earlier recording that nobody repaired is not overwritten).
  JournalWriter(const std::filesystem::path& path, const RecordingHeader& header);
  void append(std::span<const RecordedSample> samples);
  /// On the disk: a power failure does not lose it either.
  void sync();
  void finish(const RecordingFooter& footer);
};

/// Reads back what there is of a recording.
class JournalReader {
 public:
  /// Error: io, input (not a journal, or cut off within its header).
  explicit JournalReader(const std::filesystem::path& path);
  const RecordingHeader& header() const;
  /// The next samples, at most `most`; empty at the end of the sound ones.
  std::vector<RecordedSample> next(std::size_t most);
  /// After the last: none, where it was cut off.
  const std::optional<RecordingFooter>& footer() const;
  /// Bytes after the last sound sample that are none (cut off while being written, or damaged).
  std::uint64_t lost_bytes() const;
};

}  // namespace sandstroke
