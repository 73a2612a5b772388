#include "import/ros1_bag.h"

#include <algorithm>

#include "core/error.h"
#include "import/chunked_recording.h"
#include "import/ros_samples.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// Kinds of records (wiki.ros.org/Bags/Format/2.0).
enum BagOp : std::uint64_t {
  bag_message = 0x02,
  bag_header = 0x03,
  bag_index = 0x04,
  bag_chunk = 0x05,
  bag_chunk_info = 0x06,
  bag_connection = 0x07,
};

/// Names and values of a header.
using BagFields = std::map<std::string, std::string, std::less<>>;

BagFields bag_fields(PackedBytes& bytes, std::string_view text) {
  BagFields fields;
  while (!text.empty() && bytes.sound()) {
    const std::uint64_t size = little_endian(text.substr(0, 4));
    text.remove_prefix(std::min<std::size_t>(text.size(), 4));
    const std::string_view field = size <= text.size() ? text.substr(0, size) : "";
    const auto equals = field.find('=');
    if (field.empty() || equals == std::string_view::npos) {
      bytes.fail("its header is not made of fields NAME=VALUE");
      break;
    }
    fields.emplace(field.substr(0, equals), field.substr(equals + 1));
    text.remove_prefix(size);
  }
  return fields;
}

class Ros1Bag : public ChunkedRecording {
 public:
  explicit Ros1Bag(const fs::path& path) : ChunkedRecording(path) { read_index(); }
  const char* kind() const override { return "ROS 1 bag"; }

 private:
  Record next(PackedBytes& bytes) override;
  std::uint64_t begin() const override { return std::string_view(ros1_bag_magic).size(); }
  std::uint64_t end() const override { return file_size_; }

  void read_index();
  void read_connection(PackedBytes& bytes, const BagFields& header, std::uint64_t size);
  void read_chunk_info(PackedBytes& bytes, const BagFields& header);
  static std::string text(PackedBytes& bytes, const BagFields& header, std::string_view name);
  static std::uint64_t number(PackedBytes& bytes, const BagFields& header, std::string_view name,
                              std::size_t size);

  std::uint64_t index_at_ = 0;
  std::map<std::int64_t, std::uint64_t> counts_;  // messages of topics, from the index
};

std::string Ros1Bag::text(PackedBytes& bytes, const BagFields& header, std::string_view name) {
  const auto field = header.find(name);
  if (field != header.end()) return field->second;
  bytes.fail(fmt::format("its header has no field {}", name));
  return "";
}

std::uint64_t Ros1Bag::number(PackedBytes& bytes, const BagFields& header, std::string_view name,
                              std::size_t size) {
  const std::string value = text(bytes, header, name);
  if (value.size() == size) return little_endian(value);
  bytes.fail(fmt::format("field {} of its header has {} bytes instead of {}", name, value.size(), size));
  return 0;
}

/// Reads the first record, and topics and chunks from the end of the file, if they are there.
void Ros1Bag::read_index() {
  PackedBytes first(file_, 0, file_size_);
  first.go_to(begin());
  next(first);
  if (index_at_ == 0 || index_at_ > file_size_) return;
  PackedBytes bytes(file_, 0, file_size_);
  bytes.go_to(index_at_);
  while (bytes.sound() && bytes.left() > 0) {
    const Record record = next(bytes);
    bytes.go_to(record.end);
  }
  closed_ = counted_ = bytes.sound();
  for (auto& [id, topic] : topics_) topic.messages = counted_ ? counts_[id] : 0;
  if (!closed_) chunk_topics_.clear();
}

ChunkedRecording::Record Ros1Bag::next(PackedBytes& bytes) {
  const BagFields header = bag_fields(bytes, bytes.bytes(bytes.number(4)));
  const std::uint64_t op = number(bytes, header, "op", 1);
  Record record;
  record.data_size = bytes.number(4);
  record.end = bytes.at() + record.data_size;
  if (record.data_size > bytes.left() && op != bag_chunk)  // which is read as far as it goes
    bytes.fail(fmt::format("a record of {} bytes is longer than what is left", record.data_size));
  switch (op) {
    case bag_message: {
      record.kind = Record::Kind::message;
      record.topic = static_cast<std::int64_t>(number(bytes, header, "conn", 4));
      const std::uint64_t time = number(bytes, header, "time", 8);
      record.recorded = static_cast<std::int64_t>((time & UINT32_MAX) * 1'000'000'000 + (time >> 32));
      break;
    }
    case bag_chunk:
      record.kind = Record::Kind::chunk;
      record.packing = text(bytes, header, "compression");
      record.unpacked_size = number(bytes, header, "size", 4);
      break;
    case bag_connection:
      read_connection(bytes, header, record.data_size);
      break;
    case bag_chunk_info:
      read_chunk_info(bytes, header);
      break;
    case bag_header:
      index_at_ = number(bytes, header, "index_pos", 8);
      if (header.contains("encryptor") && !text(bytes, header, "encryptor").empty())
        throw_input_error("{}: is encrypted ({}); save it without encryption", name_,
                          text(bytes, header, "encryptor"));
      break;
    case bag_index:
      break;
    default:
      bytes.fail(fmt::format("a record of the unknown kind {} begins there", op));
  }
  return record;
}

void Ros1Bag::read_connection(PackedBytes& bytes, const BagFields& header, std::uint64_t size) {
  RosTopic topic;
  topic.name = text(bytes, header, "topic");
  topic.encoding = "ros1";
  topic.ids = {static_cast<std::int64_t>(number(bytes, header, "conn", 4))};
  topic.type = text(bytes, bag_fields(bytes, bytes.bytes(size)), "type");
  note_topic(bytes, topic);
}

void Ros1Bag::read_chunk_info(PackedBytes& bytes, const BagFields& header) {
  const std::uint64_t chunk = number(bytes, header, "chunk_pos", 8);
  const std::uint64_t count = number(bytes, header, "count", 4);
  std::vector<std::uint32_t> ids;
  for (std::uint64_t i = 0; i < count && bytes.sound(); ++i) {
    ids.push_back(static_cast<std::uint32_t>(bytes.number(4)));
    counts_[ids.back()] += bytes.number(4);
  }
  if (bytes.sound()) chunk_topics_[chunk] = std::move(ids);
}

}  // namespace

SampleTable read_ros1_bag(const fs::path& path, const std::string& part) {
  Ros1Bag bag(path);
  return ros_samples(bag, part);
}

}  // namespace sandstroke
