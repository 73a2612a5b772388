#pragma once

#include <array>

namespace sandstroke {

// Along which surface moist sand fails, and how much cohesion holds there. Lengths are in c / gamma: cohesion
// [Pa] over weight per volume [N/m^3]. Friction angle phi, mu = tan(phi).

/// spiral: the rotational log-spiral through the toe, an upper bound of the height of cuts (Chen, Limit
/// Analysis and Soil Plasticity, 1975). plane: Culmann's wedge, too high by 4 % for vertical cuts and by 42 %
/// for those of 60 degrees.
enum class SlipSurface { spiral, plane };
inline constexpr const char* slip_surface_names[] = {"spiral", "plane"};

/// The height at which a straight cut fails, in c / gamma. Angles in deg: 0 < friction < face <= 90. By the
/// plane 4 sin(face) cos(phi) / (1 - cos(face - phi)); by the spiral the least over both its angles.
double critical_height(SlipSurface surface, double face_angle, double friction_angle);

/// What the cohesion along a chord through the toe is multiplied by, so that the wedges of straight cuts
/// (rules/standing.h) fail at the height of the failure surface: kappa.
class CohesionFactor {
 public:
  /// friction_angle: deg, 1 to 60.
  CohesionFactor(SlipSurface surface, double friction_angle);

  /// Of a chord that rises by `rise` over `run` (same unit), rise > mu run. By a table over (T - mu) / (T +
  /// mu), T = rise / run, up to the chord of a vertical cut; that value holds for all that are steeper.
  double operator()(double rise, double run) const {
    const double lead = (rise - friction_ * run) / (rise + friction_ * run) * per_step_;
    if (!(lead < values - 1)) return table_.back();
    const int at = static_cast<int>(lead);
    return table_[at] + (lead - at) * (table_[at + 1] - table_[at]);
  }
  double friction() const { return friction_; }  ///< mu
  /// The height of sand below which no wedge fails, whatever its shape, in c / gamma: the least mean
  /// thickness of one, about half of a vertical cut's height.
  double safe_height() const { return safe_height_; }
  /// Below what comes of any chord, but for rounding.
  double least() const { return least_; }
  /// The run [m] beyond which no wedge fails whose sand is nowhere more than `above` [m] over a slope of mu
  /// from the toe, and nowhere more than `top` [m] over the toe. cohesion: over the weight per volume [m].
  double longest_run(double above, double top, double cohesion) const;

 private:
  static constexpr int values = 33;
  double friction_, per_step_, safe_height_, least_ = 1.0;
  std::array<double, values> table_;
};

}  // namespace sandstroke
