#pragma once

#include "validation/stress/stress_report.h"

namespace sandstroke {

/// Whole simulations on a small bed: a dynamic device is plunged into sand, drawn along and held, by loops
/// that are stable and loops that are not. Adds cases with their energy account, and traces of the paper's
/// remark (a late loop sinks too deep and is thrown back) and of both kinds of drag.
void add_device_cases(StressReport& report);

}  // namespace sandstroke
