// A scene: lines of --set assignments, a line of dashes, and the scene's text.
#include "io/scene_toml.h"

#include "fuzz.h"
#include "measure/error_estimate.h"
#include "play.h"

using namespace sandstroke;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try_input([&] {
    std::string_view text = as_text(data, size);
    std::vector<std::string> overrides;
    if (text.find("\n---\n") != std::string_view::npos)
      for (std::string_view line = take_line(text); line != "---"; line = take_line(text))
        overrides.emplace_back(line);

    const SceneFile scene = scene_from_text(std::string(text), "scene.toml", overrides);
    const std::string written = scene_text(scene);
    bool same = false;
    try_input([&] { same = scene_text(scene_from_text(written, "written.toml")) == written; });
    require(same);
    for (const SecondSolution which : {SecondSolution::coarser, SecondSolution::finer})
      try_input([&] { second_scene(scene, which); });
    play(scene);
  });
  return 0;
}
