#pragma once

#include <cstddef>
#include <string_view>

// Files embedded in the program by assembler (asset.inc). SANDSTROKE_DECLARE_ASSET(name) declares one, at
// global scope; SANDSTROKE_ASSET(name) is its content, a string_view.
#define SANDSTROKE_DECLARE_ASSET(name)             \
  extern "C" const char sandstroke_asset_##name[]; \
  extern "C" const char sandstroke_asset_##name##_end[]
#define SANDSTROKE_ASSET(name) \
  sandstroke::embedded_text(sandstroke_asset_##name, sandstroke_asset_##name##_end)

namespace sandstroke {

inline std::string_view embedded_text(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace sandstroke
