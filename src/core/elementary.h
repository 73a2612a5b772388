#pragma once

namespace sandstroke::elementary {

// Functions with the same bits on every machine. Those of the C library depend on its version, on the
// architecture, and on whether the processor fuses multiplications with additions. All results that go into
// sand, strokes or forces therefore use these functions instead of <cmath>. They use + - * / and sqrt, which
// are rounded alike everywhere, and functions that are exact. All but hypot are computed in 70 to 100 bits
// (DoubleDouble) and rounded once: almost always to the nearest double. exp, expm1, sin and cos take 0.1 to
// 0.2 us, the others up to 1 us.
//
// Arguments that are infinite, not a number or outside the domain give what <cmath> gives.

double sin(double x);  ///< |x| of 2^52 and more is taken modulo the double nearest 2 pi
double cos(double x);
double tan(double x);
double asin(double x);
double acos(double x);
double atan2(double y, double x);
double exp(double x);
double expm1(double x);
double log1p(double x);
double pow(double x, double y);              ///< of x > 0
double hypot(double x, double y);            ///< within 0.57 units in the last place
double hypot(double x, double y, double z);  ///< within 2.4

}  // namespace sandstroke::elementary
