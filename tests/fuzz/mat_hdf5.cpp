// A MATLAB file of version 7.3, which is an HDF5 file.
#include "import/mat.h"

#include <vector>

#include "core/temporary_folder.h"
#include "hdf5/hdf5_writer.h"
#include "hdf5_edits.h"
#include "samples.h"

using namespace sandstroke;

namespace {

struct Place {
  TemporaryFolder folder;
  Place() {
    Hdf5Writer file(folder / "good.h5");
    const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    file.write("/t", std::vector<double>{0, 1, 2, 3});
    file.write("/s/pos", points);
    file.write("/s/in/force", points);
    file.write("/on", std::vector<std::uint8_t>{0, 1, 1, 0});
    for (const char* name : {"/t", "/s/pos", "/s/in/force"})
      file.attribute(name, "MATLAB_class", std::string("double"));
    file.attribute("/on", "MATLAB_class", std::string("logical"));
    file.attribute("/s", "MATLAB_class", std::string("struct"));
    file.attribute("/t", "MATLAB_empty", std::uint8_t{0});
    file.finish();
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Place place;
  const std::filesystem::path file = place.folder / "edited.mat";
  write_edited(place.folder / "good.h5", file, data, size);
  try_input([&] { require_sound(read_mat(file)); });
  return 0;
}
