#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

namespace sandstroke {

/// How bytes are packed: LZ4 frames, Zstandard frames, bzip2.
enum class Packing { none, lz4, zstd, bz2 };

/// Unpacks bytes piece by piece, in little memory.
class Unpacker {
 public:
  struct Step {
    std::size_t taken = 0, given = 0;  ///< bytes
    const char* failure = nullptr;     ///< what is wrong with the packed bytes
  };
  virtual ~Unpacker() = default;
  /// Unpacks the beginning of `packed` to at most `room` bytes. The rest of `packed` must be given again.
  virtual Step step(std::string_view packed, char* unpacked, std::size_t room) = 0;
};

/// None for Packing::none.
std::unique_ptr<Unpacker> make_unpacker(Packing packing);

}  // namespace sandstroke
