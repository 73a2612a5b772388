#pragma once

#include <bit>
#include <cstdint>
#include <string>

namespace sandstroke {

/// A plain message as ROS 2 writes it, for tests: byte by byte, with padding up to each number's alignment.
class CdrWriter {
 public:
  explicit CdrWriter(bool little_endian = true, int version = 1) : little_(little_endian), version_(version) {
    const char encoding = static_cast<char>((version == 1 ? 0 : 6) + (little_endian ? 1 : 0));
    header_ = std::string{'\0', encoding, '\0', '\0'};
  }
  CdrWriter& integer(std::uint32_t value) { return put(value, 4, 4); }
  CdrWriter& number(double value) {
    return put(std::bit_cast<std::uint64_t>(value), 8, version_ == 1 ? 8 : 4);
  }
  CdrWriter& text(const std::string& text) {
    integer(static_cast<std::uint32_t>(text.size() + 1));
    body_ += text + '\0';
    return *this;
  }
  CdrWriter& header(std::int32_t seconds, std::uint32_t nanoseconds, const std::string& frame) {
    return integer(static_cast<std::uint32_t>(seconds)).integer(nanoseconds).text(frame);
  }
  std::string bytes() const { return header_ + body_; }

 private:
  CdrWriter& put(std::uint64_t value, int size, std::size_t alignment) {
    while (body_.size() % alignment != 0) body_ += '\xAA';
    for (int i = 0; i < size; ++i) body_ += static_cast<char>(value >> 8 * (little_ ? i : size - 1 - i));
    return *this;
  }

  bool little_;
  int version_;
  std::string header_, body_;
};

}  // namespace sandstroke
