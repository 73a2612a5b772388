#include "sweep/sweep_inputs.h"

#include "core/input_file.h"
#include "core/machine.h"
#include "io/mesh_file.h"
#include "io/plugin_file.h"
#include "io/sand_map_file.h"
#include "io/scene_toml.h"
#include "io/source_path.h"
#include "io/stroke_file.h"
#include "io/surface_file.h"

namespace sandstroke {
namespace {

constexpr std::size_t most_samples_kept = 10'000'000;  // in all strokes: about a gigabyte

/// A key for the map of a scene's sand in the cells of its bed.
std::string text_of_map(const Scene& scene) {
  SceneFile named;
  named.bed = scene.bed;
  named.bed.surface = {};
  named.ground.map = scene.ground.map;
  return scene_text(named);
}

/// The text of a scene with this one's bed and ground, and default settings otherwise: a key for the bed.
std::string text_of_bed(const Scene& scene) {
  SceneFile named;
  named.bed = scene.bed;
  named.ground = scene.ground;
  if (!scene.ground.empty()) named.relaxation.talus_angle = scene.relaxation.talus_angle;
  return scene_text(named);
}

}  // namespace

std::shared_ptr<const SweepStroke> SweepInputs::stroke(const Scene& scene) {
  if (!scene.stroke) return nullptr;
  const std::filesystem::path path = scene_folder_ / scene.stroke->file;
  const std::scoped_lock lock(files_);
  const auto [by_force, is_new] = by_force_.try_emplace(path.string());
  if (is_new) {
    check_readable(path);  // no pipe, which can be read only once
    by_force->second = stroke_depends_on_force(path);
  }
  check_plugin_force(scene, path);
  SceneFile named;
  named.stroke = scene.stroke;
  named.bed.width = scene.bed.width;
  named.bed.depth = scene.bed.depth;  // the stroke's placement
  named.device.scale = scene.device.scale;
  named.device.offset = scene.device.offset;
  if (by_force->second) named.force = scene.force;
  const std::string key = scene_text(named);
  if (const auto found = strokes_.find(key); found != strokes_.end()) return found->second;
  auto loaded = std::make_shared<SweepStroke>();
  loaded->stroke = place_on_bed(load_stroke(path, scene.force, scene.stroke->table.value_or(TableSettings{})),
                                scene, path.string());
  loaded->hash = content_hash(loaded->stroke);
  strokes_loaded_ += 1;
  stroke_samples_ += loaded->stroke.size();
  if (stroke_samples_ > most_samples_kept) {
    strokes_.clear();
    stroke_samples_ = loaded->stroke.size();
  }
  return strokes_[key] = loaded;
}

std::shared_ptr<const HeightField> SweepInputs::bed(const Scene& scene) {
  const std::string key = text_of_bed(scene);
  const std::scoped_lock lock(files_);
  if (const auto found = beds_.find(key); found != beds_.end()) return found->second;
  auto loaded = std::make_shared<const HeightField>(load_bed(scene, scene_folder_));
  beds_loaded_ += 1;
  make_room(static_cast<double>(loaded->bytes()));
  return beds_[key] = loaded;
}

void SweepInputs::make_room(double bytes) {
  bed_bytes_ += bytes;
  if (bed_bytes_ <= 0.25 * memory_room().bytes) return;
  beds_.clear();
  sand_maps_.clear();
  bed_bytes_ = bytes;
}

ToolSettings SweepInputs::tool(const ToolSettings& settings) {
  if (settings.shape != ToolShape::mesh) return settings;
  const std::scoped_lock lock(files_);
  ToolSettings tool = settings;
  std::shared_ptr<const TriangleMesh>& mesh = meshes_[{settings.file, settings.scale}];
  tool.mesh = mesh;
  tool = with_mesh(tool, scene_folder_);
  mesh = tool.mesh;
  return tool;
}

GroundSettings SweepInputs::ground(const Scene& scene) {
  const std::scoped_lock lock(files_);
  GroundSettings settings = scene.ground;
  for (StoneSettings& stone : settings.stones)
    if (stone.shape == StoneShape::mesh) stone.mesh = stones_[{stone.file, stone.scale}];
  settings = with_meshes(settings, scene_folder_);
  for (const StoneSettings& stone : settings.stones)
    if (stone.mesh) stones_[{stone.file, stone.scale}] = stone.mesh;
  if (!settings.map) return settings;
  const std::string key = text_of_map(scene);
  const auto found = sand_maps_.find(key);
  settings.map->slopes = found != sand_maps_.end() ? found->second : nullptr;
  if (settings.map->slopes) return settings;
  settings = with_sand_map(settings, scene.bed, scene_folder_);
  make_room(static_cast<double>(sizeof(double)) * static_cast<double>(settings.map->slopes->size()));
  sand_maps_[key] = settings.map->slopes;
  return settings;
}

PluginLawSettings SweepInputs::plugin_laws(const PluginLawSettings& settings) {
  const std::scoped_lock lock(files_);
  PluginLawSettings plugin_laws = settings;
  std::shared_ptr<const PluginLaws>& laws = plugins_[settings.plugin];
  plugin_laws.laws = laws;
  plugin_laws = with_plugin(plugin_laws, scene_folder_);
  laws = plugin_laws.laws;
  return plugin_laws;
}

std::vector<SourceSettings> SweepInputs::sources(const std::vector<SourceSettings>& settings) {
  const std::scoped_lock lock(files_);
  std::vector<SourceSettings> sources = settings;
  for (SourceSettings& source : sources) source.stroke = paths_[source.path];
  sources = with_paths(sources, scene_folder_);
  for (const SourceSettings& source : sources) paths_[source.path] = source.stroke;
  return sources;
}

std::string sand_key(const Scene& scene, const SweepStroke* stroke) {
  SceneFile named{scene};
  named.stroke.reset();
  named.output = {};
  named.preset = ModelPreset::paper;  // it only sets other settings
  if (scene.device.model == DeviceModel::kinematic) {
    named.force = {};
    named.force.law = scene.force.law;  // a contact law is computed with the sand, by named.strength
    const DeviceSettings& device = scene.device;
    named.device = {};
    named.device.servo_rate = device.servo_rate;
    named.device.scale = device.scale;
    named.device.offset = device.offset;
  }
  return scene_text(named) + (stroke ? stroke->hash : "");
}

}  // namespace sandstroke
