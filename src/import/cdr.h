#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sandstroke {

/// Reads a message of ROS 2 from its bytes: CDR of DDS (OMG DDS-XTypes 1.3, 7.4), plain, version 1 or 2, in
/// either byte order. A number is aligned to its size, counted from the end of the header (in version 2 to at
/// most 4 bytes). If there are too few bytes, it returns 0 from then on and is not sound.
class CdrReader {
 public:
  explicit CdrReader(std::string_view bytes);

  std::uint32_t integer();  ///< of 32 bits
  double number();          ///< of 64 bits
  void pass_text();         ///< a string
  bool sound() const { return sound_; }

 private:
  std::uint64_t next(std::size_t size);

  std::string_view body_;
  std::size_t at_ = 0, most_alignment_ = 8;
  bool little_endian_ = true, sound_ = true;
};

}  // namespace sandstroke
