#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "import/stroke_of_table.h"

namespace sandstroke {

/// The stroke in a file of samples, with what the settings' second table adds. "-" is standard input. Error:
/// input, naming file and line; io, if it cannot be read.
ImportedStroke import_stroke(const std::filesystem::path& path, const TableSettings& settings);

/// The stroke in the text of one table; `name` stands for the file in messages.
ImportedStroke import_stroke_text(std::string_view text, const std::string& name,
                                  const TableSettings& settings);

}  // namespace sandstroke
