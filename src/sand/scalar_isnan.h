#pragma once

// Highway 1.0.3's scalar code calls isnan without a namespace. <math.h> declares it in the global namespace
// only if the compiler finds libstdc++'s <math.h> before the system's. A cross compiler need not.
#include <cmath>
using std::isnan;
