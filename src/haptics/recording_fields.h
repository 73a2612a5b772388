#pragma once

#include "haptics/recording.h"

namespace sandstroke {

// The fields of a recording's header and footer, under their names in every file: visit(name, field). A field
// is a std::string, double, int, std::int64_t, bool or StopReason. Readers and writers go through this same
// list. Every stroke file also has the first three.

/// Header: RecordingHeader, const if it is only read.
template <class Header, class Visit>
void visit_header(Header& header, const Visit& visit) {
  visit("source", header.source);
  visit("frame", header.device.frame);
  visit("nominal_rate", header.nominal_rate);
  visit("started", header.started);
  visit("started_monotonic", header.started_monotonic);
  visit("device_model", header.device.model);
  visit("device_manufacturer", header.device.manufacturer);
  visit("device_max_force", header.device.max_force);
  visit("device_max_stiffness", header.device.max_stiffness);
  visit("device_max_damping", header.device.max_damping);
  visit("device_workspace_radius", header.device.workspace_radius);
  visit("device_switches", header.device.switches);
  visit("device_measures_velocity", header.device.measures_velocity);
  visit("device_measures_orientation", header.device.measures_orientation);
  visit("device_hand_feels", header.device.hand_feels);
  visit("scheduling", header.scheduling.policy);
  visit("scheduling_priority", header.scheduling.priority);
  visit("scheduling_advice", header.scheduling.advice);
  visit("memory_locked", header.scheduling.memory_locked);
  visit("force_limit", header.force_limit);
  visit("felt_scene", header.felt_scene);
}

/// Footer: RecordingFooter, const if it is only read.
template <class Footer, class Visit>
void visit_footer(Footer& footer, const Visit& visit) {
  visit("stop_reason", footer.reason);
  visit("ticks_elapsed", footer.ticks.elapsed);
  visit("ticks_recorded", footer.ticks.recorded);
  visit("ticks_skipped", footer.ticks.skipped);
  visit("ticks_unread", footer.ticks.unread);
  visit("ticks_dropped", footer.ticks.dropped);
  visit("ticks_late", footer.ticks.late);
  visit("ticks_clamped", footer.ticks.clamped);
  visit("ticks_ramped", footer.ticks.ramped);
  visit("ticks_rate_limited", footer.ticks.rate_limited);
  visit("ticks_refused", footer.ticks.refused);
  visit("ticks_held", footer.ticks.deferred);
  visit("ticks_interlocked", footer.ticks.interlocked);
  visit("lateness_mean", footer.lateness.mean);
  visit("lateness_p99", footer.lateness.p99);
  visit("lateness_max", footer.lateness.max);
}

}  // namespace sandstroke
