#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/range.h"
#include "haptics/device.h"
#include "haptics/force_model.h"
#include "haptics/stroke_placement.h"
#include "picture/view.h"
#include "sand/displacement.h"
#include "sand/initial_surface.h"
#include "sand/relaxation.h"
#include "sand/tool_footprint.h"

namespace sandstroke {

/// As published (paper), or with each choice for accuracy: solid sphere, outward, isotropic, rkl, relaxed by
/// way.
enum class ModelPreset { paper, accurate };
inline const std::vector<std::string> preset_names = {"paper", "accurate"};
inline const std::string& preset_name(ModelPreset preset) {
  return preset_names[static_cast<std::size_t>(preset)];
}

struct BedSettings {
  double width = 2.0, depth = 2.0;  ///< m, along x and y
  int cols = 1000, rows = 1000;     ///< cells along x and y
  SurfaceSettings surface;
  double cell_size() const { return width / cols; }
};

struct StrokeSettings {
  std::string file;  ///< .toml (scripted) or .h5 (recorded)
  StrokePlacement placement;
};

struct OutputSettings {
  double frames = 0.0;  ///< Hz, surfaces kept during the run; 0 = none
  bool trace = true;    ///< keep every tick
};

/// All settings of a run. describe_scene() is the one list of their keys.
struct Scene {
  BedSettings bed;
  ModelPreset preset = ModelPreset::paper;
  ToolSettings tool;
  DisplacementSettings displacement;
  ForceSettings force;
  RelaxationSettings relaxation;
  DeviceSettings device;
  std::optional<StrokeSettings> stroke;  ///< without one, the bed is only relaxed
  OutputSettings output;
  ViewSettings view;
};

/// Sets what scene.preset stands for.
void apply_model_preset(Scene& scene);

/// What describe_scene() shows each setting to: a reader sets the value, a writer prints it, a help page
/// explains it.
class SceneVisitor {
 public:
  virtual ~SceneVisitor() = default;
  virtual void section(const char* name, const char* help) = 0;
  /// A section that may be absent: true if it is there.
  virtual bool optional_section(const char* name, bool present, const char* help) = 0;
  virtual void number(const char* key, double& value, Range range, const char* unit, const char* help) = 0;
  virtual void numbers(const char* key, double* values, int count, Range range, const char* unit,
                       const char* help) = 0;
  virtual void integers(const char* key, int* values, int count, int lowest, int highest,
                        const char* help) = 0;
  virtual void flag(const char* key, bool& value, const char* help) = 0;
  virtual void text(const char* key, std::string& value, const char* help) = 0;
  /// value: index into names.
  virtual void choice(const char* key, int& value, const std::vector<std::string>& names,
                      const char* help) = 0;
  /// True for a reader: a preset just read then sets the values it stands for, and later keys override them.
  virtual bool reads() const = 0;
};

/// Shows every setting to the visitor, in the order of a scene file. Keys that mean nothing for the choices
/// made (the radius of a flat surface) are not shown, so that a reader rejects them.
void describe_scene(SceneVisitor& visitor, Scene& scene);

/// What no single key can say: square cells, a tool that fits bed and cells, memory. Error: input, naming the
/// keys; `name` is the scene's file.
void check_scene(const Scene& scene, const std::string& name);

}  // namespace sandstroke
