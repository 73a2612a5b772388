#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sandstroke {

/// FNV-1a hash, 64 bits, that identifies content (a scene's text, a file's bytes). Not for security.
class ContentHash {
 public:
  void add(const void* bytes, std::size_t count);
  void add(std::string_view text) { add(text.data(), text.size()); }
  std::uint64_t value() const { return state_; }
  /// The value in 16 hexadecimal digits.
  std::string text() const;

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

std::string content_hash(std::string_view text);

/// A number in [0, 1): the same for the same bits, and as good as random between different bits. It is the
/// upper 53 bits of SplitMix64's finaliser (Steele, Lea, Flood, OOPSLA 2014).
inline double unit_hash(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9ULL;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebULL;
  bits ^= bits >> 31;
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

}  // namespace sandstroke
