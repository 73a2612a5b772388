#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace sandstroke {

/// A plain message as ROS 2 writes it, for tests: byte by byte, with padding up to each number's alignment.
/// As version 0 it is what ROS 1 writes: no header, no padding, no 0 behind a text, and headers with a
/// number.
class CdrWriter {
 public:
  explicit CdrWriter(bool little_endian = true, int version = 1) : little_(little_endian), version_(version) {
    const char encoding = static_cast<char>((version == 1 ? 0 : 6) + (little_endian ? 1 : 0));
    if (version > 0) header_ = std::string{'\0', encoding, '\0', '\0'};
  }
  CdrWriter& integer(std::uint32_t value) { return put(value, 4, 4); }
  CdrWriter& number(double value) {
    return put(std::bit_cast<std::uint64_t>(value), 8, version_ == 1 ? 8 : 4);
  }
  CdrWriter& text(const std::string& text) {
    const std::string whole = version_ == 0 ? text : text + '\0';
    integer(static_cast<std::uint32_t>(whole.size()));
    body_ += whole;
    return *this;
  }
  CdrWriter& header(std::int32_t seconds, std::uint32_t nanoseconds, const std::string& frame) {
    if (version_ == 0) integer(77);
    return integer(static_cast<std::uint32_t>(seconds)).integer(nanoseconds).text(frame);
  }
  CdrWriter& numbers(const std::vector<double>& values) {
    for (const double value : values) number(value);
    return *this;
  }
  std::string bytes() const { return header_ + body_; }

 private:
  CdrWriter& put(std::uint64_t value, int size, std::size_t alignment) {
    while (version_ > 0 && body_.size() % alignment != 0) body_ += '\xAA';
    for (int i = 0; i < size; ++i) body_ += static_cast<char>(value >> 8 * (little_ ? i : size - 1 - i));
    return *this;
  }

  bool little_;
  int version_;
  std::string header_, body_;
};

}  // namespace sandstroke
