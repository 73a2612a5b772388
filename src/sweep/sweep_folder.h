#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sand/height_field.h"
#include "sweep/metrics.h"
#include "sweep/sweep_design.h"

namespace sandstroke {

/// All that defines a sweep. Two sweeps with the same manifest have the same results.
struct SweepManifest {
  std::string scene;                  ///< the scene's file, relative to where the sweep was begun
  std::vector<std::string> settings;  ///< "key=value" of every point
  SweepDesign design;
  std::vector<std::string> metrics;  ///< names
  bool keep_surface = false, keep_picture = false;
  std::string estimate_error;  ///< coarser, finer; empty: no estimate
  std::string golden;          ///< run file with the final surface to compare with; empty: none
  /// The files that the sweep reads, and their hashes. The scene is first.
  std::vector<std::pair<std::string, std::string>> inputs;
  std::string version, commit;  ///< of the program
  std::string plan;             ///< the plan's file; empty: an early manifest. It decides no result
};

/// Largest size of a sweep's own JSON files: a million values with long names, tasks of ten million points.
inline constexpr std::size_t most_note_bytes = 1'000'000'000;

/// Refuses a folder inside a sweep's folder that is a link: files would go to a place that nobody named.
/// Error: input.
void refuse_link(const std::filesystem::path& folder);

/// The folder of a sweep:
///   manifest.json         SweepManifest, written before any point
///   points/000042.h5      one point, complete or absent. / has the attributes format = "sandstroke.point",
///                         format_version = 1, point, verdict, reason; /metrics has one per metric.
///                         /scene: the resolved scene; /surface (ny, nx) m, if kept, unless the attribute
///                         surface_in names another file in points/ with the same
///   points/000042.png     its picture, if kept; written before the .h5
///   points/000042.state   of a simulation that is under way, or was stopped (io/run_state.h)
///   sweep.h5 .csv .html   written by collect()
class SweepFolder {
 public:
  /// Makes the folder, or opens one that holds the same sweep. Error: input, if it holds another sweep (says
  /// what differs) or other files; io.
  static SweepFolder make(const std::filesystem::path& path, const SweepManifest& manifest);
  /// Opens a folder that make() made. Error: io, input.
  static SweepFolder open(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  const SweepManifest& manifest() const { return manifest_; }
  const SweepDesign& design() const { return manifest_.design; }
  std::size_t points() const { return manifest_.design.points(); }
  /// The metrics that the manifest names.
  const std::vector<Metric>& metrics() const { return metrics_; }

  std::filesystem::path point_file(std::size_t point) const;
  std::filesystem::path picture_file(std::size_t point) const;
  std::filesystem::path state_file(std::size_t point) const;
  /// The file whose /surface is that of a point with a result. Error: io, input, where the point cannot be
  /// read, or its surface's file is missing.
  std::filesystem::path surface_file(std::size_t point) const;
  /// Reads a point. None if its file is missing or cannot be read (cut off).
  std::optional<PointResult> read(std::size_t point) const;

  /// A point's surface to keep: its heights, or the earlier point whose file holds the same. Neither: none.
  struct Surface {
    const HeightField* heights = nullptr;
    std::optional<std::size_t> same_as = {};
  };
  /// Writes one point's file, completely and on the disk, or not at all. Error: io.
  void write(std::size_t point, const PointResult& result, const std::string& scene_text,
             const Surface& surface) const;

  /// The command that runs one point alone.
  std::string command(std::size_t point) const;

 private:
  SweepFolder(std::filesystem::path path, SweepManifest manifest);

  std::filesystem::path path_;
  SweepManifest manifest_;
  std::vector<Metric> metrics_;
};

}  // namespace sandstroke
