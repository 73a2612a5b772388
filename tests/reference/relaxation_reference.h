#pragma once

#include <memory>

#include "sand/relaxation.h"

namespace sandstroke {

/// All laws as they are written down, whole field, cell by cell, by plain passes: the oracle for the engine,
/// which gives the same bits.
std::unique_ptr<Relaxer> make_reference_relaxer(const RelaxationSettings& settings, double cell_size);

}  // namespace sandstroke
