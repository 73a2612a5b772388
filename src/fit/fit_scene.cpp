#include "fit/fit_scene.h"

#include "core/error.h"
#include "core/interrupt.h"
#include "fit/least_squares.h"
#include "import/import_stroke.h"
#include "io/scene_toml.h"
#include "io/surface_file.h"
#include "run/run_scene.h"

namespace sandstroke {
namespace {

std::optional<ForceFit> fit_contact(const FeltStroke& felt, const std::vector<bool>& is_free) {
  constexpr int most_turns = 5;  // a constant that the recording does not determine may never converge
  const ForceLaw law = felt.scene.force.law;
  Eigen::VectorXd best = contact_values(law, felt.scene.strength);
  for (int turn = 1;; ++turn) {
    const ContactLaw near = felt.contact_law({law, felt.scene.strength, best, is_free});
    if (interrupted()) return std::nullopt;
    best = LeastSquares{near, near.recorded(), is_free}.best();
    if (turn == most_turns || near.grid().is_close_about(best)) return fit_force(near, is_free);
  }
}

}  // namespace

std::span<const ForceConstant> constants_of(ForceLaw law) {
  if (law == ForceLaw::paper) return paper_constants;
  return contact_constants(law);
}

FeltStroke felt_stroke(const Scene& asked, const std::filesystem::path& scene_folder) {
  if (!asked.stroke)
    throw_input_error("the scene has no stroke; name one that was recorded with forces: --stroke FILE");
  if (!asked.plugin_laws.force.empty())
    throw_input_error(
        "model.force = \"{}\" is a plugin law, and fit does not know its constants; vary model.parameters in "
        "a sweep, or leave out model.force to fit force.law",
        asked.plugin_laws.force);
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
  return {scene, load_surface(scene.bed, scene_folder), std::move(stroke)};
}

std::optional<ForceFit> fit_stroke(const FeltStroke& felt, const std::vector<bool>& is_free) {
  if (felt.scene.force.law != ForceLaw::paper) return fit_contact(felt, is_free);
  const std::vector<FeltTick> ticks = felt.paper_ticks();
  if (interrupted()) return std::nullopt;
  return fit_force(PaperLaw(ticks, felt.scene.force, felt.scene.device.max_force), is_free);
}

}  // namespace sandstroke
