#pragma once

#include <string>

namespace sandstroke {

/// The instruction set that the kernels use on this machine ("AVX3", "AVX2", "SSE4"). It changes the speed
/// only.
std::string instruction_set();

}  // namespace sandstroke
