#pragma once

#include <limits>

#include "sand/height_field.h"

namespace sandstroke {

/// The ground that a bed's sand lies on, and the kinds of sand by place. Both are fields of the bed's
/// geometry that follow a level rule wherever none of their tiles is allocated, so that they cost memory only
/// where stones, slopes or regions are.
struct Ground {
  HeightField floor;         ///< s [m], which no sand gets below; -infinity: there is none
  HeightField talus_slopes;  ///< tan(talus) of each cell's sand

  /// No floor, and one slope (rise over run).
  Ground(const BedGeometry& bed, double talus_slope);
  /// A level floor [m] and one slope (rise over run).
  Ground(const BedGeometry& bed, double floor_level, double talus_slope);
  /// These fields, of one geometry.
  Ground(HeightField floor, HeightField talus_slopes);

  /// The floor [m] where no tile of it is allocated.
  double level() const { return floor.untouched().highest(); }
  /// The least talus slope (rise over run).
  double flattest() const;
  /// Whether there is a floor anywhere.
  bool has_floor() const {
    return floor.allocated_tiles() > 0 || level() > -std::numeric_limits<double>::infinity();
  }
  /// Whether a tile (by index), or one beside it, has a floor of its own.
  bool has_floor_around(int tile) const { return is_allocated_around(floor, tile); }
  /// Whether a tile (by index), or one beside it, has talus slopes of its own.
  bool has_slopes_around(int tile) const { return is_allocated_around(talus_slopes, tile); }

 private:
  static bool is_allocated_around(const HeightField& field, int tile);
};

/// The same, cell by cell.
TalusGround talus_ground(const Ground& ground);

/// The hash of both fields.
std::string content_hash(const Ground& ground);

/// Whether a bed lies on a ground that has a floor in any cell.
bool has_floor(const HeightField& bed);

}  // namespace sandstroke
