#pragma once

#include <chrono>
#include <stop_token>

namespace sandstroke {

/// Sleeps, in a thread that works by turns. Returns false at once when the thread is asked to stop.
bool sleep_unless_stopped(const std::stop_token& stop, std::chrono::nanoseconds time);

}  // namespace sandstroke
