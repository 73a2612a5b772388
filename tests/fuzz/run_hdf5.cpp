// A run file: what `info`, `render` and `compare` read, and a scene whose bed starts from it.
#include "io/run_file.h"

#include <fstream>

#include "compare/compare_runs.h"
#include "core/temporary_folder.h"
#include "fuzz.h"
#include "hdf5_edits.h"
#include "io/scene_toml.h"
#include "io/surface_file.h"
#include "run/run_scene.h"

using namespace sandstroke;

namespace {

struct Place {
  TemporaryFolder folder;
  Place() {
    std::ofstream(folder / "line.toml") << "plunge_speed = 10.0\nspeed = 1.0\n[[segment]]\nkind = 'line'\n"
                                           "to = [0.004, 0.0]\ndepth = 0.004\n";
    const SceneFile scene = scene_from_text(
        "[bed]\nsize = [0.08, 0.07]\ncells = [8, 7]\n[stroke]\nfile = 'line.toml'\n[output]\nframes = 500\n",
        "scene.toml");
    RunOptions options;
    options.scene_folder = folder.path();
    options.threads = 1;
    run_scene(scene, folder / "good.h5", options);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Place place;
  const std::filesystem::path good = place.folder / "good.h5", edited = place.folder / "edited.h5";
  write_edited(good, edited, data, size);
  try_input([&] {
    const RunFile run(edited);
    try_input([&] { run.complete(); });
    try_input([&] { run.initial_bed(); });
    try_input([&] { run.provenance(); });
    try_input([&] { scene_from_text(run.scene_text(), "scene"); });
    try_input([&] { compare_runs(RunFile(good), run, Tolerances{}); });
    // A file of a few kilobytes may hold a huge bed that nothing has touched: memory for all its cells is
    // what the machine has, or an error.
    if (static_cast<double>(run.rows()) * run.cols() > 1e6) return;
    try_input([&] {
      const std::size_t count = run.frame_times().size();
      RunFrames frames(run);
      for (std::size_t k = 0; k < count; k += 1 + count / 4)
        try_input([&] { frames.surface(static_cast<int>(k)); });
    });
    try_input([&] {
      BedSettings bed = scene_from_text("[bed]\nsize = [0.08, 0.07]\ncells = [8, 7]\n", "scene.toml").bed;
      bed.surface.kind = SurfaceKind::file;
      bed.surface.file = edited.string();
      load_surface(bed, ".");
    });
  });
  return 0;
}
