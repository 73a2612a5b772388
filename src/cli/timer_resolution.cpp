#include <hwy/nanobenchmark.h>

// Replaces a function of libhwy. When loaded, libhwy calls it to measure its clock for benchmarks. That takes
// 4 ms of each start, and the program does not need it. The linker prefers this definition.
uint64_t hwy::platform::TimerResolution() { return 1; }
