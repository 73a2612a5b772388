#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "haptics/stroke_script.h"

namespace sandstroke {

/// Reads a scripted stroke (TOML). Lengths in m, angles in deg, speeds in m/s:
///
///   start = [x, y]   clearance = 0.02   speed = 0.1   travel_speed = 0.2   plunge_speed = 0.05   rate = 1000
///   repeat = 1 depth = 0.006        # or force = 3.0 (N); a number or an array spread along a segment;
///   default for all segments
///
///   [[segment]]          # each: speed, depth or force, wait (s); the kinds:
///   kind = "move"        # to
///   kind = "line"        # to; from (default: where the tool is)
///   kind = "arc"         # centre, radius, start_angle, end_angle
///   kind = "spline"      # points = [[x, y], ...]
///   kind = "text"        # text, at, height; font ("futural"), angle, spacing
///
/// Error: input, naming file, line and key; io where the file cannot be read.
StrokeScript read_stroke_script(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in messages.
StrokeScript parse_stroke_script(std::string_view text, const std::string& name);

}  // namespace sandstroke
