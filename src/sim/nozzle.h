#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "haptics/stroke_sampler.h"
#include "sand/bed_geometry.h"
#include "sim/source_settings.h"

namespace sandstroke {

/// When the nozzle of a source is open, and where it is then.
class Nozzle {
 public:
  /// The stroke of a path must have been loaded.
  explicit Nozzle(const SourceSettings& settings);

  double start() const { return start_; }
  /// It is open before that [s]; infinity: always.
  double stop() const { return stop_; }
  void stop_by(double time) { stop_ = std::min(stop_, time); }
  /// Its mouth [m] at a time from start() to stop() [s]. None where the path is lifted: it is closed there.
  std::optional<Eigen::Vector3d> at(double time);

 private:
  Eigen::Vector3d at_;
  double start_, stop_;
  std::optional<StrokeSampler> path_;
};

/// A cell and the part of it that lies under a nozzle.
struct CellUnder {
  int row, col;
  double part;
};

/// The cells that have sand under a nozzle at (x, y) of this radius [m]; never none. A nozzle narrower than a
/// cell is a point: it is spread over the four cells around it, so that its middle is where it is. Where the
/// nozzle is wholly beyond the bed's edge, it is the nearest point on the way to the bed's centre.
std::vector<CellUnder> cells_under_nozzle(const BedGeometry& bed, double x, double y, double radius);

}  // namespace sandstroke
