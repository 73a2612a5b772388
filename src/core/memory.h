#pragma once

namespace sandstroke {

/// Of this machine [bytes].
double physical_memory();

}  // namespace sandstroke
