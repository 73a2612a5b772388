// A sweep's plan, beside a scene and strokes of every kind.
#include "sweep/sweep_plan.h"

#include <fstream>

#include "core/temporary_folder.h"
#include "fuzz.h"
#include "io/stroke_file.h"

using namespace sandstroke;

namespace {

/// The folder of the plans, with what they can name.
struct Place {
  TemporaryFolder folder;
  Place() {
    const std::string script = "[[segment]]\nkind = 'line'\nto = [0.1, 0.0]\ndepth = 0.01\n";
    std::ofstream(folder / "scene.toml") << "[bed]\ncells = [64, 64]\n[tool]\nradius = 0.1\n"
                                            "[stroke]\nfile = 'a.toml'\n";
    std::ofstream(folder / "a.toml") << script;
    std::ofstream(folder / "b.toml") << script;
    Stroke stroke;
    stroke.time = {0.0};
    stroke.position = {Eigen::Vector3d::Zero()};
    write_stroke_file(folder / "c.h5", stroke);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Place place;
  const std::filesystem::path file = place.folder / "plan.toml";
  std::ofstream(file, std::ios::binary) << as_text(data, size);
  try_input([&] {
    const SweepPlan plan = load_plan(file);
    const std::size_t points = plan.design.points();
    for (std::size_t point = 0; point < points; point += 1 + points / 50)
      try_input([&] { plan.scene_of(point); });
    for (const SweepAxis& axis : plan.design.axes)
      for (std::size_t value = 0; value < axis.values.size(); ++value) {
        axis.label(value);
        axis.number(value);
      }
    plan.design.shape();
  });
  return 0;
}
