#include "record/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "core/error.h"
#include "core/hash.h"
#include "core/output_file.h"
#include "record/recording_json.h"

namespace sandstroke {
namespace fs = std::filesystem;
namespace {

static_assert(std::endian::native == std::endian::little, "numbers go into the journal as they are");

constexpr std::string_view signature = "sandstroke.recording";
constexpr std::uint32_t format_version = 2;
constexpr std::size_t first_sample_bytes = 96;  // in version 1: without the fields added at its end

enum BlockKind : std::uint32_t { header_block = 1, sample_block = 2, footer_block = 3 };

struct BlockFrame {
  std::uint32_t kind = 0, length = 0;
  std::uint64_t checksum = 0;
};
static_assert(sizeof(BlockFrame) == 16);
static_assert(journal_sample_bytes == sizeof(BlockFrame) + sizeof(RecordedSample));

std::uint64_t checksum(const BlockFrame& frame, const void* content) {
  ContentHash hash;
  hash.add(&frame.kind, sizeof frame.kind);
  hash.add(&frame.length, sizeof frame.length);
  hash.add(content, frame.length);
  return hash.value();
}

void put_block(std::string& blocks, BlockKind kind, const void* content, std::size_t length) {
  BlockFrame frame{kind, static_cast<std::uint32_t>(length), 0};
  frame.checksum = checksum(frame, content);
  blocks.append(reinterpret_cast<const char*>(&frame), sizeof frame);
  blocks.append(static_cast<const char*>(content), length);
}

/// Names of devices and files may not be UTF-8: invalid bytes are replaced.
template <class Part>
void put_block(std::string& blocks, BlockKind kind, const Part& part) {
  const std::string text = as_json(part).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  put_block(blocks, kind, text.data(), text.size());
}

/// Locks a finished journal for reading.
FileLock share_finished(const fs::path& path) {
  std::optional<FileLock> lock = FileLock::try_share(path);
  if (!lock)
    throw_io_error(
        "{}: is still being recorded; wait until the recording ends, or end the program that records it",
        path.string());
  return std::move(*lock);
}

}  // namespace

fs::path journal_path(const fs::path& stroke_file) {
  fs::path journal = stroke_file;
  journal += journal_extension;
  return journal;
}

void check_no_journal(const fs::path& path) {
  if (!fs::exists(path)) return;
  if (fs::is_regular_file(path)) share_finished(path);
  throw_io_error(
      "{}: already exists and is a recording that was cut off; turn it into a stroke (sandstroke stroke "
      "repair {}) and remove it, or choose another name",
      path.string(), path.string());
}

// --- JournalWriter ---

JournalWriter::JournalWriter(const fs::path& path, const RecordingHeader& header)
    : path_(path), file_(open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666)) {
  if (file_ < 0) {
    const int error = errno;
    if (error == EEXIST) check_no_journal(path);
    fail(error);
  }
  try {
    lock_ = FileLock::wait_and_take(path);  // the file is new: others only ask whose it is
    std::string begin(signature);
    begin.append(reinterpret_cast<const char*>(&format_version), sizeof format_version);
    put_block(begin, header_block, header);
    write(begin, begin.size());
    sync();
    sync_folder_of(path);
  } catch (...) {
    unlink(path.c_str());  // it is empty, and would be in the way of the next recording
    close(file_);
    throw;
  }
}

JournalWriter::~JournalWriter() {
  if (file_ >= 0) close(file_);
}

void JournalWriter::fail(int error) const {
  throw_io_error("{}: cannot be written ({}); free disk space or choose another place", path_.string(),
                 std::strerror(error));
}

void JournalWriter::write(const std::string& blocks, std::size_t block_size) {
  std::size_t done = 0;
  while (done < blocks.size()) {
    const ssize_t taken =
        pwrite(file_, blocks.data() + done, blocks.size() - done, static_cast<off_t>(size_ + done));
    if (taken > 0) done += static_cast<std::size_t>(taken);
    if (taken > 0 || (taken < 0 && errno == EINTR)) continue;
    const int error = taken < 0 ? errno : ENOSPC;
    size_ += done - done % block_size;
    // If half a block cannot be cut off, the reader finds it there, and the next write goes over it.
    [[maybe_unused]] const int cut = ftruncate(file_, static_cast<off_t>(size_));
    fail(error);
  }
  size_ += done;
}

