#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hdf5/hdf5_file.h"
#include "sim/run_result.h"
#include "sim/scene.h"

namespace sandstroke {

/// Its attributes are what visit_error_fields() names.
inline constexpr const char* error_group = "/error_estimate";

/// A run file (HDF5) read back. Error: io where it cannot be opened; input where it is no run file or lacks
/// what is asked for.
class RunFile {
 public:
  explicit RunFile(const std::filesystem::path& path);

  const std::string& name() const { return file_.name(); }
  bool complete() const;     ///< false: the run was cut off
  double cell_size() const;  ///< m
  int rows() const;          ///< cells along y and x
  int cols() const;
  HeightGrid initial() const;
  HeightGrid final() const;  ///< error where the run was cut off before its end
  /// The same as beds, in which only what the file holds exists: for beds of any size.
  HeightField initial_bed() const;
  HeightField final_bed() const;
  bool has_final() const;
  bool has_trace() const;
  std::vector<TickRecord> trace() const;  ///< what visit_tick_fields() names
  TraceContent trace_content() const;
  std::vector<RelaxationRecord> relaxations() const;  ///< what visit_relaxation_fields() names
  /// Times of the frames kept during the run [s]; RunFrames has their surfaces. Not of run format 1.
  std::vector<double> frame_times() const;
  /// Makes the k-th frame of the one before (of the initial surface): how many parts changed.
  int apply_frame(int k, HeightField& surface) const;
  /// Where the run was asked to estimate its error, and the error of each cell's height [m], where asked for.
  /// What the estimate took is not known.
  std::optional<ErrorEstimate> error_estimate() const;
  std::optional<HeightField> error_map() const;
  std::string scene_text() const;  ///< the resolved scene (TOML)
  Scene scene() const;             ///< the same, with its tool's mesh
  /// Name and value of each attribute of /provenance.
  std::vector<std::pair<std::string, std::string>> provenance() const;

 private:
  std::vector<hsize_t> shape() const;  // of /surface/initial
  void check_final() const;            // that it is there, in the same shape
  TriangleMesh tool_mesh() const;

  Hdf5Reader file_;
  double version_ = 0.0;  // of the format
};

/// The surfaces of a run's frames, put together from what changed.
/// Asked for in sequence, each change is read once.
class RunFrames {
 public:
  explicit RunFrames(const RunFile& run) : run_(run) {}

  /// The k-th, which the run holds. Further back than the last one asked for: from the start again.
  HeightGrid surface(int k);
  std::int64_t tiles_read() const { return tiles_read_; }

 private:
  const RunFile& run_;
  std::optional<HeightField> surface_;  // after `applied_` frames
  int applied_ = 0;
  std::int64_t tiles_read_ = 0;
};

}  // namespace sandstroke
