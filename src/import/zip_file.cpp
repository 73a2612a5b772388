#include "import/zip_file.h"

#include <zlib.h>

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "import/inflate.h"

namespace sandstroke {
namespace {

/// The record at a place of the archive. Reading in_zip64 its bytes is refused.
class ZipRecord {
 public:
  ZipRecord(std::string_view archive, std::uint64_t begin, std::size_t least, const std::string& label)
      : bytes_(begin < archive.size() ? archive.substr(begin) : ""), label_(label) {
    if (bytes_.size() < least) refuse();
  }

  [[noreturn]] void refuse() const {
    throw_input_error("{}: is a damaged or cut off zip archive; save it again", label_);
  }

  std::uint64_t number(std::size_t at, std::size_t size) const {
    const std::string_view digits = text(at, size);
    std::uint64_t value = 0;
    for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(digits[i]);
    return value;
  }
  std::string_view text(std::size_t at, std::uint64_t size) const {
    if (at > bytes_.size() || size > bytes_.size() - at) refuse();
    return bytes_.substr(at, size);
  }

 private:
  std::string_view bytes_;
  const std::string& label_;
};

constexpr std::size_t zip_end_bytes = 22, zip_locator_bytes = 20, zip64_end_bytes = 56, zip_entry_bytes = 46,
                      zip_head_bytes = 30;
constexpr std::uint32_t in_zip64 = 0xFFFFFFFF;  // the number is in the part for large files

/// Where the list of files begins, and how many there are.
struct Directory {
  std::uint64_t begin = 0, count = 0;
};

Directory directory_of(std::string_view archive, const std::string& label) {
  constexpr std::size_t longest_comment = 0xFFFF;
  const std::size_t tail = archive.size() - std::min(archive.size(), zip_end_bytes + longest_comment);
  const std::size_t found = archive.substr(tail).rfind("PK\x05\x06");
  const std::uint64_t at = found == std::string_view::npos ? archive.size() : tail + found;
  const ZipRecord end(archive, at, zip_end_bytes, label);
  Directory directory{end.number(16, 4), end.number(10, 2)};
  if (at >= zip_locator_bytes && archive.substr(at - zip_locator_bytes).starts_with("PK\x06\x07")) {
    const ZipRecord locator(archive, at - zip_locator_bytes, zip_locator_bytes, label);
    const ZipRecord end64(archive, locator.number(8, 8), zip64_end_bytes, label);
    if (end64.text(0, 4) != "PK\x06\x06") end64.refuse();
    directory = {end64.number(48, 8), end64.number(32, 8)};
  }
  return directory;
}

/// Takes the numbers that are too large for 4 bytes from the entry's part for large files.
void take_large_numbers(const ZipRecord& entry, std::size_t begin, std::size_t size, ZipMember& member) {
  for (std::size_t at = begin, end = begin + size; at + 4 <= end;) {
    const std::uint64_t kind = entry.number(at, 2), bytes = entry.number(at + 2, 2);
    std::size_t from = at + 4;
    for (std::uint64_t* number : {&member.unpacked, &member.packed, &member.head})
      if (kind == 1 && *number == in_zip64) {
        *number = entry.number(from, 8);
        from += 8;
      }
    at += 4 + bytes;
  }
}

}  // namespace

std::vector<ZipMember> zip_members(std::string_view archive, const std::string& label) {
  const Directory directory = directory_of(archive, label);
  constexpr std::uint64_t most = 10'000;
  if (directory.count > most)
    throw_input_error("{}: has {} files, but at most {} are read; save only the arrays of one stroke", label,
                      directory.count, most);
  std::vector<ZipMember> members;
  std::uint64_t at = directory.begin;
  for (std::uint64_t i = 0; i < directory.count; ++i) {
    const ZipRecord entry(archive, at, zip_entry_bytes, label);
    if (entry.text(0, 4) != "PK\x01\x02") entry.refuse();
    const std::uint64_t name = entry.number(28, 2), extra = entry.number(30, 2),
                        comment = entry.number(32, 2);
    ZipMember member{std::string(entry.text(zip_entry_bytes, name)),
                     static_cast<std::uint16_t>(entry.number(10, 2)),
                     (entry.number(8, 2) & 1) != 0,
                     static_cast<std::uint32_t>(entry.number(16, 4)),
                     entry.number(20, 4),
                     entry.number(24, 4),
                     entry.number(42, 4)};
    take_large_numbers(entry, zip_entry_bytes + name, extra, member);
    members.push_back(std::move(member));
    at += zip_entry_bytes + name + extra + comment;
  }
  return members;
}

std::string zip_unpacked(std::string_view archive, const ZipMember& member, std::size_t most,
                         const std::string& label) {
  constexpr std::uint16_t stored = 0, deflated = 8;
  if (member.is_encrypted || (member.method != stored && member.method != deflated))
    throw_input_error("{}: {} is encrypted or packed in an unknown way; save it again: numpy.savez", label,
                      member.name);
  const ZipRecord head(archive, member.head, zip_head_bytes, label);
  if (head.text(0, 4) != "PK\x03\x04") head.refuse();
  const std::string_view packed =
      head.text(zip_head_bytes + head.number(26, 2) + head.number(28, 2), member.packed);
  std::optional<std::string> unpacked =
      member.method == stored ? std::optional(std::string(packed)) : inflated(packed, Wrapping::none, most);
  const auto checksum = [](const std::string& bytes) {
    return crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  };
  if (!unpacked || unpacked->size() != member.unpacked || checksum(*unpacked) != member.checksum)
    throw_input_error("{}: {} is damaged: its checksum or size is not right; save it again", label,
                      member.name);
  return std::move(*unpacked);
}

}  // namespace sandstroke
