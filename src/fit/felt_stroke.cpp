#include "fit/felt_stroke.h"

#include "core/error.h"
#include "import/sample_files.h"
#include "io/scene_toml.h"
#include "io/surface_file.h"
#include "run/run_scene.h"

namespace sandstroke {

FeltStroke felt_stroke(const Scene& asked, const std::filesystem::path& scene_folder) {
  if (!asked.stroke)
    throw_input_error("the scene has no stroke; name one that was recorded with forces: --stroke FILE");
  if (!asked.plugin_laws.force.empty())
    throw_input_error(
        "model.force = \"{}\" is a plugin law, and fit does not know its constants; vary model.parameters in "
        "a sweep, or leave out model.force to fit force.law",
        asked.plugin_laws.force);
  if (asked.ground.has_strengths() || asked.ground.has_k_s())
    throw_input_error(
        "fit knows one sand, and a [[sand.region]] or [[sand.layer]] of the scene gives the force another "
        "one; "
        "remove them");
  Scene scene = with_files(asked, scene_folder);
  scene.device.model = DeviceModel::kinematic;
  const std::filesystem::path path = stroke_path(scene, scene_folder);
  std::string hash;
  Stroke stroke = placed_stroke(scene, path, hash);
  if (stroke.force.empty())
    throw_input_error(
        "{}: has no forces, so there is nothing to fit; name the force columns and their unit "
        "(stroke.table.force and force_unit), or give another --stroke",
        samples_name(path));
  return {scene, load_bed(scene, scene_folder), std::move(stroke)};
}

}  // namespace sandstroke
