#pragma once

#include <filesystem>
#include <string_view>

namespace sandstroke {

/// Refuses text that other programs read: XML, HTML, JSON, JSON lines, Quick Draw's drawings, YAML as
/// rostopic echo prints it, DXF. `text` is the file's beginning, without blanks. Error: input, with the
/// kind's name and a command that makes a table of it.
void refuse_foreign_text(const std::filesystem::path& path, std::string_view text);

}  // namespace sandstroke
