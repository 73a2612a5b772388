#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/input_file.h"
#include "import/packed_bytes.h"
#include "import/ros_recording.h"

namespace sandstroke {

/// A recording made of records, of which chunks contain others, perhaps packed: MCAP and bags of ROS 1. Only
/// a block of the file and one message are in memory. An index in the file, if it is sound, tells topics and
/// which chunks to read; without it the whole file is read.
///
/// A recording that was not closed (the recorder or the computer stopped) is read as far as it is whole, with
/// a warning. In a closed one, damage is an Error.
class ChunkedRecording : public RosRecording {
 public:
  const std::string& name() const override { return name_; }
  std::vector<RosTopic> topics() override;
  void read(const std::set<std::int64_t>& ids, const Take& take) override;
  std::string place() const override { return place_of(message_at_); }
  std::vector<std::string> warnings() const override { return warnings_; }

 protected:
  /// A record, of which next() has read what stands before the data.
  struct Record {
    enum class Kind { other, message, chunk, last } kind = Kind::other;
    std::uint64_t end = 0;                 ///< where the next one begins
    std::uint64_t data_size = 0;           ///< of a message or chunk, whose data come next
    std::int64_t topic = 0, recorded = 0;  ///< of a message; recorded in ns
    std::string packing;                   ///< of a chunk, as in the file
    std::uint64_t unpacked_size = 0;
    std::uint32_t crc = 0;  ///< of its unpacked bytes; 0: not given
  };

  explicit ChunkedRecording(const std::filesystem::path& path);
  /// The next record. What it says of topics, or of chunks, is noted. If there is none, `bytes` fails.
  virtual Record next(PackedBytes& bytes) = 0;
  /// Where the records begin and end in the file.
  virtual std::uint64_t begin() const = 0;
  virtual std::uint64_t end() const = 0;

  /// Notes a topic. `bytes` fails if its id is another topic's.
  void note_topic(PackedBytes& bytes, const RosTopic& topic);
  void warn(const std::string& sentence);

  std::string name_;
  InputFile file_;
  std::uint64_t file_size_ = 0;
  bool closed_ = false;   // properly: its end is there
  bool counted_ = false;  // all topics and their messages are known
  std::map<std::int64_t, RosTopic> topics_;
  std::map<std::uint64_t, std::vector<std::uint32_t>> chunk_topics_;  // ids in the chunk at a byte, if known

 private:
  using Use = std::function<void(const Record&, PackedBytes&)>;
  void go_through(const std::set<std::int64_t>* ids, const Use& use);
  bool walk(PackedBytes& bytes, const std::set<std::int64_t>* ids, const Use& use);
  bool walk_chunk(std::uint64_t at, const Record& chunk, std::uint64_t data_at,
                  const std::set<std::int64_t>* ids, const Use& use);
  Packing packing_of(const Record& chunk) const;
  bool needs_chunk(std::uint64_t at, const std::set<std::int64_t>* ids) const;
  void tell_failure(std::uint64_t at, const std::string& why);
  std::string place_of(std::uint64_t at) const;

  std::vector<std::string> warnings_;
  double unpacked_ = 0.0;  // bytes
  std::uint64_t message_at_ = 0;
  std::optional<std::uint64_t> chunk_at_;  // whose records are being read
};

}  // namespace sandstroke
