#include "io/source_path.h"

#include "core/error.h"
#include "io/stroke_file.h"

namespace sandstroke {

std::vector<SourceSettings> with_paths(std::vector<SourceSettings> sources,
                                       const std::filesystem::path& folder) {
  for (SourceSettings& source : sources) {
    if (source.path.empty() || source.stroke) continue;
    const std::filesystem::path file = folder / source.path;
    if (stroke_depends_on_force(file))
      throw_input_error("{}: presses by a force, which a nozzle does not have; give a path with heights",
                        file.string());
    source.stroke = std::make_shared<const Stroke>(load_stroke(file, ForceSettings{}, TableSettings{}));
  }
  return sources;
}

}  // namespace sandstroke
