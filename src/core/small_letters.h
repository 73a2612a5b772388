#pragma once

#include <cctype>
#include <string>

namespace sandstroke {

/// A letter of ASCII as a small one; others stay.
inline char small_letter(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

inline std::string small_letters(std::string text) {
  for (char& c : text) c = small_letter(c);
  return text;
}

}  // namespace sandstroke
