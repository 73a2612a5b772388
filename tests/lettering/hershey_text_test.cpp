#include "lettering/hershey_text.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/error.h"

namespace sandstroke {
namespace {

TEST(HersheyText, CapitalsStandOnTheBaseLineAndAreOneHigh) {
  const SingleStrokeText text = hershey_text("H");
  double low = 1e9, high = -1e9;
  for (const auto& line : text.polylines)
    for (const auto& point : line) {
      low = std::min(low, point.y());
      high = std::max(high, point.y());
    }
  EXPECT_EQ(text.polylines.size(), 3u);  // two uprights and a bar
  EXPECT_DOUBLE_EQ(low, 0.0);
  EXPECT_DOUBLE_EQ(high, 1.0);
}

TEST(HersheyText, APointIsCountedFromTheLeftEdgeAndTheBaseLine) {
  // The font has "12345  9MWRFRT RRYQZR[SZRY": from M to W are 10 units, and 21 to a capital.
  const SingleStrokeText text = hershey_text("!");
  ASSERT_EQ(text.polylines.size(), 2u);
  EXPECT_DOUBLE_EQ(text.width, 10.0 / 21.0);
  EXPECT_EQ(text.polylines[0], (std::vector<Eigen::Vector2d>{{5.0 / 21.0, 1.0}, {5.0 / 21.0, 7.0 / 21.0}}));
  EXPECT_EQ(text.polylines[1].size(), 5u);
  EXPECT_EQ(text.polylines[1].front(), text.polylines[1].back());
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

TEST(HersheyText, OtherFontsAreReadWhereTheyAreInstalled) {
  const std::filesystem::path folder = "/usr/share/hershey-fonts";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "hershey-fonts-data is not installed";
  int fonts = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    const HersheyFont font(file.path().stem().string());
    for (char code = '!'; code < '\x7f'; ++code) {
      SingleStrokeText drawn;
      try {
        drawn = font.draw({&code, 1});
      } catch (const Error&) {  // fonts of signs lack some
      }
      for (const auto& line : drawn.polylines)
        for (const auto& point : line) ASSERT_LT(point.cwiseAbs().maxCoeff(), 3.0) << file << code;
    }
    ++fonts;
  }
  EXPECT_GE(fonts, 32);
  // The font that is part of the program is Debian's.
  std::ostringstream debians;
  debians << std::ifstream(folder / "futural.jhf").rdbuf();
  std::ostringstream ours;
  ours << std::ifstream(SANDSTROKE_SOURCE "/src/lettering/futural.jhf").rdbuf();
  EXPECT_EQ(ours.str(), debians.str());
}

TEST(HersheyText, ALongGlyphGoesOnInTheNextLine) {
  const auto whole = read_jhf("    1  4MWRFRTRZ\n", "own"),
             broken = read_jhf("    1  4MWRF\nRTRZ\r\n", "own");
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].polylines, broken.at(0).polylines);
  EXPECT_EQ(whole[0].polylines.at(0).size(), 3u);
}

TEST(HersheyText, RefusesDamagedFonts) {
  for (const char* jhf :
       {"    1  9MWRF\n", "    1  0\n", "    1 -1MW\n", "    1", "no font at all\n", "    1  1M"})
    EXPECT_THROW(read_jhf(jhf, "own"), Error) << jhf;
  EXPECT_TRUE(read_jhf("", "own").empty());
}

TEST(HersheyText, RefusesFontsAndLettersThatAreNotThere) {
  EXPECT_THROW(hershey_text("A", "no-such-font"), Error);
  EXPECT_THROW(hershey_text("A", "../futural"), Error);
  EXPECT_THROW(hershey_text("\xff"), Error);
  EXPECT_THROW(hershey_text("A", ""), Error);
}

}  // namespace
}  // namespace sandstroke
