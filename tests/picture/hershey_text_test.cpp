#include "picture/hershey_text.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace sandstroke {
namespace {

TEST(HersheyText, CapitalsStandOnTheBaseLineAndAreOneHigh) {
  const SingleStrokeText text = hershey_text("H");
  double low = 1e9, high = -1e9;
  for (const auto& line : text.polylines)
    for (const auto& point : line) low = std::min(low, point.y()), high = std::max(high, point.y());
  EXPECT_EQ(text.polylines.size(), 3u);  // two uprights and a bar
  EXPECT_DOUBLE_EQ(low, 0.0);
  EXPECT_DOUBLE_EQ(high, 1.0);
}

TEST(HersheyText, LettersFollowEachOther) {
  EXPECT_DOUBLE_EQ(hershey_text("WS").width, hershey_text("W").width + hershey_text("S").width);
  EXPECT_GT(hershey_text(" ").width, 0.0);
  EXPECT_TRUE(hershey_text(" ").polylines.empty());
}

TEST(HersheyText, AFontIsReadOnceForManyTexts) {
  const HersheyFont font("futural");
  for (const char* text : {"W", "S", "WS"}) {
    const SingleStrokeText drawn = font.draw(text), alone = hershey_text(text);
    EXPECT_EQ(drawn.width, alone.width);
    EXPECT_EQ(drawn.polylines, alone.polylines);
  }
}

TEST(HersheyText, RefusesFontsAndLettersThatAreNotThere) {
  EXPECT_THROW(hershey_text("A", "no-such-font"), Error);
  EXPECT_THROW(hershey_text("A", "../futural"), Error);
  EXPECT_THROW(hershey_text("\xff"), Error);
}

}  // namespace
}  // namespace sandstroke
