#include "core/error.h"

#include "core/terminal_text.h"

namespace sandstroke {

Error::Error(ErrorKind kind, const std::string& sentence)
    : std::runtime_error(terminal_line(sentence)), kind_(kind) {}

}  // namespace sandstroke
