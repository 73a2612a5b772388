#pragma once

#include "validation/stress/stress_report.h"

namespace sandstroke {

/// Runs whole simulations on a small bed. A hand plunges a dynamic device into sand, draws it along and holds
/// it; some loops are stable, some are not. Adds cases with their energy account, and traces of both kinds of
/// drag and of the paper's remark (a late loop sinks too deep and is thrown back).
void add_device_cases(StressReport& report);

}  // namespace sandstroke
