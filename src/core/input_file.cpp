#include "core/input_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "core/hash.h"

namespace sandstroke {
namespace fs = std::filesystem;

InputFile::InputFile(const fs::path& path, Pipe pipe) : name_(path.string()) {
  const fs::file_status status = fs::status(path);
  if (fs::is_directory(status)) throw_io_error("{}: is a folder; name a file", name_);
  if (fs::exists(status) && !fs::is_regular_file(status) && !(pipe == Pipe::taken && fs::is_fifo(status)))
    throw_io_error("{}: is not a regular file; name a regular file", name_);
  file_ = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0) throw_io_error("{}: cannot be opened ({}); check the path", name_, std::strerror(errno));
}

InputFile::~InputFile() { close(file_); }

std::string_view InputFile::next_block() {
  if (!rest_.empty()) return std::exchange(rest_, {});
  block_.resize(1 << 16);
  while (true) {
    const ssize_t count = ::read(file_, block_.data(), block_.size());
    if (count >= 0) {
      block_begin_ = std::exchange(block_end_, block_end_ + static_cast<std::uint64_t>(count));
      return {block_.data(), static_cast<std::size_t>(count)};
    }
    if (errno != EINTR)
      throw_io_error("{}: cannot be read ({}); check the disk, or take another copy of the file", name_,
                     std::strerror(errno));
  }
}

std::size_t InputFile::read(void* bytes, std::size_t count) {
  std::size_t done = 0;
  while (done < count) {
    const std::string_view block = next_block();
    if (block.empty()) break;
    const std::size_t taken = std::min(count - done, block.size());
    std::memcpy(static_cast<char*>(bytes) + done, block.data(), taken);
    rest_ = block.substr(taken);
    done += taken;
  }
  return done;
}

void InputFile::seek(std::uint64_t byte) {
  if (byte >= block_begin_ && byte <= block_end_) {
    rest_ = {block_.data() + (byte - block_begin_), block_end_ - byte};
    return;
  }
  if (lseek(file_, static_cast<off_t>(byte), SEEK_SET) < 0)
    throw_io_error("{}: byte {} cannot be reached ({}); take another copy of the file", name_, byte,
                   std::strerror(errno));
  block_begin_ = block_end_ = byte;
  rest_ = {};
}

bool is_pipe(const fs::path& path) {
  std::error_code not_there;
  return fs::is_fifo(path, not_there);
}

fs::path folder_of(const fs::path& path) {
  std::error_code not_there;
  const bool nameless = is_pipe(path) && fs::canonical(path, not_there).empty();
  return nameless ? fs::path() : path.parent_path();
}

void check_readable(const fs::path& path) { const InputFile opens(path); }

void check_can_be_read_whole(const fs::path& path) {
  InputFile file(path);
  while (!file.next_block().empty()) {
  }
}

std::string beginning_of(const fs::path& path, std::size_t most_bytes) {
  std::string bytes(most_bytes, '\0');
  bytes.resize(InputFile(path).read(bytes.data(), bytes.size()));
  return bytes;
}

bool begins_with(const fs::path& path, std::string_view signature) {
  return beginning_of(path, signature.size()) == signature;
}

std::string read_text_file(const fs::path& path, std::size_t most_bytes) {
  InputFile file(path, InputFile::Pipe::taken);
  std::string text;
  for (std::string_view block = file.next_block(); !block.empty(); block = file.next_block()) {
    text += block;
    if (text.size() <= most_bytes) continue;
    const bool has_size = fs::is_regular_file(path);  // a pipe has none
    throw_input_error(
        "{}: has {} MB, but a text file may have at most {:g} MB; shorten it (a long stroke can be a table "
        "of samples: sandstroke stroke convert --help)",
        path.string(),
        has_size ? fmt::format("{:.1f}", 1e-6 * static_cast<double>(fs::file_size(path))) : "too many",
        1e-6 * static_cast<double>(most_bytes));
  }
  return text;
}

std::string file_hash(const fs::path& path) {
  InputFile file(path);
  ContentHash hash;
  for (std::string_view block = file.next_block(); !block.empty(); block = file.next_block()) hash.add(block);
  return hash.text();
}

}  // namespace sandstroke
