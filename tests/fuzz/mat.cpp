// A MATLAB file of version 4 to 7.
#include "import/mat.h"

#include <fstream>

#include "core/temporary_folder.h"
#include "hdf5/hdf5_handle.h"
#include "samples.h"

using namespace sandstroke;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const TemporaryFolder folder;
  const std::string_view bytes = as_text(data, size);
  if (bytes.find(hdf5_signature) != std::string_view::npos) return -1;  // mat_hdf5 has these
  const std::filesystem::path file = folder / "variables.mat";
  std::ofstream(file, std::ios::binary) << bytes;
  try_input([&] { require_sound(read_mat(file)); });
  return 0;
}
