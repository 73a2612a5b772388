#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>

namespace sandstroke {

/// Writes a zip archive in memory: its files stored or deflated, with small numbers or as zip64.
class ZipWriter {
 public:
  explicit ZipWriter(bool deflated = false, bool zip64 = false) : deflated_(deflated), zip64_(zip64) {}

  void add(const std::string& name, const std::string& content) {
    const std::string packed = deflated_ ? deflated(content) : content;
    const std::uint64_t begin = archive_.size();
    const auto checksum = crc32_z(0, reinterpret_cast<const Bytef*>(content.data()), content.size());
    const std::string large = number(1, 2) + number(24, 2) + number(content.size(), 8) +
                              number(packed.size(), 8) + number(begin, 8);
    const std::uint64_t beyond = 0xFFFFFFFF;
    const std::string sizes = number(deflated_ ? 8 : 0, 2) + number(0, 4) + number(checksum, 4) +
                              number(zip64_ ? beyond : packed.size(), 4) +
                              number(zip64_ ? beyond : content.size(), 4) + number(name.size(), 2);
    archive_ += "PK\x03\x04" + number(20, 2) + number(0, 2) + sizes + number(0, 2) + name + packed;
    entry_ = "PK\x01\x02" + number(20, 4) + number(0, 2) + sizes + number(zip64_ ? large.size() : 0, 2) +
             number(0, 10) + number(zip64_ ? beyond : begin, 4) + name + (zip64_ ? large : "");
    add_entry();
  }

  /// Lists the last file once more.
  void add_entry() {
    directory_ += entry_;
    ++count_;
  }

  std::string archive() const {
    const std::uint64_t begin = archive_.size();
    std::string all = archive_ + directory_;
    if (zip64_) {
      const std::uint64_t at = all.size();
      all += "PK\x06\x06" + number(44, 8) + number(0, 12) + number(count_, 8) + number(count_, 8) +
             number(directory_.size(), 8) + number(begin, 8);
      all += "PK\x06\x07" + number(0, 4) + number(at, 8) + number(1, 4);
    }
    return all + "PK\x05\x06" + number(0, 4) + number(zip64_ ? 0xFFFF : count_, 2) +
           number(zip64_ ? 0xFFFF : count_, 2) + number(directory_.size(), 4) +
           number(zip64_ ? 0xFFFFFFFF : begin, 4) + number(0, 2);
  }

 private:
  static std::string number(std::uint64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(i < 8 ? value >> 8 * i : 0);
    return text;
  }
  static std::string deflated(const std::string& content) {
    std::string packed(compressBound(content.size()), '\0');
    z_stream stream{};
    deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
    stream.avail_in = static_cast<uInt>(content.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
  }

  bool deflated_, zip64_;
  std::string archive_, directory_, entry_;
  std::uint64_t count_ = 0;
};

}  // namespace sandstroke
