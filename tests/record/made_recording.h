#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "haptics/recording.h"

namespace sandstroke {

/// A header in which every field says something.
inline RecordingHeader full_header() {
  RecordingHeader header;
  header.device = {"Möbius 3", "A \"maker\"", "device", 12.5, 1e3 / 3.0, 7.5, 0.08, 4, true, true};
  header.source = "scripted:wscg.toml";
  header.started = "2026-11-21T18:00:00.250Z";
  header.started_monotonic = 1e6 / 3.0;
  header.nominal_rate = 999.5;
  header.scheduling = {"SCHED_FIFO", 80, true, "all was given\nthat was asked"};
  header.force_limit = 3.3;
  header.felt_scene = "[bed]\nsize = [1.0, 1.0]\n";
  return header;
}

inline RecordingFooter full_footer() {
  RecordingFooter footer;
  footer.ticks = {40, 20, 10, 7, 3, 6, 5, 4, 3, 2, 1, 8};
  footer.lateness = {1e-6 / 3.0, 2e-5, 3e-4};
  footer.reason = StopReason::stop_switch;
  return footer;
}

/// Samples that are all different, with numbers of any size, and every second tick missing.
inline std::vector<RecordedSample> made_samples(int count) {
  std::vector<RecordedSample> samples;
  for (int i = 0; i < count; ++i) {
    RecordedSample sample;
    sample.sequence = static_cast<std::uint64_t>(2 * i);
    sample.time = (std::int64_t{1} << 52) + std::int64_t{2000003} * i;
    for (int axis = 0; axis < 3; ++axis) {
      sample.position[axis] = std::sin(i + axis) / 3.0;
      sample.velocity[axis] = std::ldexp(1.0 + i, -1060 + axis);
      sample.force[axis] = -1e300 / (1 + i + axis);
    }
    const double half = 0.1 * i;
    const double turn[] = {0.0, std::sin(half), 0.0, std::cos(half)};
    std::copy(turn, turn + 4, sample.orientation);
    sample.switches = i == 0 ? 0xffffffffu : static_cast<std::uint32_t>(i);
    sample.flags = static_cast<std::uint32_t>(i % 256);
    samples.push_back(sample);
  }
  return samples;
}

inline bool same_bytes(const std::vector<RecordedSample>& a, const std::vector<RecordedSample>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(RecordedSample)) == 0);
}

}  // namespace sandstroke
