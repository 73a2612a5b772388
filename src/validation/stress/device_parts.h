#pragma once

#include <vector>

#include "validation/stress/device_loop.h"
#include "validation/stress/loop_map.h"
#include "validation/stress/stress_report.h"

namespace sandstroke {

// The parts of stress_device_loop(): boundaries, maps and whole simulations.

/// Makes loops that differ in every setting: servo rate (50 Hz to 20 kHz), mass, damping, hand, scale, delay
/// (0 to 20 ticks), k_c and depth; walls and sand, with and without drag along z. They have no force limit,
/// exact encoders and no dropped ticks. The caller chooses the gain. Every run gives the same loops.
std::vector<LoopSettings> varied_loops(int count);

inline constexpr double pressing_force = 3.0;  ///< N, the largest force in the paper

/// The loop pressed to a depth [m], disturbed so little that the law is linear there.
LoopSettings pressed_to(double depth, const DeviceSettings& device, const ForceSettings& force);
/// The same, pressed with a force [N].
LoopSettings pressed_with(double newton, const DeviceSettings& device, const ForceSettings& force);
/// The same, in sand that the device then feels as stiff as K [N/m]: by force.k_s.
LoopSettings pressed_into(double K, double newton, const DeviceSettings& device, ForceSettings force);

/// The gain up to which Colgate & Schenkel's condition holds (passivity_margin).
double passive_gain(const LoopSettings& settings);

/// Computes the stiffness felt at the measured, the exact and the passive gain.
Boundary boundary_of(const LoopSettings& settings);

/// Plans a map of loops that the eigenvalue foretells, with its boundary and that of passivity.
LoopMapPlan map_by_eigenvalue(std::string name, std::string title, std::string text, MapAxis x, MapAxis y,
                              std::function<LoopSettings(double, double)> loop);

/// Plans maps that show, over pairs of settings, where the device loop is stable, swings or diverges.
std::vector<LoopMapPlan> device_map_plans(bool quick);

/// Runs whole simulations on a small bed. A hand plunges a dynamic device into sand, draws it along and holds
/// it; some loops are stable, some are not. Adds cases with their energy account, and traces of both kinds of
/// drag and of the paper's remark (a late loop sinks too deep and is thrown back).
void add_device_cases(StressReport& report);

}  // namespace sandstroke
