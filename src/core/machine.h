#pragma once

#include <string>

namespace sandstroke {

/// Of this machine [bytes].
double physical_memory();

/// As the system calls it; "unknown" where it does not say.
std::string cpu_name();

}  // namespace sandstroke
