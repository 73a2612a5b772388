#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "sand/bed_geometry.h"

namespace sandstroke {

/// Equal steps of a tip along a straight way [m]: at(0) is its beginning, at(count) its end.
struct TipSteps {
  Eigen::Vector3d begin = Eigen::Vector3d::Zero(), way = Eigen::Vector3d::Zero();
  std::int64_t count = 0;
  Eigen::Vector3d at(std::int64_t i) const {
    return begin + static_cast<double>(i) / static_cast<double>(count) * way;
  }
};

/// Divides the way from one tick's position to the next one's [m] into steps of at most `longest` [m] along
/// the bed, so that a fast drag leaves a furrow and not a row of pits. Only the part of the way counts from
/// which a footprint of `reach` [m] meets the bed, and that lies below `highest` [m]. So even an extremely
/// long way costs only what crosses the sand.
TipSteps steps_between(const BedGeometry& bed, double reach, const Eigen::Vector3d& from,
                       const Eigen::Vector3d& to, double longest, double highest);

}  // namespace sandstroke
