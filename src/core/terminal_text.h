#pragma once

#include <string>
#include <string_view>

namespace sandstroke {

// What is printed for people may quote a stranger's file: its names, keys, cells. Of that nothing may move
// the cursor, colour or rename the terminal, or turn the direction of writing. Written as \x1b or \u202e are:
// control characters (ASCII's, DEL, U+0080 to U+009F), the embeddings, overrides and isolates of
// bidirectional text, and bytes that are no UTF-8. What goes to standard output or error is passed through
// one of these.

/// Lines, as a table or a help page: tabs and ends of lines stay.
std::string terminal_text(std::string_view text);

/// One line, as a sentence or a name: its ends of lines are escaped too, so that no other can be forged.
std::string terminal_line(std::string_view line);

}  // namespace sandstroke
