#include "record/spsc_ring.h"

#include <gtest/gtest.h>

#include <thread>

namespace sandstroke {
namespace {

TEST(SpscRing, GivesBackInOrderWhatItTookAndRefusesWhatDoesNotFit) {
  SpscRing<int> ring(3);
  ASSERT_EQ(ring.capacity(), 4u);
  int item = 0;
  EXPECT_FALSE(ring.pop(item));
  for (int round = 0; round < 5; ++round) {  // around its end, too
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(ring.push(10 * round + i));
    EXPECT_FALSE(ring.push(99));
    EXPECT_EQ(ring.room(), 0u);
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(ring.pop(item));
      EXPECT_EQ(item, 10 * round + i);
    }
    ASSERT_TRUE(ring.pop(item));
    EXPECT_FALSE(ring.pop(item));
  }
}

TEST(SpscRing, LosesNothingBetweenTwoThreads) {
  SpscRing<int> ring(64);
  constexpr int count = 20'000;
  std::thread filler([&] {
    for (int i = 0; i < count;)
      if (ring.push(i))
        ++i;
      else
        std::this_thread::yield();
  });
  for (int expected = 0; expected < count;) {
    int item = -1;
    if (!ring.pop(item)) {
      std::this_thread::yield();
      continue;
    }
    ASSERT_EQ(item, expected);
    ++expected;
  }
  filler.join();
  EXPECT_EQ(ring.size(), 0u);
}

}  // namespace
}  // namespace sandstroke
