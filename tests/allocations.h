#pragma once

#include <cstdint>

namespace sandstroke {

/// The number of times that memory was taken so far, by malloc and its kin and so by operator new too.
/// Programs that link this count; not under sanitizers, which bring their own: there nothing is counted.
bool allocations_are_counted();
std::int64_t allocations();                 ///< of all threads
std::int64_t allocations_of_this_thread();  ///< of the calling one

}  // namespace sandstroke
