#include "import/mcap.h"

#include <algorithm>

#include "core/error.h"
#include "import/chunked_recording.h"
#include "import/ros_samples.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t mcap_magic_size = 8, mcap_record_head = 9, mcap_footer_size = 20;

/// Kinds of records (mcap.dev/spec).
enum McapOp : std::uint64_t {
  mcap_footer = 0x02,
  mcap_schema = 0x03,
  mcap_channel = 0x04,
  mcap_message = 0x05,
  mcap_chunk = 0x06,
  mcap_chunk_index = 0x08,
  mcap_statistics = 0x0B,
  mcap_data_end = 0x0F,
};

class McapFile : public ChunkedRecording {
 public:
  explicit McapFile(const fs::path& path) : ChunkedRecording(path) { read_summary(); }
  const char* kind() const override { return "MCAP file"; }
  std::vector<RosTopic> topics() override;

 private:
  Record next(PackedBytes& bytes) override;
  std::uint64_t begin() const override { return mcap_magic_size; }
  std::uint64_t end() const override { return closed_ ? file_size_ - mcap_magic_size : file_size_; }

  void read_summary();
  bool summary_is_sound(std::uint64_t begin, std::uint64_t end, std::uint32_t crc);
  void read_schema(PackedBytes& bytes);
  void read_channel(PackedBytes& bytes);
  void read_chunk_index(PackedBytes& bytes);
  void read_statistics(PackedBytes& bytes);

  std::map<std::uint64_t, std::string> schemas_;     // names, by id
  std::map<std::int64_t, std::uint64_t> schema_of_;  // of a channel
  std::map<std::int64_t, std::uint64_t> counts_;     // messages of channels, from the statistics
  bool has_counts_ = false;
};

/// Reads topics and the index of chunks from the end of the file, if they are there.
void McapFile::read_summary() {
  constexpr std::uint64_t tail_size = mcap_record_head + mcap_footer_size + mcap_magic_size;
  if (file_size_ < mcap_magic_size + tail_size) return;
  const std::uint64_t footer = file_size_ - tail_size;
  PackedBytes tail(file_, footer, tail_size);
  const bool is_footer = tail.number(1) == mcap_footer && tail.number(8) == mcap_footer_size;
  const std::uint64_t summary = tail.number(8);
  tail.number(8);  // where groups of the summary begin
  const auto crc = static_cast<std::uint32_t>(tail.number(4));
  closed_ = is_footer && tail.bytes(mcap_magic_size) == mcap_magic;
  if (!closed_ || summary == 0) return;
  if (summary >= mcap_magic_size && summary <= footer && summary_is_sound(summary, footer, crc)) {
    for (const auto& [channel, count] : counts_)
      if (has_counts_ && !topics_.contains(channel)) has_counts_ = false;
    counted_ = has_counts_;
    for (auto& [channel, topic] : topics_) topic.messages = counted_ ? counts_[channel] : 0;
    return;
  }
  warn(fmt::format("{}: the summary at byte {} is damaged; the messages themselves are read instead", name_,
                   summary));
  topics_.clear();
  chunk_topics_.clear();
}

bool McapFile::summary_is_sound(std::uint64_t begin, std::uint64_t end, std::uint32_t crc) {
  if (crc != 0) {
    const std::uint64_t size = end - begin + mcap_record_head + 16;  // up to the footer's checksum
    PackedBytes summed(file_, begin, size, Packing::none, size, true);
    summed.finish(crc);
    if (!summed.sound()) return false;
  }
  PackedBytes bytes(file_, begin, end - begin);
  while (bytes.left() > 0) {
    const Record record = next(bytes);
    bytes.go_to(record.end);
    if (!bytes.sound()) return false;
  }
  return true;
}

