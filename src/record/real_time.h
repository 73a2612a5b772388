#pragma once

#include "haptics/recording.h"

namespace sandstroke {

/// The highest priority of a loop: the watchdog has the next one.
inline constexpr int highest_loop_priority = 98;
/// The watchdog's priority: it runs even while the loop hangs and is busy.
constexpr int watchdog_priority(int loop_priority) { return loop_priority + 1; }

/// Whether this process's memory is to be locked (mlockall), so that none of it is swapped out.
enum class MemoryLock { not_asked, asked };

/// Asks for what a loop that must not wait needs: SCHED_FIFO at this priority for the calling thread (1 to
/// 99; 0: not asked), and locked memory. Checks what was given. Never fails: the advice says what was
/// refused, for a loop and its watchdog.
Scheduling ask_for_real_time(int priority, MemoryLock memory) noexcept;

}  // namespace sandstroke
