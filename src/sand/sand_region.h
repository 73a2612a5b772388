#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "sand/ground_settings.h"

namespace sandstroke {

/// Where a region is. Its share of a place goes linearly from 0 to 1 over the band of `soft` around its edge.
class RegionArea {
 public:
  explicit RegionArea(const SandRegion& region);

  /// The share at a place [m].
  double share(const Eigen::Vector2d& at) const;
  /// The mean share of a square with this centre and side [m]: exact for a sharp edge, else by 8 x 8 samples.
  double mean_share(const Eigen::Vector2d& centre, double side) const;
  /// 0 or 1, if the share is that in all of the square; else another number.
  double whole_share(const Eigen::Vector2d& centre, double side) const;
  /// Holds all places with a share.
  Eigen::AlignedBox2d bounds() const;

 private:
  /// The distance from the edge [m]: above 0 inside.
  double depth_inside(const Eigen::Vector2d& at) const;
  double sharp_area(const Eigen::AlignedBox2d& square) const;

  SandRegion region_;
};

/// Whether two edges of a polygon cross each other.
bool crosses_itself(const std::vector<Eigen::Vector2d>& points);

/// Calls visit(place) for samples x samples places of a square, in the middles of equal squares.
template <class Visit>
void visit_samples(const Eigen::Vector2d& centre, double side, int samples, const Visit& visit) {
  for (int i = 0; i < samples; ++i)
    for (int j = 0; j < samples; ++j)
      visit(Eigen::Vector2d(centre.x() + ((j + 0.5) / samples - 0.5) * side,
                            centre.y() + ((i + 0.5) / samples - 0.5) * side));
}

}  // namespace sandstroke