ChunkedRecording::Record McapFile::next(PackedBytes& bytes) {
  const std::uint64_t at = bytes.at(), op = bytes.number(1), size = bytes.number(8);
  Record record;
  if (op == 0) bytes.fail("no record begins there");
  if (size > bytes.left() && op != mcap_chunk)  // a chunk that is cut off is read as far as it goes
    bytes.fail(fmt::format("a record of {} bytes is longer than what is left", size));
  record.end = bytes.at() + std::min(size, UINT64_MAX - bytes.at());
  switch (op) {
    case mcap_schema:
      read_schema(bytes);
      break;
    case mcap_channel:
      read_channel(bytes);
      break;
    case mcap_chunk_index:
      read_chunk_index(bytes);
      break;
    case mcap_statistics:
      read_statistics(bytes);
      break;
    case mcap_message:
      record.kind = Record::Kind::message;
      record.topic = static_cast<std::int64_t>(bytes.number(2));
      bytes.number(4);  // running number
      record.recorded = static_cast<std::int64_t>(bytes.number(8));
      bytes.number(8);  // when it was sent
      record.data_size = record.end - bytes.at();
      break;
    case mcap_chunk:
      record.kind = Record::Kind::chunk;
      bytes.number(8);  // first and
      bytes.number(8);  // last time
      record.unpacked_size = bytes.number(8);
      record.crc = static_cast<std::uint32_t>(bytes.number(4));
      record.packing = bytes.text();
      record.data_size = bytes.number(8);
      if (bytes.sound() && record.data_size > record.end - bytes.at())
        bytes.fail(fmt::format("its {} packed bytes are longer than the chunk", record.data_size));
      break;
    case mcap_footer:
    case mcap_data_end:
      record.kind = Record::Kind::last;
      break;
    default:  // of no use here, or of a later version
      break;
  }
  if (bytes.sound() && bytes.at() > record.end)
    bytes.fail(fmt::format("a record of {} bytes is too short for its kind ({})", record.end - at, op));
  return record;
}

void McapFile::read_schema(PackedBytes& bytes) {
  const std::uint64_t id = bytes.number(2);
  const std::string name = bytes.text();
  if (bytes.sound() && id != 0) schemas_[id] = name;
}

void McapFile::read_channel(PackedBytes& bytes) {
  const auto id = static_cast<std::int64_t>(bytes.number(2));
  const std::uint64_t schema = bytes.number(2);
  RosTopic topic;
  topic.name = bytes.text();
  topic.encoding = bytes.text();
  topic.ids = {id};
  note_topic(bytes, topic);
  if (bytes.sound()) schema_of_[id] = schema;
}

void McapFile::read_chunk_index(PackedBytes& bytes) {
  bytes.number(8);  // first and
  bytes.number(8);  // last time
  const std::uint64_t chunk = bytes.number(8);
  bytes.number(8);  // its length
  std::vector<std::uint32_t> channels;
  const std::uint64_t map_size = bytes.number(4);
  for (std::uint64_t i = 0; i + 10 <= map_size && bytes.sound(); i += 10) {
    channels.push_back(static_cast<std::uint32_t>(bytes.number(2)));
    bytes.number(8);  // where its messages are listed
  }
  if (bytes.sound() && !channels.empty()) chunk_topics_[chunk] = std::move(channels);
}

void McapFile::read_statistics(PackedBytes& bytes) {
  const std::uint64_t messages = bytes.number(8);
  bytes.number(2);                              // schemas
  for (int i = 0; i < 4; ++i) bytes.number(4);  // channels, attachments, metadata, chunks
  for (int i = 0; i < 2; ++i) bytes.number(8);  // first and last time
  const std::uint64_t map_size = bytes.number(4);
  for (std::uint64_t i = 0; i + 10 <= map_size && bytes.sound(); i += 10) {
    const auto channel = static_cast<std::int64_t>(bytes.number(2));
    counts_[channel] = bytes.number(8);
  }
  has_counts_ = bytes.sound() && (messages == 0 || !counts_.empty());
}

std::vector<RosTopic> McapFile::topics() {
  std::vector<RosTopic> topics = ChunkedRecording::topics();
  for (RosTopic& topic : topics) topic.type = schemas_[schema_of_[*topic.ids.begin()]];
  return topics;
}

}  // namespace

SampleTable read_mcap(const fs::path& path, const std::string& part) {
  McapFile file(path);
  return ros_samples(file, part);
}

}  // namespace sandstroke
