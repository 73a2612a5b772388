#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sandstroke {

/// FNV-1a, 64 bits: names content (a scene's text, a file's bytes). Not for security.
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

}  // namespace sandstroke
