#include "import/packed_bytes.h"

#include <spdlog/fmt/fmt.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <utility>

namespace sandstroke {

std::uint64_t little_endian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

PackedBytes::PackedBytes(InputFile& file, std::uint64_t begin, std::uint64_t size)
    : PackedBytes(file, begin, size, Packing::none, size, false) {}

PackedBytes::PackedBytes(InputFile& file, std::uint64_t begin, std::uint64_t packed_size, Packing packing,
                         std::uint64_t size, bool checked)
    : file_(file),
      begin_(begin),
      packed_left_(packed_size),
      size_(size),
      unpacker_(make_unpacker(packing)),
      checked_(checked) {
  file_.seek(begin);
  if (!unpacker_ && packed_size != size)
    fail(fmt::format("{} bytes that are not packed cannot be {} unpacked", packed_size, size));
}

void PackedBytes::fail(const std::string& why) {
  if (sound()) failure_ = why;
}

std::string_view PackedBytes::next_packed() {
  if (packed_left_ == 0) return {};
  std::string_view block = file_.next_block();
  if (block.empty()) fail("the file ends there");
  block = block.substr(0, packed_left_);
  packed_left_ -= block.size();
  return block;
}

/// Fills unpacked_, or fails, or leaves it empty at the end.
void PackedBytes::unpack() {
  while (sound() && unpacked_.empty()) {
    if (packed_.empty()) packed_ = next_packed();
    if (!sound()) return;
    if (!unpacker_) {
      unpacked_ = std::exchange(packed_, {});
      return;
    }
    room_.resize(1 << 16);
    const Unpacker::Step step = unpacker_->step(packed_, room_.data(), room_.size());
    if (step.failure) return fail(fmt::format("its packed bytes are damaged ({})", step.failure));
    packed_.remove_prefix(step.taken);
    unpacked_ = {room_.data(), step.given};
    if (step.taken == 0 && step.given == 0) return;
  }
}

void PackedBytes::take(char* bytes, std::uint64_t count) {
  if (count > left()) fail(fmt::format("{} bytes are missing", count - left()));
  if (sound() && seeks()) {
    if (file_.read(bytes, count) < count) fail("the file ends there");
    at_ += count;
    return;
  }
  while (sound() && count > 0) {
    if (unpacked_.empty()) unpack();
    if (unpacked_.empty()) return fail(fmt::format("it unpacks to {} instead of {} bytes", at_, size_));
    const std::size_t part = std::min<std::uint64_t>(count, unpacked_.size());
    if (checked_)
      crc_ =
          static_cast<std::uint32_t>(crc32_z(crc_, reinterpret_cast<const Bytef*>(unpacked_.data()), part));
    if (bytes) bytes = std::copy_n(unpacked_.data(), part, bytes);
    unpacked_.remove_prefix(part);
    at_ += part;
    count -= part;
  }
}

std::uint64_t PackedBytes::number(std::size_t bytes) {
  std::array<char, 8> taken{};
  take(taken.data(), bytes);
  return sound() ? little_endian({taken.data(), bytes}) : 0;
}

std::string_view PackedBytes::bytes(std::uint64_t count) {
  if (count > most_bytes) fail(fmt::format("{} bytes are more than the {} of a message", count, most_bytes));
  if (count > left()) fail(fmt::format("{} bytes are missing", count - left()));
  if (!sound()) return {};
  taken_.resize(count);
  take(taken_.data(), count);
  return sound() ? std::string_view(taken_.data(), count) : "";
}

std::string PackedBytes::text(std::uint64_t length) {
  if (length > most_name_bytes)
    fail(fmt::format("a name of {} bytes is longer than {}", length, most_name_bytes));
  return std::string(bytes(length));
}

void PackedBytes::go_to(std::uint64_t byte) {
  if (byte > size_) fail(fmt::format("{} bytes are missing", byte - size_));
  if (!sound()) return;
  if (seeks()) {
    char last = 0;  // tells whether the file has all bytes before
    file_.seek(begin_ + byte - (byte > 0));
    if (byte > 0 && file_.read(&last, 1) == 0) fail("the file ends there");
    at_ = byte;
  } else if (byte < at_) {
    fail("its parts are longer than the whole");
  } else {
    take(nullptr, byte - at_);
  }
}

void PackedBytes::finish(std::uint32_t crc) {
  go_to(size_);
  if (sound() && unpacked_.empty() && unpacker_) unpack();
  if (sound() && !unpacked_.empty()) fail(fmt::format("it unpacks to more than {} bytes", size_));
  if (sound() && checked_ && crc != crc_)
    fail(fmt::format("its checksum is {:08x}, but {:08x} was written", crc_, crc));
}

}  // namespace sandstroke
