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

// What `stroke` does besides making strokes.

void add_stroke_info_command(CLI::App& stroke, Command& chosen);
void add_stroke_repair_command(CLI::App& stroke, Command& chosen);

struct StrokeSummary {
  std::size_t samples = 0, drawn_samples = 0;
  double duration = 0.0, median_spacing = 0.0;  // s
  Eigen::Vector3d low, high;                    // m
  std::vector<StrokeGap> gaps;
  PlayedPart played;                               // of a run
  double least_force = 0.0, greatest_force = 0.0;  // N, magnitude
};
StrokeSummary summarize(const Stroke& stroke);

/// What `stroke info --json` prints of a stroke that is in that file.
nlohmann::ordered_json stroke_json(const std::string& file, const Stroke& stroke,
                                   const std::optional<RecordingInfo>& recording = {});

/// Where a recording's ticks went, also of one that was cut off.
std::string recorded_ticks_text(const RecordingFooter& footer);

}  // namespace sandstroke
