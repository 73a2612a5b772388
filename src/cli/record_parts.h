#pragma once

#include <filesystem>
#include <optional>

#include "io/scene_file.h"
#include "record/live_sand.h"
#include "record/recorder.h"

namespace sandstroke {

// The other tasks of `record`, and its report on a recording.

/// `record --list`: prints the connected devices and the stand-ins.
int list_devices(bool json);

/// `record --check`: measures how well this machine keeps a loop with these settings, without a device, for
/// 10 s unless the settings have a duration. felt: a scene whose sand is then compared with the device's
/// limits, or none.
int check_machine(const RecorderSettings& settings, const std::optional<SceneFile>& felt,
                  const DeviceSpecification& device, bool json);

/// Prints a recording as a table or as one JSON object. felt: none without sand.
void print_recording(const RecordingReport& report, const std::optional<LiveSandReport>& felt,
                     const std::filesystem::path& file, bool json);

// Lines of such tables:
/// "SCHED_FIFO 80, memory locked"
std::string scheduling_text(const Scheduling& scheduling);
/// The counts of the ticks by what happened to them, without zeros.
std::string ticks_text(const TickCounts& ticks);
/// "12 us on average, 30 us or less in 99 of 100, 410 us at most; recorded over half a tick late: 3"
std::string lateness_text(const RecordingFooter& footer);

}  // namespace sandstroke
