#pragma once

#include "haptics/recording.h"

namespace sandstroke {

/// Asks for the calling thread what a loop that must not wait needs: SCHED_FIFO at this priority (1 to 99; 0:
/// not asked), and this process's memory locked (mlockall); checks what was given. Never fails: what was
/// refused is in the advice.
Scheduling ask_for_real_time(int priority, bool lock_memory) noexcept;

}  // namespace sandstroke
