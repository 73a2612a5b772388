#pragma once

#include <filesystem>
#include <optional>

#include "record/live_sand.h"
#include "record/recorder.h"

namespace sandstroke {

// What `record` does besides recording, and how it tells of a recording.

/// `record --list`: the devices that are connected, and the stand-ins.
int list_devices(bool json);

/// `record --check`: what this machine does to a loop with these settings but without a device, in 10 s where
/// they say no duration. felt: a scene whose sand is then held against the limits of this device; may be
/// none.
int check_machine(const RecorderSettings& settings, const std::optional<Scene>& felt,
                  const DeviceSpecification& device, bool json);

/// On the standard output, as a table or as one JSON object. felt: none, where no sand was.
void print_recording(const RecordingReport& report, const std::optional<LiveSandReport>& felt,
                     const std::filesystem::path& file, bool json);

// Lines of such tables:
/// "SCHED_FIFO 80, memory locked"
std::string scheduling_text(const Scheduling& scheduling);
/// Where the ticks went, without what did not happen.
std::string ticks_text(const TickCounts& ticks);
/// "12 us on average, 30 us or less in 99 of 100, 410 us at most; recorded over half a tick late: 3"
std::string lateness_text(const RecordingFooter& footer);

}  // namespace sandstroke
