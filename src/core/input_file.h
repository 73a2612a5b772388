#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sandstroke {

/// A regular file, read from its beginning. Error: io, where it cannot be opened, or its next bytes cannot be
/// read: a file that the disk does not give back never looks like a shorter one.
class InputFile {
 public:
  /// A device has no end, and a pipe may have none: that is for who names one to know.
  enum class Pipe { refused, taken };
  explicit InputFile(const std::filesystem::path& path, Pipe pipe = Pipe::refused);
  InputFile(const InputFile&) = delete;
  ~InputFile();
  /// Reads so many bytes, fewer only where the file ends. How many there were.
  std::size_t read(void* bytes, std::size_t count);
  /// The next bytes, there until the next call; none at the end of the file.
  std::string_view next_block();

 private:
  std::string name_;
  int file_ = -1;
  std::vector<char> block_;
  std::string_view rest_;  // of the block: not given out yet
};

/// Error: io, unless it is a regular file that can be opened.
void check_readable(const std::filesystem::path& path);

/// Error: io, unless the disk gives back all of it.
void check_can_be_read_whole(const std::filesystem::path& path);

/// Error: io.
bool begins_with(const std::filesystem::path& path, std::string_view signature);

/// Of what somebody wrote: a scene, a script, a plan. [bytes]
inline constexpr std::size_t most_text_bytes = 10'000'000;

/// Reads a whole text file, or pipe. Error: io, with what to do; input, where it has more than most_bytes.
std::string read_text_file(const std::filesystem::path& path, std::size_t most_bytes = most_text_bytes);

/// content_hash() of a file's bytes, of any size. Error: io.
std::string file_hash(const std::filesystem::path& path);

}  // namespace sandstroke
