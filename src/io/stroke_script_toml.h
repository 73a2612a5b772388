#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "haptics/stroke_script.h"

namespace sandstroke {

/// All that a script can say, for people.
std::string script_help();

/// Reads a scripted stroke (TOML): script_help().
/// Error: input, naming file, line and key; io where the file cannot be read.
StrokeScript read_stroke_script(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in messages.
StrokeScript parse_stroke_script(std::string_view text, const std::string& name);

}  // namespace sandstroke
