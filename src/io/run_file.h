#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hdf5/hdf5_file.h"
#include "io/scene_file.h"
#include "sand/ground.h"
#include "sim/run_result.h"

namespace sandstroke {

/// The group of attributes that visit_error_fields() names.
inline constexpr const char* error_group = "/error_estimate";
/// The group of attributes that visit_load_fields() names.
inline constexpr const char* load_group = "/load";
/// The group of the columns that visit_source_fields() names, over its scale `source`.
inline constexpr const char* source_group = "/sources";
/// Where a run file has the sand on the tool in frame k, if any lies there.
std::string load_dataset(int k);

/// Reads a run file (HDF5). Error: io, if it cannot be opened; input, if it is no run file or lacks what is
/// asked for.
class RunFile {
 public:
  explicit RunFile(const std::filesystem::path& path);

  const std::string& name() const { return file_.name(); }
  bool complete() const;     ///< false: the run was cut off
  double cell_size() const;  ///< m
  int rows() const;          ///< cells along y and x
  int cols() const;
  HeightGrid initial() const;
  HeightGrid final() const;  ///< error if the run was cut off before its end
  /// The same as beds of any size: only what the file holds takes memory. They lie on the run's ground().
  HeightField initial_bed() const;
  HeightField final_bed() const;
  /// The floor under the run's sand, with one talus for all sand, which only pictures need not know better;
  /// null: the run has no floor. All beds of a run share it. Error: input, if it is damaged.
  std::shared_ptr<const Ground> ground() const;
  bool has_final() const;
  bool has_trace() const;
  std::vector<TickRecord> trace() const;  ///< the fields of visit_tick_fields()
  TraceContent trace_content() const;
  std::vector<RelaxationRecord> relaxations() const;  ///< the fields of visit_relaxation_fields()
  /// Times of the frames that the run kept [s]; RunFrames has their surfaces. Error: input, for run format 1.
  std::vector<double> frame_times() const;
  /// Changes frame k - 1 (for k = 0 the initial surface) into frame k. Returns how many parts changed.
  int apply_frame(int k, HeightField& surface) const;
  /// The sand on the tool in frame k; none: there was none.
  std::optional<LoadSurface> load_surface(int k) const;
  /// The estimated error, if the run was asked for it, and the error of each cell's height [m], if that was
  /// asked for, too. The time that the estimate took is not stored.
  std::optional<ErrorEstimate> error_estimate() const;
  std::optional<HeightField> error_map() const;
  /// What each of the scene's sources poured or took; empty if it has none, or the run was cut off.
  std::vector<SourceLedger> sources() const;
  /// The sand that the tool carried; none: it carries none, or the run was cut off.
  std::optional<LoadLedger> load() const;
  std::string scene_text() const;  ///< the resolved scene (TOML)
  SceneFile scene() const;         ///< the same, with its tool's mesh
  /// Name and value of each attribute of /provenance.
  std::vector<std::pair<std::string, std::string>> provenance() const;

 private:
  std::vector<hsize_t> shape() const;  // of /surface/initial
  void check_final() const;            // that the final surface is there, in the same shape
  TriangleMesh tool_mesh() const;
  HeightField surface_on_ground(const std::string& dataset) const;

  Hdf5Reader file_;
  double version_ = 0.0;                          // of the format
  mutable std::shared_ptr<const Ground> ground_;  // once it was asked for
};

/// The surfaces of a run's frames, put together from what changed. In sequence, each change is read once.
class RunFrames {
 public:
  explicit RunFrames(const RunFile& run) : run_(run) {}

  /// Frame k, which the run must hold, until the next call. Going back, it begins at the initial surface
  /// again.
  const HeightField& surface(int k);
  std::int64_t tiles_read() const { return tiles_read_; }

 private:
  const RunFile& run_;
  std::optional<HeightField> surface_;  // after `applied_` frames
  int applied_ = 0;
  std::int64_t tiles_read_ = 0;
};

/// The latest surface that a run holds.
struct LastSurface {
  HeightField surface;
  std::string name;  ///< "final surface"; of a run that was cut off: "surface at 0.25 s", "initial surface"
};

/// Error: io, input, as RunFile.
LastSurface last_surface(const RunFile& run);

}  // namespace sandstroke
