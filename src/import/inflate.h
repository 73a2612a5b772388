#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sandstroke {

/// What is around packed bytes: zlib's header and checksum, or nothing.
enum class Wrapping { zlib, none };

/// Unpacks one whole stream of deflate. None: it is damaged or cut off, or unpacks to more than `most` bytes.
std::optional<std::string> inflated(std::string_view packed, Wrapping wrapping, std::size_t most);

}  // namespace sandstroke
