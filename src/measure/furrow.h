#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene.h"
#include "sim/simulation_observer.h"
#include "tool/tool_surface.h"

namespace sandstroke {

/// The positions of the tip while it was in contact [m], in order. A piece begins at each point whose index
/// is in `pieces` (ascending, the first 0): before it the tool was lifted.
struct TipPath {
  std::vector<Eigen::Vector2d> points;
  std::vector<std::size_t> pieces;
  /// Height at which the hand wanted the tip [m], for each point; or empty.
  std::vector<double> asked = {};
};

/// Gathers the path of a run, in points a quarter of a tool radius apart. If a tip trembles at the surface,
/// it continues the piece that it left there.
class TipPathGatherer : public SimulationObserver {
 public:
  explicit TipPathGatherer(const Scene& scene) : device_(scene.device), radius_(tool_reach(scene.tool)) {}
  void on_tick(const TickRecord& tick) override;
  void visit_state(StateVisitor& state) override {
    state.list("path.points", path_.points);
    state.list("path.pieces", path_.pieces);
    state.list("path.asked", path_.asked);
    state.value("path.in_contact", in_contact_);
  }
  const TipPath& path() const { return path_; }
  /// The furrow of the run, between its initial and its final surface (measure_furrow); none if nothing was
  /// touched.
  std::optional<FurrowMeasures> furrow(const HeightField& initial, const HeightField& final) const;

 private:
  DeviceSettings device_;
  double radius_;  // m, of the tool
  TipPath path_;
  bool in_contact_ = false;
};

/// Measures the cross-sections of a furrow. Returns medians over sections across the direction of travel, an
/// eighth of a tool radius apart (further apart if that would be more than 8000), so that ends, crossings and
/// neighbouring strokes do not count as long as they are the smaller part. tool_radius [m]. A contact that
/// stays within half a radius is one section across x. Sections reach 6 radii to either side and are sampled
/// at every half cell, linear between centres of cells. A width whose ends are not both inside that and the
/// bed is left out. Both fields must have one shape; only what the sections cross is looked at. The error is
/// of the order of slope x cell size.
FurrowMeasures measure_furrow(const HeightField& initial, const HeightField& final, const TipPath& path,
                              double tool_radius);

/// Returns a warning if a stroke asked for a furrow (a drag of at least 4 tool radii) and left less than half
/// of its depth: why, and what to do. Otherwise empty.
std::string furrow_warning(const Scene& scene, const FurrowMeasures& furrow);

}  // namespace sandstroke
