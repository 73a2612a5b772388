#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "haptics/recording.h"
#include "haptics/stroke_coverage.h"
#include "haptics/stroke_sampler.h"
#include "io/recording_file.h"

namespace sandstroke {

// The other tasks of `stroke`, and the summary of a stroke.

void add_stroke_info_command(CLI::App& stroke, Command& chosen);
void add_stroke_repair_command(CLI::App& stroke, Command& chosen);

struct StrokeSummary {
  std::size_t samples = 0, drawn_samples = 0;
  double duration = 0.0, median_spacing = 0.0;  // s
  Eigen::Vector3d low, high;                    // m
  std::vector<StrokeGap> gaps;
  PlayedPart played;                               // the part that a run plays
  double least_force = 0.0, greatest_force = 0.0;  // N, magnitude
};
StrokeSummary summarize(const Stroke& stroke);

/// The output of `stroke info --json` for a stroke in that file.
nlohmann::ordered_json stroke_json(const std::string& file, const Stroke& stroke,
                                   const std::optional<RecordingInfo>& recording = {});

/// The counts of a recording's ticks, also for a recording that was cut off.
std::string recorded_ticks_text(const RecordingFooter& footer);

}  // namespace sandstroke
