#pragma once

#include <Eigen/Core>

#include "core/elementary.h"

namespace sandstroke {

inline constexpr double gravity = 9.81;  ///< m/s^2, of sand that falls or lies

/// paper: of depth and velocity, as published. rft, archimedes: of the contact (sim/contact_force.h).
enum class ForceLaw { paper, rft, archimedes };
enum class DragDirection { horizontal, full };

/// Constants of the force on the device; the defaults are the paper's (section 4.1).
struct ForceSettings {
  double k_s = 1000.0;  ///< N, repulse force scale
  double k_c = 0.5;     ///< 1/m, its growth with depth
  double k_f = 10.0;    ///< s/m, drag per speed and repulse force
  DragDirection drag = DragDirection::horizontal;
  ForceLaw law = ForceLaw::paper;
};

/// Sand as a device feels it that moves `scale` bed metres per metre: what its motion is resisted by, about a
/// depth.
struct FeltSand {
  double stiffness = 0.0;  ///< K = scale k_s k_c exp(k_c d) [N/m]; 0 above the sand
  double drag = 0.0;       ///< B = scale k_f |F_r| [N s/m], along the directions that are dragged
};
FeltSand felt_sand(double depth, double repulse, double scale, const ForceSettings& settings);

/// Without overflow, and the same bits wherever the vector lies in memory: Eigen's stableNorm() goes by its
/// alignment.
inline double length_of(const Eigen::Vector3d& v) { return elementary::hypot(v.x(), v.y(), v.z()); }

struct SandForce {
  double repulse = 0.0;                             ///< N, upward
  Eigen::Vector3d drag = Eigen::Vector3d::Zero();   ///< N
  Eigen::Vector3d total = Eigen::Vector3d::Zero();  ///< N, on the device, limited to its maximum
  bool saturated = false;                           ///< the limit cut it
  bool limited_drag = false;                        ///< implicit drag was limited to what stops the device
};

/// |F_r| = k_s (exp(k_c d) - 1) for depth d > 0 [m], else 0 (paper eq. 1 with the sign and bracket mended).
/// Infinite where it is beyond any number.
double repulse_force(double depth, const ForceSettings& settings);

/// The depth [m] at which the repulse force is `force` [N] >= 0: the inverse of repulse_force.
double depth_of_repulse_force(double force, const ForceSettings& settings);

/// Work [J] of the repulse force, limited to max_force [N] (0: no limit), over a plunge to depth [m]:
/// k_s ((exp(k_c d) - 1) / k_c - d) as far as the force is below the limit.
double plunge_work(double depth, double max_force, const ForceSettings& settings);

/// Repulse and drag, F_f = -k_f v |F_r| (paper eq. 3), limited in magnitude to max_force [N] (0: no limit).
/// velocity [m/s]: of the tool in the bed. With a limit the total is a number at any depth.
SandForce sand_force(double depth, const Eigen::Vector3d& velocity, double max_force,
                     const ForceSettings& settings);

}  // namespace sandstroke
