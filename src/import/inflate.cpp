#include "import/inflate.h"

#include <zlib.h>

#include <algorithm>
#include <limits>

namespace sandstroke {

std::optional<std::string> inflated(std::string_view packed, Wrapping wrapping, std::size_t most) {
  z_stream stream{};
  if (inflateInit2(&stream, wrapping == Wrapping::zlib ? MAX_WBITS : -MAX_WBITS) != Z_OK) return {};
  std::string unpacked, block(1 << 16, '\0');
  int state = Z_OK;
  while (state == Z_OK && unpacked.size() <= most) {
    if (stream.avail_in == 0) {
      const std::size_t some = std::min<std::size_t>(packed.size(), std::numeric_limits<uInt>::max());
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
      stream.avail_in = static_cast<uInt>(some);
      packed.remove_prefix(some);
    }
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = static_cast<uInt>(block.size());
    state = inflate(&stream, Z_NO_FLUSH);
    unpacked.append(block, 0, block.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (state != Z_STREAM_END || unpacked.size() > most) return {};
  return unpacked;
}

}  // namespace sandstroke