void JournalWriter::append(std::span<const RecordedSample> samples) {
  blocks_.clear();
  for (const RecordedSample& sample : samples) put_block(blocks_, sample_block, &sample, sizeof sample);
  const std::uint64_t begin = size_;
  const auto count = [&] { samples_ += static_cast<std::int64_t>((size_ - begin) / journal_sample_bytes); };
  try {
    write(blocks_, journal_sample_bytes);
  } catch (...) {
    count();
    throw;
  }
  count();
}

void JournalWriter::sync() {
  if (fdatasync(file_) < 0) fail(errno);
  if (!still_named(file_, path_))
    throw_io_error("{}: this file was removed or replaced during the recording", path_.string());
}

void JournalWriter::finish(const RecordingFooter& footer) {
  std::string block;
  put_block(block, footer_block, footer);
  write(block, block.size());
  sync();
  lock_.reset();
}

// --- JournalReader ---

struct JournalReader::Block {
  std::uint32_t kind = 0;
  std::string content;
};

JournalReader::JournalReader(const fs::path& path) : name_(path.string()), file_(path) {
  lock_ = share_finished(path);
  size_ = fs::file_size(path);

  char begin[signature.size()] = {};
  if (!read(begin, sizeof begin) || std::string_view(begin, sizeof begin) != signature)
    throw_input_error("{}: is not the journal of a recording; name another file", name_);
  std::uint32_t version = format_version;
  const bool has_version = read(&version, sizeof version);
  if (version < 1 || version > format_version)
    throw_input_error(
        "{}: has journal format {}, and this program reads format {}; use a newer version of sandstroke",
        name_, version, format_version);
  sound_ = sizeof begin + sizeof version;
  try {
    const std::optional<Block> block = has_version ? read_block() : std::nullopt;
    if (block && block->kind == header_block) {
      header_ = header_from_json(nlohmann::ordered_json::parse(block->content));
      return;
    }
  } catch (const nlohmann::json::exception&) {  // treated as cut off
  }
  throw_input_error("{}: its header is cut off or damaged, and it has no samples; remove it", name_);
}

bool JournalReader::read(void* bytes, std::size_t count) { return file_.read(bytes, count) == count; }

std::optional<JournalReader::Block> JournalReader::read_block() {
  BlockFrame frame;
  // A damaged length may be any number. No memory is taken for more bytes than the file has.
  if (size_ - sound_ < sizeof frame || !read(&frame, sizeof frame)) return std::nullopt;
  if (frame.length > size_ - sound_ - sizeof frame) return std::nullopt;
  Block block{frame.kind, std::string(frame.length, '\0')};
  if (!read(block.content.data(), frame.length)) return std::nullopt;
  if (checksum(frame, block.content.data()) != frame.checksum) return std::nullopt;
  sound_ += sizeof frame + frame.length;
  return block;
}

std::vector<RecordedSample> JournalReader::next(std::size_t most) {
  std::vector<RecordedSample> samples;
  while (!at_end_ && samples.size() < most) {
    const std::uint64_t begin = sound_;
    const std::optional<Block> block = read_block();
    at_end_ = true;  // unless the block is a sound sample
    if (!block) break;
    const std::size_t length = block->content.size();
    if (block->kind == sample_block && (length == sizeof(RecordedSample) || length == first_sample_bytes)) {
      RecordedSample sample;
      std::memcpy(&sample, block->content.data(), length);
      const auto sequence = static_cast<std::int64_t>(sample.sequence);
      if (sequence > last_sequence_ && sequence < most_ticks && sample.time > last_time_) {
        last_sequence_ = sequence;
        last_time_ = sample.time;
        samples.push_back(sample);
        at_end_ = false;
        continue;
      }
    } else if (block->kind == footer_block) {
      try {
        footer_ = footer_from_json(nlohmann::ordered_json::parse(block->content));
        continue;
      } catch (const nlohmann::json::exception&) {  // damaged
      }
    }
    sound_ = begin;
  }
  return samples;
}

}  // namespace sandstroke
