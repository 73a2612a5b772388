#include "import/ros_bytes.h"

#include <algorithm>
#include <bit>

namespace sandstroke {

RosReader::RosReader(std::string_view bytes, RosEncoding encoding) : encoding_(encoding), body_(bytes) {
  if (encoding == RosEncoding::ros1) {
    most_alignment_ = 1;
    return;
  }
  constexpr std::size_t header = 4;  // the representation, and options
  const auto representation = [&] {
    return static_cast<unsigned char>(bytes[0]) << 8 | static_cast<unsigned char>(bytes[1]);
  };
  sound_ =
      bytes.size() >= header && (representation() <= 1 || representation() == 6 || representation() == 7);
  if (!sound_) return;
  little_endian_ = representation() % 2 == 1;
  if (representation() >= 6) most_alignment_ = 4;
  body_ = bytes.substr(header);
}

std::uint64_t RosReader::next(std::size_t size) {
  const std::size_t alignment = std::min(size, most_alignment_);
  const std::size_t begin = (at_ + alignment - 1) / alignment * alignment;
  sound_ = sound_ && begin <= body_.size() && size <= body_.size() - begin;
  if (!sound_) return 0;
  at_ = begin + size;
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t byte = little_endian_ ? begin + size - 1 - i : begin + i;
    value = value << 8 | static_cast<unsigned char>(body_[byte]);
  }
  return value;
}

std::uint32_t RosReader::integer() { return static_cast<std::uint32_t>(next(4)); }

double RosReader::number() { return std::bit_cast<double>(next(8)); }

std::int64_t RosReader::stamp() {
  const std::uint32_t seconds = integer();
  const std::int64_t whole =
      encoding_ == RosEncoding::cdr ? static_cast<std::int32_t>(seconds) : static_cast<std::int64_t>(seconds);
  return std::int64_t{1'000'000'000} * whole + integer();
}

std::string_view RosReader::text() {
  const std::size_t length = integer();  // in CDR with the 0 at its end
  sound_ = sound_ && length <= body_.size() - at_;
  if (!sound_) return {};
  std::string_view text = body_.substr(at_, length);
  at_ += length;
  if (encoding_ == RosEncoding::cdr && text.ends_with('\0')) text.remove_suffix(1);
  return text;
}

std::uint32_t RosReader::count_of_messages() {
  const bool version_2 = encoding_ == RosEncoding::cdr && most_alignment_ == 4;
  if (version_2) integer();  // the list's size in bytes
  return integer();
}

}  // namespace sandstroke
