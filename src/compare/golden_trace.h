#pragma once

#include <vector>

#include "sand/height_field.h"
#include "sim/run_result.h"

namespace sandstroke {

// A trace as a table of whole numbers that packs well, as golden.h5 holds it. It has a column per tick, and
// these rows:
//
//   0        the tick's number, which is its time times the servo rate
//   1 to 3   device_force in steps of 2^-17 N
//   4        level in steps of 2^-27 m; while the tool is lifted (level is NaN), the last level before
//   5        level - depth, the tip's height, in steps of 2^-27 m
//   6        0 above the sand, 1 in contact, 2 lifted
//
// Each row holds the second differences of its numbers; before the first tick all numbers are 0. A difference
// d is stored as 2 d, or as -2 d - 1 where it is negative. So the table holds small numbers without a sign.
// A tick takes 3 bytes. It would take 4.6 in steps of 2^-20 N and 2^-30 m, and 18 as float64.
inline constexpr double trace_force_quantum = 0x1p-17;   // N
inline constexpr double trace_height_quantum = 0x1p-27;  // m

/// servo_rate: Hz. name: the run's, for messages. Error: input, where a tick's time is no whole multiple of
/// the servo period, or a force, depth or level is not finite or above 2^50 steps.
HeightGrid packed_trace(const std::vector<TickRecord>& trace, double servo_rate, const std::string& name);

/// Unpacks time, device_force, depth, level and contact of every tick; the other fields keep their defaults.
/// The time is exact, all else is within half a step.
std::vector<TickRecord> unpacked_trace(const HeightGrid& table, double servo_rate);

inline constexpr Eigen::Index packed_trace_rows = 7;

}  // namespace sandstroke
