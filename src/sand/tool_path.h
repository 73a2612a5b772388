#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "sand/bed_geometry.h"

namespace sandstroke {

/// Places along a straight way of a tip [m], in equal steps: at(0) is its beginning, at(count) its end.
struct TipSteps {
  Eigen::Vector3d begin = Eigen::Vector3d::Zero(), way = Eigen::Vector3d::Zero();
  std::int64_t count = 0;
  Eigen::Vector3d at(std::int64_t i) const {
    return begin + static_cast<double>(i) / static_cast<double>(count) * way;
  }
};

/// The way from one tick's place to the next one's [m], at steps of `longest` [m] at most along the bed, so
/// that a fast drag leaves a furrow and not a row of pits. Only the part of the way that a footprint of
/// `reach` [m] sees the bed from, and below `highest` [m], counts: a way from beyond all measure costs only
/// what crosses the sand.
TipSteps steps_between(const BedGeometry& bed, double reach, const Eigen::Vector3d& from,
                       const Eigen::Vector3d& to, double longest, double highest);

}  // namespace sandstroke
