#pragma once

#include <cstddef>
#include <string_view>

namespace sandstroke {

struct Utf8Character {
  std::size_t bytes = 0;
  char32_t code = 0;
};

/// The first character of a text. bytes = 0: the text is empty, or does not begin with a character (RFC
/// 3629).
inline Utf8Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {text.empty() ? 0u : 1u, lead};
  if (lead < 0xC0 || lead > 0xF7) return {};
  const std::size_t bytes = lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  unsigned code = lead & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) return {};
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  constexpr unsigned least[] = {0x80, 0x800, 0x10000};  // of 2, 3 and 4 bytes: a smaller code is overlong
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  if (code < least[bytes - 2] || code > 0x10FFFF || surrogate) return {};
  return {bytes, code};
}

}  // namespace sandstroke
