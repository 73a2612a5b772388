#include "run/run_summary.h"

#include <spdlog/fmt/fmt.h>

#include <limits>

#include "io/run_file.h"
#include "sand/instruction_set.h"
#include "sim/scene_moisture.h"

namespace sandstroke {

namespace {

nlohmann::ordered_json followed_json(const FollowedSand& followed) {
  return {{"ticks", followed.ticks},
          {"asked_depth", followed.asked_depth},
          {"depth", followed.depth},
          {"asked_force", followed.asked_force},
          {"force", followed.force}};
}

}  // namespace

nlohmann::ordered_json run_summary(const RunResult& r, const Scene& scene, const std::string& output) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();  // null
  nlohmann::ordered_json json = {
      {"output", output},
      {"preset", preset_name(scene.preset)},
      {"wall_seconds", r.wall_seconds},
      {"ticks", r.ticks},
      {"simulated_seconds", r.simulated_seconds},
      {"real_time_factor", r.simulated_seconds / r.wall_seconds},
      {"contact_ticks", r.contact_ticks},
      {"saturated_ticks", r.device.saturated_ticks},
      {"stroke_seconds", r.stroke.whole},
      {"played_seconds", r.stroke.played},
      {"gaps", r.stroke.gaps},
      {"passes", r.relaxation.passes},
      {"relaxations", r.relaxations},
      {"super_steps", r.relaxation.super_steps},
      {"rejected_stages", r.relaxation.rejected_stages},
      {"cells_visited", r.relaxation.cells_visited},
      {"tiles_active_max", r.relaxation.tiles_active_max},
      {"wake_ups", r.relaxation.wake_ups},
      {"residual", r.relaxation.residual},
      {"converged", r.relaxation.converged},
      {"volume_initial", r.volume_initial},
      {"volume_final", r.volume_final},
      {"volume_drift", r.volume_drift},
      {"displaced_volume", r.displaced_volume},
      {"moved_volume", r.moved_volume},
      {"max_force", r.device.max_force},
      {"mean_force", r.device.mean_force},
      {"max_depth", r.max_depth},
      {"asked_depth", r.furrow ? r.furrow->asked_depth : none},
      {"furrow_depth", r.furrow ? r.furrow->depth : none},
      {"held_drag_ticks", r.device.limited_drag_ticks},
      {"swings_from", r.device.swings_from.value_or(none)},
      {"absorbed_energy", r.device.absorbed_energy},
      {"least_absorbed_energy", r.device.least_absorbed_energy},
      {"least_passivity_margin", r.device.least_passivity_margin},
      {"threads", r.threads},
      {"instruction_set", instruction_set()},
      {"interrupted", r.interrupted},
  };
  json["warnings"] = nlohmann::ordered_json::array();
  for (const Warning& warning : r.warnings)
    json["warnings"].push_back(
        {{"code", warning.kind().word}, {"section", warning.kind().section}, {"text", warning.text}});
  if (is_moist(scene)) json["failed_volume"] = r.relaxation.failed_volume;
  if (!r.sources.empty()) {
    json["given_volume"] = r.given_volume;
    json["sources"] = sources_json(r.sources);
  }
  if (r.load) {
    json["given_volume"] = r.given_volume;
    json["load"] = load_json(*r.load);
    json["load"]["density"] = scene.strength.density;
  }
  if (r.followed) json["followed"] = followed_json(*r.followed);
  if (r.recorded_force)
    json["recorded_force"] = {{"ticks", r.recorded_force->ticks},
                              {"rms", r.recorded_force->rms},
                              {"max", r.recorded_force->max},
                              {"correlation", r.recorded_force->correlation},
                              {"best_correlation", r.recorded_force->best_correlation},
                              {"lag", r.recorded_force->lag}};
  if (r.error) {
    json["error_estimate"] = error_json(*r.error);
    json["error_estimate"]["wall_seconds"] = r.error->wall_seconds;
  }
  return json;
}

std::string text_of(const SourceLedger& source) {
  if (source.asked > 0.0) return fmt::format("took {:.4g} kg of {:.4g} kg asked", source.taken, source.asked);
  return fmt::format("poured {:.4g} kg, landed {:.4g} kg, in the air {:.4g} kg", source.poured, source.landed,
                     source.in_air);
}

std::string text_of(const LoadLedger& load, double density) {
  const double taken = load.lifted + load.ran_on + load.caught;
  return fmt::format("took up {:.4g} kg, carried {:.4g} kg at most, spilled {:.4g} kg, {:.4g} kg left on it",
                     density * taken, density * load.most, density * load.spilled, density * load.carried);
}

nlohmann::ordered_json sources_json(const std::vector<SourceLedger>& sources) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const SourceLedger& source : sources) {
    nlohmann::ordered_json& row = json.emplace_back();
    visit_source_fields([&](const FieldText& field, const auto& of) { row[field.name] = of(source); });
  }
  return json;
}

nlohmann::ordered_json load_json(const LoadLedger& load) {
  nlohmann::ordered_json json;
  visit_load_fields([&](const FieldText& field, const auto& of) { json[field.name] = of(load); });
  return json;
}

nlohmann::ordered_json error_json(const ErrorEstimate& error) {
  nlohmann::ordered_json json;
  visit_error_fields([&](const FieldText& field, const auto& of) { json[field.name] = of(error); });
  return json;
}

}  // namespace sandstroke
