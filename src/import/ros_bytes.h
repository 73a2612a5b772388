#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sandstroke {

/// How a message is made into bytes: CDR in ROS 2, and an own way in ROS 1.
enum class RosEncoding { cdr, ros1 };

/// Reads the fields of a message from its bytes.
/// CDR (OMG DDS-XTypes 1.3, 7.4) is taken plain, version 1 or 2, in either byte order. A number is aligned to
/// its size, counted from the end of the header (in version 2 to at most 4 bytes). In ROS 1
/// (wiki.ros.org/msg) numbers are little-endian, and nothing is aligned.
/// If there are too few bytes, it returns 0 from then on and is not sound.
class RosReader {
 public:
  RosReader(std::string_view bytes, RosEncoding encoding);

  std::uint32_t integer();            ///< of 32 bits
  double number();                    ///< of 64 bits
  std::int64_t stamp();               ///< a time [ns]
  std::string_view text();            ///< a string, as long as the bytes live
  std::uint32_t count_of_messages();  ///< at the beginning of a list of messages
  bool sound() const { return sound_; }
  bool at_end() const { return at_ == body_.size(); }

 private:
  std::uint64_t next(std::size_t size);

  RosEncoding encoding_;
  std::string_view body_;
  std::size_t at_ = 0, most_alignment_ = 8;
  bool little_endian_ = true, sound_ = true;
};

}  // namespace sandstroke
