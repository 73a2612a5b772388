#pragma once

#include "haptics/recording.h"

namespace sandstroke {

/// Highest that a loop may have: the watchdog's is the next one.
inline constexpr int highest_loop_priority = 98;
/// Of whom nothing in the loop, however busily it hangs, keeps from looking after it.
constexpr int watchdog_priority(int loop_priority) { return loop_priority + 1; }

/// Asks for the calling thread what a loop that must not wait needs: SCHED_FIFO at this priority (1 to 99; 0:
/// not asked), and this process's memory locked (mlockall); checks what was given. Never fails: what was
/// refused is in the advice, for a loop and its watchdog.
Scheduling ask_for_real_time(int priority, bool lock_memory) noexcept;

}  // namespace sandstroke
