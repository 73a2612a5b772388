#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/input_file.h"
#include "import/unpacker.h"

namespace sandstroke {

/// The number in up to 8 bytes, of which the first counts least.
std::uint64_t little_endian(std::string_view bytes);

/// Bytes of a part of a file, unpacked while they are read, so that little of it is in memory.
///
/// Nothing is trusted. What is not there, or is damaged, makes a failure: from then on numbers are 0, texts
/// empty, and failure() says why. Error: io, if the disk does not give the bytes.
class PackedBytes {
 public:
  /// Part of a file, as it is.
  PackedBytes(InputFile& file, std::uint64_t begin, std::uint64_t size);
  /// `packed_size` bytes from `begin`, which unpack to `size`. If `checked`, their CRC is calculated.
  PackedBytes(InputFile& file, std::uint64_t begin, std::uint64_t packed_size, Packing packing,
              std::uint64_t size, bool checked);

  std::uint64_t at() const { return at_; }  ///< bytes that were read or skipped
  std::uint64_t size() const { return size_; }
  std::uint64_t left() const { return size_ - at_; }
  std::uint64_t number(std::size_t bytes);        ///< little-endian, of up to 8 bytes
  std::string_view bytes(std::uint64_t count);    ///< until the next call; most_bytes at most
  std::string text(std::uint64_t length);         ///< most_name_bytes at most
  std::string text() { return text(number(4)); }  ///< after its length in 4 bytes
  /// Goes to a byte. Packed or checked bytes can only be gone through forwards.
  void go_to(std::uint64_t byte);
  /// After all was read: fails if there is more, or if the CRC of all is another one.
  void finish(std::uint32_t crc);

  void fail(const std::string& why);
  bool sound() const { return failure_.empty(); }
  const std::string& failure() const { return failure_; }

  static constexpr std::uint64_t most_bytes = 10'000'000, most_name_bytes = 10'000;

 private:
  bool seeks() const { return !unpacker_ && !checked_; }
  void take(char* bytes, std::uint64_t count);
  void unpack();
  std::string_view next_packed();

  InputFile& file_;
  std::uint64_t begin_ = 0, packed_left_ = 0, size_ = 0, at_ = 0;
  std::unique_ptr<Unpacker> unpacker_;
  bool checked_ = false;
  std::uint32_t crc_ = 0;
  std::string_view packed_, unpacked_;  // of which nothing was read yet
  std::vector<char> room_, taken_;
  std::string failure_;
};

}  // namespace sandstroke
