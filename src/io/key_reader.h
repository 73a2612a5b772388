#pragma once

#include "io/key_table.h"
#include "io/toml_reader.h"

namespace sandstroke {

/// Gives each key that is shown the value in the file, if there is one. Error: input, as TomlReader says it.
void read_keys(const TomlReader& toml, const ShowKeys& show);

}  // namespace sandstroke
