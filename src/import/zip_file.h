#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sandstroke {

/// A file in a zip archive.
struct ZipMember {
  std::string name;
  std::uint16_t method = 0;  ///< 0: stored, 8: deflated
  bool is_encrypted = false;
  std::uint32_t checksum = 0;                        ///< CRC-32 of the unpacked bytes
  std::uint64_t packed = 0, unpacked = 0, head = 0;  ///< bytes; where its own header begins
};

/// The files in the bytes of a zip archive, also of more than 4 GB (zip64). label: stands for the archive in
/// messages. Error: input, if it is damaged or has more than 10,000 files. Source: PKWARE, APPNOTE 6.3.
std::vector<ZipMember> zip_members(std::string_view archive, const std::string& label);

/// Unpacks a file and compares its checksum. Error: input, if it is damaged, unpacks to more than `most`
/// bytes, is encrypted, or is packed by anything but deflate.
std::string zip_unpacked(std::string_view archive, const ZipMember& member, std::size_t most,
                         const std::string& label);

}  // namespace sandstroke
