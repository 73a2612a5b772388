#pragma once

#include <bzlib.h>
#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <cstdint>
#include <map>
#include <string>

// Bytes of recordings, written for tests from the descriptions of the formats: mcap.dev/spec and
// wiki.ros.org/Bags/Format/2.0.

namespace sandstroke {

/// Little-endian; zeros beyond its 8 bytes.
inline std::string number_bytes(std::uint64_t value, int size) {
  std::string bytes;
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(i < 8 ? value >> 8 * i : 0);
  return bytes;
}

/// After its length in 4 bytes.
inline std::string counted_text(const std::string& text) { return number_bytes(text.size(), 4) + text; }

/// Packed by "lz4", "zstd" or "bz2"; otherwise as it is.
inline std::string packed_bytes(const std::string& bytes, const std::string& packing) {
  std::string packed(bytes.size() + 1000, '\0');
  std::size_t size = bytes.size();
  if (packing == "lz4") {
    size = LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr);
  } else if (packing == "zstd") {
    size = ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 1);
  } else if (packing == "bz2") {
    auto room = static_cast<unsigned>(packed.size());
    BZ2_bzBuffToBuffCompress(packed.data(), &room, const_cast<char*>(bytes.data()),
                             static_cast<unsigned>(bytes.size()), 1, 0, 0);
    size = room;
  } else {
    return bytes;
  }
  return packed.substr(0, size);
}

inline std::uint32_t crc_of(const std::string& bytes) {
  return static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

/// Records of MCAP.
namespace mcap {

inline const std::string magic = "\x89MCAP0\r\n";

inline std::string record(int op, const std::string& content) {
  return static_cast<char>(op) + number_bytes(content.size(), 8) + content;
}
inline std::string schema(int id, const std::string& name, const std::string& encoding = "ros2msg") {
  return record(3,
                number_bytes(id, 2) + counted_text(name) + counted_text(encoding) + counted_text("string x"));
}
inline std::string channel(int id, int schema, const std::string& topic,
                           const std::string& encoding = "cdr") {
  return record(4, number_bytes(id, 2) + number_bytes(schema, 2) + counted_text(topic) +
                       counted_text(encoding) + counted_text(""));
}
inline std::string message(int channel, std::uint64_t time, const std::string& bytes) {
  return record(5, number_bytes(channel, 2) + number_bytes(0, 4) + number_bytes(time, 8) +
                       number_bytes(time, 8) + bytes);
}
inline std::string chunk(const std::string& records, const std::string& packing, std::uint32_t crc,
                         std::uint64_t unpacked_size) {
  const std::string packed = packed_bytes(records, packing);
  return record(6, number_bytes(0, 16) + number_bytes(unpacked_size, 8) + number_bytes(crc, 4) +
                       counted_text(packing) + number_bytes(packed.size(), 8) + packed);
}
inline std::string chunk(const std::string& records, const std::string& packing) {
  return chunk(records, packing, crc_of(records), records.size());
}
/// The chunk at a byte has messages of these channels.
inline std::string chunk_index(std::uint64_t at, const std::map<int, int>& channels) {
  std::string map;
  for (const auto& [id, index_at] : channels) map += number_bytes(id, 2) + number_bytes(index_at, 8);
  return record(8, number_bytes(0, 16) + number_bytes(at, 8) + number_bytes(0, 8) + counted_text(map) +
                       number_bytes(0, 8) + counted_text("") + number_bytes(0, 16));
}
inline std::string statistics(const std::map<int, int>& counts) {
  std::string map;
  std::uint64_t all = 0;
  for (const auto& [id, count] : counts) {
    map += number_bytes(id, 2) + number_bytes(count, 8);
    all += count;
  }
  return record(11, number_bytes(all, 8) + number_bytes(0, 2 + 4 * 4 + 2 * 8) + counted_text(map));
}
/// What stands before the data.
inline std::string head() { return magic + record(1, counted_text("ros2") + counted_text("")); }

inline std::string file(const std::string& data, const std::string& summary = "") {
  const std::string before = head() + data + record(15, number_bytes(0, 4));
  const std::string footer_begin = std::string("\x02") + number_bytes(20, 8) +
                                   number_bytes(summary.empty() ? 0 : before.size(), 8) + number_bytes(0, 8);
  return before + summary + footer_begin +
         number_bytes(summary.empty() ? 0 : crc_of(summary + footer_begin), 4) + magic;
}

}  // namespace mcap

/// Records of a bag of ROS 1.
namespace ros1 {

inline const std::string magic = "#ROSBAG V2.0\n";

using Fields = std::map<std::string, std::string>;

inline std::string fields(const Fields& fields) {
  std::string text;
  for (const auto& [name, value] : fields) text += counted_text(name + "=" + value);
  return text;
}
inline std::string record(int op, Fields header, const std::string& data) {
  header["op"] = number_bytes(op, 1);
  return counted_text(fields(header)) + counted_text(data);
}
inline std::string connection(int id, const std::string& topic, const std::string& type) {
  return record(7, {{"conn", number_bytes(id, 4)}, {"topic", topic}},
                fields({{"type", type}, {"md5sum", "0"}, {"message_definition", "string x"}}));
}
inline std::string message(int id, std::uint32_t seconds, std::uint32_t nanoseconds,
                           const std::string& bytes) {
  return record(
      2, {{"conn", number_bytes(id, 4)}, {"time", number_bytes(seconds, 4) + number_bytes(nanoseconds, 4)}},
      bytes);
}
inline std::string chunk(const std::string& records, const std::string& packing) {
  return record(5, {{"compression", packing}, {"size", number_bytes(records.size(), 4)}},
                packed_bytes(records, packing));
}
inline std::string chunk_info(std::uint64_t at, const std::map<int, int>& counts) {
  std::string data;
  for (const auto& [id, count] : counts) data += number_bytes(id, 4) + number_bytes(count, 4);
  return record(6,
                {{"ver", number_bytes(1, 4)},
                 {"chunk_pos", number_bytes(at, 8)},
                 {"count", number_bytes(counts.size(), 4)}},
                data);
}
/// What stands before the chunks. index_at = 0: the bag was not closed.
inline std::string head(std::uint64_t index_at) {
  return magic + record(3, {{"index_pos", number_bytes(index_at, 8)}}, std::string(40, ' '));
}
inline std::string file(const std::string& data, const std::string& index) {
  const std::uint64_t index_at = head(0).size() + data.size();
  return head(index.empty() ? 0 : index_at) + data + index;
}

}  // namespace ros1
}  // namespace sandstroke
