#pragma once

#include "validation/stress/device_loop.h"

namespace sandstroke {

// The theory of a device loop, from its settings alone.

/// Largest modulus of an eigenvalue of the loop's exact one-tick map about its rest. Below 1 the loop
/// settles. Per axis the state is (x, v) and the delayed forces, 2 + delay numbers. The force is -k_x x - k_v
/// v (sampled drag: k_x = K, k_v = B; implicit drag: by SimulatedDevice::drag_velocity). Assumes no dropped
/// ticks and exact encoders.
double spectral_radius(const LoopSettings& settings);

/// The gain (with_gain) at which the spectral radius is 1. +infinity if it is below 1 up to a gain of 1e12.
double exact_boundary_gain(const LoopSettings& settings);

/// b + b_h - (K (T/2 + delay) + B) [N s/m], the smaller of both axes: Colgate & Schenkel's condition
/// (passivity.h) about the rest.
double passivity_margin(const LoopSettings& settings);

/// Age [s] of the oldest force that acts within `ticks`: T (1 + delay + longest row of dropped ticks). A
/// spring that acts late by up to this age returns at most K age times the integral of v^2, as |x(t) - x(t -
/// age)| is at most the integral of |v| over the age. If b > K age, the dampers take that: the loop is
/// stable.
double oldest_force(const DeviceSettings& device, std::int64_t ticks);
/// b + b_h - K age [N s/m] along z, with the age of oldest_force().
double margin_by_age(const LoopSettings& settings, std::int64_t ticks);

/// Mean growth per tick of (x, v, held force) against a wall with dropped ticks and no delay. Multiplies the
/// two exact tick maps in random order (the largest Lyapunov exponent, Furstenberg & Kesten 1960, as a
/// factor). Below 1 the loop settles.
double mean_growth_with_drops(const LoopSettings& settings);

/// The largest swing [m], peak to peak, that the encoders' rounding (half a step at most) can cause in a loop
/// that settles: step K sum |h|. h is the closed loop's position after a force of 1 N for one tick.
double swing_of_encoders(const LoopSettings& settings);

/// The number of ticks after which a loop with a gain 5 % off the boundary shows on which side it is, and the
/// free device has forgotten its start.
std::int64_t ticks_to_decide(const LoopSettings& settings);

/// The verdicts of run_loop that the eigenvalue allows. All, if the boundary is within 5 % of the gain, or if
/// `ticks` are too few to show it. Otherwise stable loops are stable. Of the others, a wall's diverges;
/// sand's swings or, without a force limit, may diverge. With a limit it cannot: above the sand only the hand
/// acts, which pulls the device back, and a limited force cannot drive a damped device beyond all bounds.
/// YieldingSand's swings or comes to rest.
std::vector<Verdict> expected_verdicts(const LoopSettings& settings, std::int64_t ticks);

}  // namespace sandstroke
