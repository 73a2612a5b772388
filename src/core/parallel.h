#pragma once

#include <tbb/parallel_for.h>

#include <cstddef>
#include <thread>
#include <vector>

namespace sandstroke {

/// Calls body(i) for each i in [0, count), in any order, on as many threads as tbb::global_control allows; on
/// this thread alone if threads are not worth their cost. On return, all is done and visible here.
template <class Body>
void parallel_for(std::size_t count, bool worth_threads, const Body& body) {
  if (!worth_threads || count < 2) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
#ifdef SANDSTROKE_SANITIZE_THREADS
  // The thread sanitizer cannot see how TBB's own library synchronises. There, plain threads take turns.
  constexpr std::size_t threads = 3;
  std::vector<std::jthread> running;
  for (std::size_t first = 0; first < threads; ++first) {
    running.emplace_back([&body, first, count] {
      for (std::size_t i = first; i < count; i += threads) body(i);
    });
  }
#else
  tbb::parallel_for(std::size_t{0}, count, body);
#endif
}

/// Calls body(i) for each i in [0, count) on threads, as above.
template <class Body>
void parallel_for(std::size_t count, const Body& body) {
  constexpr bool worth_threads = true;
  parallel_for(count, worth_threads, body);
}

}  // namespace sandstroke
