#pragma once

// Highway 1.0.3's scalar code calls isnan without saying whose. <math.h> declares it in the global namespace
// only where the compiler finds libstdc++'s before the system's, which a cross compiler need not.
#include <cmath>
using std::isnan;
