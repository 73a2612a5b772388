// A NumPy array, or an archive of some.
#include <fstream>

#include "core/temporary_folder.h"
#include "import/npy.h"
#include "import/npz.h"
#include "samples.h"

using namespace sandstroke;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const TemporaryFolder folder;
  const std::string_view bytes = as_text(data, size);
  const std::filesystem::path file = folder / "array";
  std::ofstream(file, std::ios::binary) << bytes;
  try_input([&] {
    if (bytes.starts_with("\x93NUMPY"))
      require_sound(read_npy(file));
    else
      require_sound(read_npz(file));
  });
  return 0;
}
