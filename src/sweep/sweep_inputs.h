#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "haptics/stroke.h"
#include "sand/height_field.h"
#include "sim/scene.h"
#include "sweep/sweep_plan.h"

namespace sandstroke {

/// A placed stroke, and a hash of its content.
struct SweepStroke {
  Stroke stroke;
  std::string hash;
};

/// Loads the strokes, beds and tools of a sweep's points, each once for all points that share it. Several
/// threads may use it. Error: input, io.
class SweepInputs {
 public:
  explicit SweepInputs(std::filesystem::path scene_folder) : scene_folder_(std::move(scene_folder)) {}

  /// The stroke that a scene plays. nullptr if it plays none.
  std::shared_ptr<const SweepStroke> stroke(const Scene& scene);
  /// The bed that a scene starts from, on its ground, whose meshes and map must have been read (ground()).
  std::shared_ptr<const HeightField> bed(const Scene& scene);
  /// The same tool, with its mesh if it is a mesh.
  ToolSettings tool(const ToolSettings& settings);
  /// The ground of a scene, with the meshes of its stones, and its map in the bed's cells.
  GroundSettings ground(const Scene& scene);
  /// The same settings, with the laws of their plugin if they name one.
  PluginLawSettings plugin_laws(const PluginLawSettings& settings);
  /// With their paths loaded.
  std::vector<SourceSettings> sources(const std::vector<SourceSettings>& settings);

  int strokes_loaded() const { return strokes_loaded_; }
  int beds_loaded() const { return beds_loaded_; }
  /// Hold it while reading or writing an HDF5 file: the library is not safe for several threads.
  std::mutex& files() { return files_; }

 private:
  /// Counts what is about to be kept in beds_ or sand_maps_, which forget all if it is too much.
  void make_room(double bytes);

  std::filesystem::path scene_folder_;
  std::mutex files_;
  std::map<std::string, bool> by_force_;  // by file: whether force constants change the stroke
  std::map<std::string, std::shared_ptr<const SweepStroke>> strokes_;   // by file and settings
  std::size_t stroke_samples_ = 0;                                      // number of samples in strokes_
  std::map<std::string, std::shared_ptr<const HeightField>> beds_;      // by their settings
  std::map<std::string, std::shared_ptr<const HeightGrid>> sand_maps_;  // by their settings, and the bed's
  double bed_bytes_ = 0.0;                                              // size of beds_ and sand_maps_
  std::map<std::pair<std::string, double>, std::shared_ptr<const TriangleMesh>> meshes_,
      stones_;                                                        // by file and scale
  std::map<std::string, std::shared_ptr<const PluginLaws>> plugins_;  // by file
  std::map<std::string, std::shared_ptr<const Stroke>> paths_;        // of sources, by file
  int strokes_loaded_ = 0, beds_loaded_ = 0;
};

/// A key of all that decides a point's sand: points with equal keys have the same surfaces all the time.
/// `stroke`: from SweepInputs.
std::string sand_key(const Scene& scene, const SweepStroke* stroke);

}  // namespace sandstroke
