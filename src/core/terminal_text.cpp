#include "core/terminal_text.h"

#include <spdlog/fmt/fmt.h>

#include "core/utf8.h"

namespace sandstroke {
namespace {

bool controls_terminal(char32_t code) {
  const auto within = [code](char32_t first, char32_t last) { return code >= first && code <= last; };
  return code < 0x20 || within(0x7F, 0x9F) || within(0x202A, 0x202E) || within(0x2066, 0x2069);
}

std::string escaped(std::string_view text, std::string_view kept) {
  std::string result;
  while (!text.empty()) {
    const auto [bytes, code] = first_character(text);
    if (bytes == 0)
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    else if (controls_terminal(code) && kept.find(text.front()) == kept.npos)
      result += code < 0x80 ? fmt::format("\\x{:02x}", static_cast<unsigned>(code))
                            : fmt::format("\\u{:04x}", static_cast<unsigned>(code));
    else
      result += text.substr(0, bytes);
    text.remove_prefix(bytes == 0 ? 1 : bytes);
  }
  return result;
}

}  // namespace

std::string terminal_text(std::string_view text) { return escaped(text, "\n\t"); }

std::string terminal_line(std::string_view line) { return escaped(line, "\t"); }

}  // namespace sandstroke
