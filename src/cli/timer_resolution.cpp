#include <hwy/nanobenchmark.h>

// While it is loaded, libhwy measures its clock for benchmarks, by this function: 4 ms of each start of the
// program, which has no use for it. The linker lets this one come first.
uint64_t hwy::platform::TimerResolution() { return 1; }
