// A stroke file, recorded or converted: what `run` and `stroke info` read.
#include "core/temporary_folder.h"
#include "fuzz.h"
#include "haptics/recording.h"
#include "hdf5_edits.h"
#include "io/recording_file.h"
#include "io/stroke_file.h"
#include "play.h"

using namespace sandstroke;

namespace {

/// A recording of three samples, so that all columns and attributes are there.
class Example : public Recording {
 public:
  Example() {
    header_.source = "example";
    header_.device.frame = "device";
    header_.device.measures_velocity = true;
    header_.force_limit = 5.0;
    header_.nominal_rate = 1000.0;
  }
  const RecordingHeader& header() const override { return header_; }
  const std::optional<RecordingFooter>& footer() const override { return footer_; }
  std::vector<RecordedSample> next(std::size_t) override {
    std::vector<RecordedSample> samples(given_ ? 0 : 3);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      samples[i].sequence = i;
      samples[i].time = static_cast<std::int64_t>(1000000 * i);
      samples[i].position[0] = 0.001 * static_cast<double>(i);
      samples[i].position[1] = i == 1 ? 0.001 : 0.0;
    }
    given_ = true;
    return samples;
  }

 private:
  RecordingHeader header_;
  std::optional<RecordingFooter> footer_ = RecordingFooter{};
  bool given_ = false;
};

struct Place {
  TemporaryFolder folder;
  Place() {
    Example example;
    write_recording_file(folder / "good.h5", example);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Place place;
  const std::filesystem::path file = place.folder / "edited.h5";
  write_edited(place.folder / "good.h5", file, data, size);
  try_input([&] { read_recording_info(file); });
  try_input([&] { play(read_stroke_file(file)); });
  return 0;
}
