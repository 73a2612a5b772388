#pragma once

#include "sim/scene.h"
#include "sim/tool_force.h"

namespace sandstroke {

/// Makes what the sand does to the tool by the scene's force.law:
/// - paper: nothing but what depth and velocity give the device (DeviceForce): no wrench.
/// - rft: resistive force theory over the tool's surface (ResistiveForce).
/// - archimedes: 0.87574 xi V upwards at the centroid of V, which is what lies below the sand's plane (Kang,
///   Feng, Liu, Blumenfeld, Nature Communications 9, 2018, as the theory gives it for a plate), and no drag;
///   it grows over the yield way as the tool sinks, and goes as it rises.
/// Elements of the surface are about a cell large. Wrench::given is what the scene's device gives of it
/// (device.max_force). Both go by way of an ElasticWrench, and take energy along any closed path.
std::unique_ptr<ToolForce> make_contact_force(const Scene& scene, double cell_size);

}  // namespace sandstroke
