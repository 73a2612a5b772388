#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/error.h"

// Every fuzzing target includes this: it defines LLVMFuzzerTestOneInput, and gives the input to what the
// program's commands call.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace sandstroke {

/// An Error is an answer to bad input; whatever else comes out of `use` ends the target, and is a finding.
template <class Use>
void try_input(const Use& use) {
  try {
    use();
  } catch (const Error&) {
  }
}

/// Ends the program if a fact is false that must hold for any input.
inline void require(bool fact) {
  if (!fact) std::abort();
}

inline std::string_view as_text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// The text up to the end of its line, which is taken off it.
inline std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

}  // namespace sandstroke
