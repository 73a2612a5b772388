#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/key_visitor.h"
#include "haptics/simulated_device.h"
#include "haptics/stroke_placement.h"
#include "haptics/table_settings.h"
#include "rules/displacement.h"
#include "rules/force.h"
#include "sand/ground_settings.h"
#include "sand/initial_surface.h"
#include "sand/relaxation.h"
#include "sand/resistive_force.h"
#include "sand/standing_sand.h"
#include "sim/source_settings.h"
#include "tool/tool_settings.h"

namespace sandstroke {

/// paper: as published. accurate: each choice for accuracy: solid sphere, outward, faces, rkl, relaxed by
/// way.
enum class ModelPreset { paper, accurate };
inline const std::vector<std::string> preset_names = {"paper", "accurate"};
inline const std::string& preset_name(ModelPreset preset) {
  return preset_names[static_cast<std::size_t>(preset)];
}

struct BedSettings {
  double width = 2.0, depth = 2.0;  ///< m, along x and y
  int cols = 1000, rows = 1000;     ///< cells along x and y
  BedShape shape = BedShape::rectangle;
  SurfaceSettings surface;
  double cell_size() const { return width / cols; }
};
/// The surface that a scene starts from, if no file has to be read for it.
HeightField starting_bed(const BedSettings& bed);
struct Scene;
/// The same bed, on the ground of the scene, whose cells it must have. Meshes of stones, and a map of
/// the sand, must have been read.
HeightField on_ground(HeightField bed, const Scene& scene);

struct StrokeSettings {
  std::string file;  ///< .toml (scripted), .h5 (recorded), or a table of samples
  StrokePlacement placement;
  std::optional<TableSettings> table;  ///< how a table is read; none: as the table itself says
};

struct OutputSettings {
  double frames = 0.0;  ///< Hz, surfaces kept during the run; 0 = none
  bool trace = true;    ///< keep every tick
};

struct PluginLaws;

/// Plugin laws (sim/plugin_laws.h), by name; empty: the scene's other settings hold.
struct PluginLawSettings {
  std::string plugin;                      ///< file with the laws, relative to the scene
  std::string relaxation;                  ///< instead of relaxation.law and method
  std::string displacement;                ///< instead of displacement.deposit
  std::string force;                       ///< instead of force.law
  std::array<double, 4> parameters = {};   ///< their meaning depends on the law
  std::shared_ptr<const PluginLaws> laws;  ///< the available laws; the plugin's, once it is loaded
};

/// All settings of a run. describe_scene() is the one list of their keys.
struct Scene {
  BedSettings bed;
  GroundSettings ground;
  ModelPreset preset = ModelPreset::paper;
  PluginLawSettings plugin_laws;
  ToolSettings tool;
  DisplacementSettings displacement;
  ForceSettings force;
  SandStrength strength;  ///< of the sand, for any force.law but the paper's; sources need its density
  std::optional<MoistureSettings> moisture;  ///< none: the sand is dry
  RelaxationSettings relaxation;
  std::vector<SourceSettings> sources;  ///< of sand, and sinks
  DeviceSettings device;
  std::optional<StrokeSettings> stroke;  ///< without one, the bed is only relaxed
  OutputSettings output;

  /// Whether no time passes: there is no stroke and no source, and the sand only comes to rest.
  bool only_relaxes() const { return !stroke && sources.empty(); }
};

/// Whether the force comes from the contact: by a plugin law, or by any law but the paper's.
bool is_contact_law(const Scene& scene);

/// Sets the settings that scene.preset stands for.
void apply_model_preset(Scene& scene);

/// Shows every setting to the visitor, in the order of a scene file.
void describe_scene(KeyVisitor& visitor, Scene& scene);

/// The stroke as the scene plays it on its bed (haptics/stroke_placement.h). The scene must have a stroke.
/// Error: input, naming the stroke by `name`.
Stroke place_on_bed(const Stroke& stroke, const Scene& scene, const std::string& name);

/// Checks what no single key can tell: square cells, a tool that fits bed and cells, memory. Error: input,
/// naming the keys; `name` is the scene's file.
void check_scene(const Scene& scene, const std::string& name);

}  // namespace sandstroke
