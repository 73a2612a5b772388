#pragma once

#include <functional>
#include <vector>

#include "sand/sand_region.h"
#include "tool/tool_elements.h"

namespace sandstroke {

/// A number of the sand by place, as the force knows it: that of the regions that have one, the later over
/// the earlier, and elsewhere the scene's own. It changes linearly over a band around a region's edge.
class RegionValues {
 public:
  using ValueOf = std::function<std::optional<double>(const SandRegion&)>;

  RegionValues() = default;
  /// blend [m]: the band's least width.
  RegionValues(const std::vector<SandRegion>& regions, const ValueOf& value_of, double blend);

  /// Whether no region has a number.
  bool empty() const { return regions_.empty(); }
  /// At a place [m].
  double at(const Eigen::Vector2d& place, double own) const;
  /// At each element of a tool with its tip at this place [m]; values: as many as the elements' size().
  void fill(const ToolElements& elements, const Eigen::Vector2d& tip, double own, double* values) const;

 private:
  struct Region {
    RegionArea area;
    double value;
  };
  std::vector<Region> regions_;
};

}  // namespace sandstroke
