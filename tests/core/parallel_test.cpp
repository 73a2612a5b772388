#include "core/parallel.h"

#include <gtest/gtest.h>

#include <vector>

namespace sandstroke {
namespace {

TEST(ParallelFor, DoesEachOnceAndIsSeenAfterwards) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{3}, std::size_t{1000}}) {
    for (const bool worth_threads : {false, true}) {
      std::vector<int> visits(count, 0);
      parallel_for(count, worth_threads, [&](std::size_t i) { visits[i] += 1; });
      EXPECT_EQ(visits, std::vector<int>(count, 1));
    }
  }
}

}  // namespace
}  // namespace sandstroke
