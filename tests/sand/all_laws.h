#pragma once

#include <gtest/gtest.h>

#include <string>

#include "sand/relaxation.h"

namespace sandstroke {

inline constexpr RelaxationLaw all_laws[] = {RelaxationLaw::paper, RelaxationLaw::isotropic,
                                             RelaxationLaw::faces};

inline std::string name_of(RelaxationLaw law) { return relaxation_law_names[static_cast<int>(law)]; }

/// The name of a test for each of them.
inline std::string law_name(const testing::TestParamInfo<RelaxationLaw>& law) { return name_of(law.param); }

}  // namespace sandstroke
