#pragma once

#include <cstdint>
#include <vector>

#include "haptics/simulated_device.h"
#include "haptics/stroke.h"

namespace sandstroke {

/// Ticks begin to end - 1.
struct TickRange {
  std::int64_t begin = 0, end = 0;
};

/// The ticks of a stroke in which nothing happens, in order. They are at least half a second away from any
/// sample, between two samples that do not tell the way between them (Stroke::sampled_between). There the
/// hand goes straight, lifted, and feels nothing; only sand may still relax. They depend on stroke and device
/// alone, so runs of one stroke have the same ticks. There are none if the device still swings, or feels
/// forces late. The stroke must have passed check_stroke, and have less than 1e15 ticks.
std::vector<TickRange> idle_ticks(const Stroke& stroke, const DeviceSettings& device);

/// The first tick of a range in which an event of this rate is due; the range's end if there is none.
std::int64_t next_due(const TickRange& ticks, double servo_rate, double rate);

}  // namespace sandstroke
