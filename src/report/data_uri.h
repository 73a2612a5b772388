#pragma once

#include <string>
#include <string_view>

namespace sandstroke {

/// Bytes as text, in the alphabet of RFC 4648, section 4, padded with "=". A page reads them with atob().
std::string base64(std::string_view bytes);

/// A file that the page itself holds, for an image's src. type: "image/png", say.
std::string data_uri(std::string_view type, std::string_view bytes);

}  // namespace sandstroke
