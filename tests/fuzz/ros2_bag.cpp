// A ROS 2 bag: an SQLite file of which bytes are changed.
#include "import/ros2_bag.h"

#include <fstream>

#include "core/temporary_folder.h"
#include "samples.h"

using namespace sandstroke;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const TemporaryFolder folder;
  const std::filesystem::path file = folder / "bag.db3";
  std::ofstream(file, std::ios::binary) << as_text(data, size);
  try_input([&] { require_sound(read_ros2_bag(file, "/tool")); });
  return 0;
}
