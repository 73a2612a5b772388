#pragma once

#include <Eigen/Core>
#include <optional>

#include "sand/displacement.h"

namespace sandstroke {

/// Displaces along the straight way of a tip from one tick's place to the next one's [m], both left out, as
/// ticks in between would: at equal steps of half a radius at most along the bed, so that a fast drag leaves
/// a furrow and not a row of pits. (Steps straight down make no difference, and a tick of at most half a
/// radius does nothing here.) Only the part of the way over the bed and below its highest sand costs
/// anything. highest [m]: no sand is higher; none: it is looked up, which visits every tile. Returns the
/// volume moved [m^3]. The footprint is used up.
double displace_between(HeightField& bed, ToolFootprint& footprint, const Eigen::Vector3d& from,
                        const Eigen::Vector3d& to, const DisplacementSettings& settings,
                        std::optional<double> highest = {});

}  // namespace sandstroke
