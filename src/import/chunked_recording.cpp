#include "import/chunked_recording.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "hdf5/hdf5_storage.h"

namespace sandstroke {

ChunkedRecording::ChunkedRecording(const std::filesystem::path& path)
    : name_(path.string()), file_(path), file_size_(std::filesystem::file_size(path)) {}

void ChunkedRecording::warn(const std::string& sentence) {
  if (std::find(warnings_.begin(), warnings_.end(), sentence) == warnings_.end())
    warnings_.push_back(sentence);
}

void ChunkedRecording::note_topic(PackedBytes& bytes, const RosTopic& topic) {
  if (!bytes.sound()) return;
  constexpr std::size_t most = 1 << 16;
  const auto [at, is_new] = topics_.try_emplace(*topic.ids.begin(), topic);
  if (at->second.name != topic.name || at->second.encoding != topic.encoding)
    bytes.fail(fmt::format("topic {} has the same number as {}", topic.name, at->second.name));
  if (topics_.size() > most) bytes.fail(fmt::format("there are more than {} topics", most));
}

std::string ChunkedRecording::place_of(std::uint64_t at) const {
  return chunk_at_ ? fmt::format("byte {} of the chunk at byte {}", at, *chunk_at_)
                   : fmt::format("byte {}", at);
}

void ChunkedRecording::tell_failure(std::uint64_t at, const std::string& why) {
  if (closed_)
    throw_input_error("{}: is damaged at {}: {}; take another copy of the file", name_, place_of(at), why);
  warn(fmt::format("{}: the recording was not closed, and is read only up to {} (the file has {} bytes): {}",
                   name_, place_of(at), file_size_, why));
}

std::vector<RosTopic> ChunkedRecording::topics() {
  if (!counted_) {
    go_through(nullptr, [this](const Record& message, PackedBytes& bytes) {
      bytes.go_to(message.end);
      topics_[message.topic].messages += bytes.sound();
    });
    counted_ = true;
  }
  std::vector<RosTopic> topics;
  for (const auto& [id, topic] : topics_) topics.push_back(topic);
  return topics;
}

void ChunkedRecording::read(const std::set<std::int64_t>& ids, const Take& take) {
  go_through(&ids, [&](const Record& message, PackedBytes& bytes) {
    if (!ids.contains(message.topic)) return;
    const std::string_view data = bytes.bytes(message.data_size);
    if (bytes.sound()) take(message.recorded, data);
  });
}

/// Uses all messages of the file; those of other topics than `ids` may be left out.
void ChunkedRecording::go_through(const std::set<std::int64_t>* ids, const Use& use) {
  unpacked_ = 0.0;
  PackedBytes bytes(file_, 0, end());
  bytes.go_to(begin());
  if (walk(bytes, ids, use) && !closed_)
    warn(fmt::format("{}: the recording was not closed; its last messages may be missing", name_));
}

bool ChunkedRecording::needs_chunk(std::uint64_t at, const std::set<std::int64_t>* ids) const {
  const auto known = chunk_topics_.find(at);
  if (!ids || known == chunk_topics_.end()) return true;
  return std::any_of(known->second.begin(), known->second.end(),
                     [&](std::uint32_t id) { return ids->contains(id); });
}

/// False if the records are not whole up to their end.
bool ChunkedRecording::walk(PackedBytes& bytes, const std::set<std::int64_t>* ids, const Use& use) {
  while (bytes.left() > 0) {
    const std::uint64_t at = bytes.at();
    const Record record = next(bytes);
    if (bytes.sound() && record.kind == Record::Kind::last) return true;
    if (bytes.sound() && record.kind == Record::Kind::message) {
      if (!topics_.contains(record.topic))
        bytes.fail(fmt::format("the message is of topic {}, which was not described", record.topic));
      message_at_ = at;
      if (bytes.sound()) use(record, bytes);
    }
    if (bytes.sound() && record.kind == Record::Kind::chunk) {
      if (chunk_at_) bytes.fail("there is a chunk in a chunk");
      if (bytes.sound() && needs_chunk(at, ids) && !walk_chunk(at, record, bytes.at(), ids, use))
        return false;
    }
    bytes.go_to(record.end);
    if (!bytes.sound()) {
      tell_failure(at, bytes.failure());
      return false;
    }
  }
  return true;
}

Packing ChunkedRecording::packing_of(const Record& chunk) const {
  if (chunk.packing.empty() || chunk.packing == "none") return Packing::none;
  if (chunk.packing == "lz4") return Packing::lz4;
  if (chunk.packing == "zstd") return Packing::zstd;
  if (chunk.packing == "bz2") return Packing::bz2;
  throw_input_error("{}: the chunk at byte {} is packed by '{}'; save the recording with lz4 or zstd", name_,
                    *chunk_at_, chunk.packing);
}

bool ChunkedRecording::walk_chunk(std::uint64_t at, const Record& chunk, std::uint64_t data_at,
                                  const std::set<std::int64_t>* ids, const Use& use) {
  chunk_at_ = at;
  // Blank pictures are packed to nearly nothing: the limit is one of time, not of memory.
  unpacked_ += static_cast<double>(chunk.unpacked_size);
  if (unpacked_ > 1e9 + most_unpacked(static_cast<double>(file_size_)))
    throw_input_error(
        "{}: the chunks up to byte {} say that they unpack to {:.3g} bytes, too many for this "
        "file; take another copy, or save the topic alone",
        name_, at, unpacked_);
  PackedBytes inside(file_, data_at, chunk.data_size, packing_of(chunk), chunk.unpacked_size, chunk.crc != 0);
  bool whole = walk(inside, ids, use);
  if (whole) {
    inside.finish(chunk.crc);
    whole = inside.sound();
    if (!whole) tell_failure(inside.at(), inside.failure());
  }
  chunk_at_.reset();
  return whole;
}

}  // namespace sandstroke
