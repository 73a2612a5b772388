#include "core/hash.h"

#include <spdlog/fmt/fmt.h>

namespace sandstroke {

void ContentHash::add(const void* bytes, std::size_t count) {
  const auto* byte = static_cast<const unsigned char*>(bytes);
  for (std::size_t i = 0; i < count; ++i) state_ = (state_ ^ byte[i]) * 0x100000001b3ULL;
}

std::string ContentHash::text() const { return fmt::format("{:016x}", state_); }

std::string content_hash(std::string_view text) {
  ContentHash hash;
  hash.add(text);
  return hash.text();
}

}  // namespace sandstroke
