#include "import/cdr.h"

#include <algorithm>
#include <bit>

namespace sandstroke {

CdrReader::CdrReader(std::string_view bytes) {
  constexpr std::size_t header = 4;  // the encoding, and options
  const auto encoding = [&] {
    return static_cast<unsigned char>(bytes[0]) << 8 | static_cast<unsigned char>(bytes[1]);
  };
  sound_ = bytes.size() >= header && (encoding() <= 1 || encoding() == 6 || encoding() == 7);
  if (!sound_) return;
  little_endian_ = encoding() % 2 == 1;
  if (encoding() >= 6) most_alignment_ = 4;
  body_ = bytes.substr(header);
}

std::uint64_t CdrReader::next(std::size_t size) {
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

std::uint32_t CdrReader::integer() { return static_cast<std::uint32_t>(next(4)); }

double CdrReader::number() { return std::bit_cast<double>(next(8)); }

void CdrReader::pass_text() {
  const std::size_t length = integer();  // with the 0 at its end
  sound_ = sound_ && length <= body_.size() - at_;
  if (sound_) at_ += length;
}

}  // namespace sandstroke
