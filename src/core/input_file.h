#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sandstroke {

/// A regular file, read from its beginning. Error: io, if it cannot be opened or its next bytes cannot be
/// read. A file with a disk error therefore never looks like a shorter one.
class InputFile {
 public:
  /// Whether a named pipe is accepted. It may have no end: its user must know. Devices are always refused.
  enum class Pipe { refused, taken };
  explicit InputFile(const std::filesystem::path& path, Pipe pipe = Pipe::refused);
  InputFile(const InputFile&) = delete;
  ~InputFile();
  /// Reads `count` bytes, fewer only at the end of the file. Returns how many.
  std::size_t read(void* bytes, std::size_t count);
  /// Goes on reading at a byte of the file, counted from 0; behind its end there is nothing to read.
  void seek(std::uint64_t byte);
  /// The next bytes, valid until the next call; empty at the end of the file.
  std::string_view next_block();

 private:
  std::string name_;
  int file_ = -1;
  std::vector<char> block_;
  std::uint64_t block_begin_ = 0, block_end_ = 0;  // where the block lies in the file
  std::string_view rest_;                          // the part of the block that was not given out yet
};

/// True for a pipe: it can be read only once.
bool is_pipe(const std::filesystem::path& path);

/// The folder to which the names in a file are relative: the file's own. The current one for a pipe without a
/// name, as /dev/stdin and what a shell makes of <(command).
std::filesystem::path folder_of(const std::filesystem::path& path);

/// Error: io, unless it is a regular file that can be opened.
void check_readable(const std::filesystem::path& path);

/// Reads the whole file once. Error: io, if the disk does not give it back.
void check_can_be_read_whole(const std::filesystem::path& path);

/// The first bytes of a file, at most so many. Error: io.
std::string beginning_of(const std::filesystem::path& path, std::size_t most_bytes);

/// Error: io.
bool begins_with(const std::filesystem::path& path, std::string_view signature);

/// Most bytes of a text that a person wrote: a scene, a script, a plan.
inline constexpr std::size_t most_text_bytes = 10'000'000;

/// Reads a whole text file or pipe. Error: io; input, if it has more than most_bytes.
std::string read_text_file(const std::filesystem::path& path, std::size_t most_bytes = most_text_bytes);

/// content_hash() of a file's bytes, of any size. Error: io.
std::string file_hash(const std::filesystem::path& path);

}  // namespace sandstroke
