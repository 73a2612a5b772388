// An MCAP file, of which bytes are changed.
#include "import/mcap.h"

#include <fstream>

#include "core/temporary_folder.h"
#include "samples.h"

using namespace sandstroke;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const TemporaryFolder folder;
  const std::filesystem::path file = folder / "a.mcap";
  std::ofstream(file, std::ios::binary) << as_text(data, size);
  for (const char* part : {"", "/tool", "/tf:tool"}) try_input([&] { require_sound(read_mcap(file, part)); });
  return 0;
}
