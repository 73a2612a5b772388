#include "core/xml_text.h"

#include <string_view>

#include "core/utf8.h"

namespace sandstroke {
namespace {

/// Bytes of the first character of a UTF-8 text. 0: it is not valid, or XML has no such character.
std::size_t character_bytes(std::string_view text) {
  const auto [bytes, code] = first_character(text);
  return code < 0x20 || (code & ~1u) == 0xFFFE ? 0 : bytes;
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t bytes = character_bytes(text);
    switch (text.front()) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&apos;";
        break;
      case '\n':
        result += "&#10;";
        break;
      case '\t':
        result += "&#9;";
        break;
      default:
        result += bytes == 0 ? "?" : text.substr(0, bytes);
    }
    text.remove_prefix(bytes == 0 ? 1 : bytes);
  }
  return result;
}

}  // namespace sandstroke
