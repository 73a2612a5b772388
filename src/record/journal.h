#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/file_lock.h"
#include "core/input_file.h"
#include "haptics/recording.h"

namespace sandstroke {

// The journal of a recording, all little-endian:
//   "sandstroke.recording"  20 bytes, and a uint32: the format's version, 2 (1 is read, too)
//   blocks, each
//     uint32 kind           1 header, 2 sample, 3 footer
//     uint32 length         of the content, bytes
//     uint64 checksum       FNV-1a of kind, length and content
//     content               sample: RecordedSample's 128 bytes (in version 1 its first 96)
//                           header, footer: JSON (recording_json.h)
// The header comes first, then samples, then the footer, unless the recording was cut off.

/// Bytes of a sample's block.
inline constexpr std::size_t journal_sample_bytes = 16 + sizeof(RecordedSample);

/// Where the samples of STROKE.h5 are until the recording is over: STROKE.h5.recording.
std::filesystem::path journal_path(const std::filesystem::path& stroke_file);
/// Error: io, where this journal exists. It is a recording in progress, or an earlier one that nobody
/// repaired, and must not be overwritten.
void check_no_journal(const std::filesystem::path& path);

/// A recording in progress: a file that is only appended to, sample by sample with a checksum each. So all
/// that was written can be read, whatever ends the program. Error: io.
class JournalWriter {
 public:
  /// Error: io, also as in check_no_journal.
  JournalWriter(const std::filesystem::path& path, const RecordingHeader& header);
  JournalWriter(const JournalWriter&) = delete;
  ~JournalWriter();
  /// Hands samples to the system: no end of this program loses them. Where the system takes no more, those
  /// that it took are sound, and the next call goes on after them.
  void append(std::span<const RecordedSample> samples);
  /// Puts all samples on the disk: a power failure does not lose them either. Error: io, also where the file
  /// was removed, because later samples would be lost.
  void sync();
  /// Number of whole samples in the file; also after a failure, where not all of an append were taken.
  std::int64_t samples() const { return samples_; }
  /// Puts the footer on the disk, and frees the file for readers.
  void finish(const RecordingFooter& footer);

 private:
  /// Writes blocks of equal size. After a failure the file ends with the last whole one.
  void write(const std::string& blocks, std::size_t block_size);
  [[noreturn]] void fail(int error) const;

  std::filesystem::path path_;
  int file_ = -1;
  std::optional<FileLock> lock_;  // while it is being written
  std::uint64_t size_ = 0;        // bytes of whole blocks
  std::int64_t samples_ = 0;
  std::string blocks_;  // one append's
};

/// Reads back a recording up to its last sound sample, whatever follows.
class JournalReader : public Recording {
 public:
  /// Error: io (also where it is still being written), input (not a journal, or cut off within its header).
  explicit JournalReader(const std::filesystem::path& path);
  const RecordingHeader& header() const override { return header_; }
  std::vector<RecordedSample> next(std::size_t most) override;
  const std::optional<RecordingFooter>& footer() const override { return footer_; }
  /// After the last sample: bytes that follow the last sound block (cut off while being written, or damaged).
  std::uint64_t lost_bytes() const { return size_ - sound_; }

 private:
  struct Block;
  /// The next block, if it is whole and its checksum is right.
  std::optional<Block> read_block();
  /// Reads exactly `count` bytes; false where the file ends before.
  bool read(void* bytes, std::size_t count);

  std::string name_;
  std::optional<FileLock> lock_;
  InputFile file_;
  std::uint64_t size_ = 0, sound_ = 0;  // bytes: of the file, and up to the end of its last sound block
  RecordingHeader header_;
  std::optional<RecordingFooter> footer_;
  std::int64_t last_sequence_ = -1, last_time_ = -1;
  bool at_end_ = false;
};

}  // namespace sandstroke
