#pragma once

#include "validation/stress/device_loop.h"

namespace sandstroke {

// What theory says about a device loop, from its settings alone.

/// Largest modulus of an eigenvalue of the exact one-tick map of the loop about its rest: below 1, it
/// settles. Per axis the state is (x, v) and the forces that are under way, 2 + delay in all; the force is
/// -k_x x - k_v v (sampled drag: k_x = K, k_v = B; implicit drag: as SimulatedDevice::drag_velocity has it).
/// Presumes no dropped ticks and exact encoders.
double spectral_radius(const LoopSettings& settings);

/// The gain (with_gain) at which the spectral radius is 1. +infinity where it is below 1 up to a gain of
/// 1e12.
double exact_boundary_gain(const LoopSettings& settings);

/// b + b_h - (K (T/2 + delay) + B) [N s/m], the smaller of both axes: Colgate & Schenkel's condition
/// (passivity.h) about the rest.
double passivity_margin(const LoopSettings& settings);

/// [s], the age of the oldest force that acts in so many ticks: T (1 + delay + longest row of dropped ticks).
/// A spring that acts up to an age late returns at most K age times the integral of v^2 (|x(t) - x(t - age)|
/// is at most the integral of |v| over it), and the dampers take that if b > K age: then the loop is stable.
double oldest_force(const DeviceSettings& device, std::int64_t ticks);
/// b + b_h - K age [N s/m], of the oldest force in so many ticks, along z.
double margin_by_age(const LoopSettings& settings, std::int64_t ticks);

/// Against a wall with dropped ticks and no delay: the mean growth per tick of (x, v, held force) under
/// products of the two exact tick maps in random order (the largest Lyapunov exponent, Furstenberg & Kesten
/// 1960, as a factor). Below 1, the loop settles.
double mean_growth_with_drops(const LoopSettings& settings);

/// m, peak to peak: the encoders' rounding, at most half a step either way, cannot make a loop that settles
/// swing more: step K sum |h|, h the closed loop's position after a force of one newton for one tick.
double swing_of_encoders(const LoopSettings& settings);

/// So many ticks that a loop whose gain is 5 % off the boundary shows on which side it is, and that the free
/// device has forgotten how it began.
std::int64_t ticks_to_decide(const LoopSettings& settings);

/// What the eigenvalue lets expect of run_loop: where the boundary is within 5 % of the gain, or so many
/// ticks would not show it, anything. Else the loop is stable, or it is not, and then a wall's diverges;
/// sand's swings, or diverges where no force limit holds it: above the sand only the hand acts, which pulls
/// the device back, and a limited force cannot drive it beyond all bounds, as its own motion is damped.
std::vector<Verdict> expected_verdicts(const LoopSettings& settings, std::int64_t ticks);

}  // namespace sandstroke
