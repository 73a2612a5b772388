#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "haptics/stroke_script.h"
#include "io/key_table.h"

namespace sandstroke {

/// Every key that a script can have.
std::vector<KeySection> script_keys();

/// Reads a scripted stroke (TOML): script_keys().
/// Error: input, naming file, line and key; io where the file cannot be read.
StrokeScript read_stroke_script(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in messages.
StrokeScript parse_stroke_script(std::string_view text, const std::string& name);

}  // namespace sandstroke
