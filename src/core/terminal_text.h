#pragma once

#include <string>
#include <string_view>

namespace sandstroke {

// Text for people may quote a stranger's file: its names, keys, cells. Nothing in it may move the cursor,
// colour or rename the terminal, or turn the direction of writing. These functions escape (\x1b, \u202e)
// control characters (ASCII's, DEL, U+0080 to U+009F), the embeddings, overrides and isolates of
// bidirectional text, and bytes that are not UTF-8. All text for standard output or error passes through one
// of these.

/// For lines, such as a table or a help page: keeps tabs and ends of lines.
std::string terminal_text(std::string_view text);

/// For one line, such as a sentence or a name: escapes ends of lines too, so that nobody can forge another
/// line.
std::string terminal_line(std::string_view line);

}  // namespace sandstroke
