#pragma once

#include <Eigen/Core>
#include <string>

namespace sandstroke {

/// An arc in the plane. Z and the radius change evenly along it.
struct GcodeArc {
  Eigen::Vector2d centre;
  double radius = 0.0, end_radius = 0.0;  // mm
  double start = 0.0, sweep = 0.0;        // rad, above 0 counterclockwise

  /// How many chords keep to the tolerance.
  double chords() const;
  /// Of an arc that climbs by that much [mm].
  double length(double climb) const;
  Eigen::Vector2d at(double fraction) const;
};

/// The arc between two points around a centre [mm]. Error: input, if its radius is 0 or not the same at both
/// ends, within the limits of Grbl and LinuxCNC; `location` is the file and line.
GcodeArc arc_between(const Eigen::Vector2d& begin, const Eigen::Vector2d& end, const Eigen::Vector2d& centre,
                     bool clockwise, const std::string& location);

/// The centre of an arc of that radius [mm]: of the shorter one if it is above 0, else of the longer one.
/// Error: input, if there is none.
Eigen::Vector2d centre_by_radius(const Eigen::Vector2d& begin, const Eigen::Vector2d& end, double radius,
                                 bool clockwise, const std::string& location);

/// The farthest that a coordinate may be [mm].
inline constexpr double gcode_farthest = 1e12;

}  // namespace sandstroke
