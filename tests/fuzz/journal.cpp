// A recording's journal, through `stroke repair`. Checksums are mended after every mutation: else nothing
// would come past them.
#include "record/journal.h"

#include <cstring>
#include <fstream>

#include "core/hash.h"
#include "core/temporary_folder.h"
#include "fuzz.h"
#include "io/recording_file.h"
#include "io/stroke_file.h"
#include "play.h"

using namespace sandstroke;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

/// See journal.h for what a block is.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  constexpr std::size_t start = 24, kind_and_length = 8, frame = 16;
  size = LLVMFuzzerMutate(data, size, most);
  if (seed % 8 == 0) return size;
  for (std::size_t block = start; size >= frame && block <= size - frame;) {
    std::uint32_t length;
    std::memcpy(&length, data + block + 4, sizeof length);
    if (length > size - block - frame) break;
    ContentHash hash;
    hash.add(data + block, kind_and_length);
    hash.add(data + block + frame, length);
    const std::uint64_t checksum = hash.value();
    std::memcpy(data + block + kind_and_length, &checksum, sizeof checksum);
    block += frame + length;
  }
  return size;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const TemporaryFolder folder;
  const std::filesystem::path file = folder / "stroke.h5.recording", output = folder / "stroke.h5";
  std::ofstream(file, std::ios::binary) << as_text(data, size);
  try_input([&] {
    JournalReader journal(file);
    const RecordingInfo written = write_recording_file(output, journal);
    journal.lost_bytes();
    const std::optional<RecordingInfo> read = read_recording_info(output);
    require(read && read->header.source == written.header.source);
    play(read_stroke_file(output));
  });
  return 0;
}
