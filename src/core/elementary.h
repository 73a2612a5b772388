#pragma once

namespace sandstroke::elementary {

// With the same bits on every machine, unlike <cmath>'s: by + - * / and sqrt, which are rounded alike
// everywhere, and functions that are exact.

double hypot(double x, double y);            ///< within 0.57 units in the last place
double hypot(double x, double y, double z);  ///< within 2.4

}  // namespace sandstroke::elementary
