#include "record/switch_press.h"

#include <gtest/gtest.h>

#include <string_view>

namespace sandstroke {
namespace {

/// The first reading (from 0, one each 10 ns) at which switch 1 counts as pressed, or -1. '1': it is down.
int pressed_at(std::string_view readings, std::int64_t debounce) {
  SwitchPress press(1, debounce);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const std::uint32_t others = i % 2 == 0 ? 0xfffffffdU : 0U;  // mean nothing
    if (press.pressed((readings[i] == '1' ? 2U : 0U) | others, 10 * static_cast<std::int64_t>(i))) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

TEST(SwitchPress, CountsOnceItWasDownForLongEnough) {
  EXPECT_EQ(pressed_at("0001111111", 30), 6);
  EXPECT_EQ(pressed_at("0001111111", 31), 7);
  EXPECT_EQ(pressed_at("0001110000", 30), -1);
  EXPECT_EQ(pressed_at("0001", 0), 3);
}

TEST(SwitchPress, DoesNotCountBounces) {
  EXPECT_EQ(pressed_at("0101101110111100000", 40), -1);
  EXPECT_EQ(pressed_at("01011011101111011111", 40), 19);
}

TEST(SwitchPress, DoesNotCountBeforeItWasSeenUp) {
  EXPECT_EQ(pressed_at("1111111111", 30), -1);
  EXPECT_EQ(pressed_at("1111101111", 30), 9);
}

}  // namespace
}  // namespace sandstroke
