#pragma once

#include <memory>

#include "sand/ground.h"
#include "sand/ground_settings.h"

namespace sandstroke {

/// The ground of a bed; null: there is none. talus_slope: of the sand where no map or region says another.
/// Meshes of stones must have been read, and so must the map; if it has other cells, their means are taken. A
/// cell of a region's edge has the mean of tan(talus) over the cell, where edges of several regions meet by 8
/// x 8 samples. Ends early, with what is made so far, if interrupted().
std::shared_ptr<const Ground> make_ground(const BedGeometry& bed, const GroundSettings& settings,
                                          double talus_slope);

/// The most tiles that the ground's fields allocate. A mesh that was not read counts nothing.
struct GroundTiles {
  double floor = 0.0, slopes = 0.0;
};
GroundTiles most_tiles(const BedGeometry& bed, const GroundSettings& settings);

}  // namespace sandstroke
