#include "compare/image_difference.h"

#include <gtest/gtest.h>

#include "compare/run_checks.h"
#include "core/error.h"

namespace sandstroke {
namespace {

bool passes(const Image& golden, const Image& run) {
  return Comparison{"pictures", picture_checks(golden, run, Tolerances{})}.passed();
}

TEST(ImageDifference, FindsTheChannelThePixelAndTheFraction) {
  const Image golden(20, 10);
  Image run = golden;
  run.pixel(3, 4)[1] = 7;
  run.pixel(13, 9)[2] = 200;
  const ImageDifference difference = image_difference(golden, run);
  EXPECT_EQ(difference.max, 200);
  EXPECT_EQ(difference.x, 13);
  EXPECT_EQ(difference.y, 9);
  EXPECT_DOUBLE_EQ(difference.fraction, 2.0 / 200.0);
  EXPECT_EQ(image_difference(run, golden).max, 200) << "the sign does not matter";
  EXPECT_EQ(image_difference(run, run).fraction, 0.0);
}

TEST(ImageDifference, RefusesDifferentSizes) {
  EXPECT_THROW(image_difference(Image(4, 3), Image(3, 4)), Error);
  EXPECT_THROW(image_difference(Image(), Image()), Error);
}

TEST(PictureChecks, HoldUpToBothLimitsAndNotBeyond) {
  const Image golden(100, 100);  // 0.1 % are 10 pixels
  Image run = golden;
  EXPECT_TRUE(passes(golden, run));
  for (int i = 0; i < 10; ++i) run.pixel(i, 50)[0] = 2;
  EXPECT_TRUE(passes(golden, run));
  run.pixel(10, 50)[0] = 1;
  EXPECT_FALSE(passes(golden, run)) << "11 pixels";
  run = golden;
  run.pixel(99, 99)[2] = 3;
  EXPECT_FALSE(passes(golden, run)) << "3/255 in one pixel";
}

TEST(ImageDifference, AlphaCountsAsAChannelAndNoColourWhereNothingIsSeen) {
  const Image opaque(4, 2);
  Image strip = opaque;
  strip.alpha.assign(8, 255);
  EXPECT_EQ(image_difference(opaque, strip).max, 0) << "no alpha is opaque";
  for (int x = 0; x < 4; ++x) strip.alpha[static_cast<std::size_t>(4 + x)] = 0;
  const ImageDifference difference = image_difference(opaque, strip);
  EXPECT_EQ(difference.max, 255);
  EXPECT_EQ(difference.y, 1);
  EXPECT_EQ(difference.fraction, 0.5);
  EXPECT_EQ(image_difference(strip, opaque).max, 255);
  Image hidden = strip;
  hidden.pixel(2, 1)[0] = 99;
  EXPECT_EQ(image_difference(strip, hidden).max, 0);
  hidden.alpha[6] = 1;
  EXPECT_EQ(image_difference(strip, hidden).max, 99);
}

TEST(PictureChecks, CanSayThatAFractionOfThePixelsMayDifferByMoreThanALimit) {
  const Image golden(100, 100);
  const Tolerances tolerances{.pixel = 255.0, .pixel_share = 0.001, .pixel_above = 2.0};
  const auto accepts = [&](const Image& run) {
    return Comparison{"pictures", picture_checks(golden, run, tolerances)}.passed();
  };
  Image run = golden;
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) run.pixel(x, y)[1] = 2;
  EXPECT_TRUE(accepts(run)) << "all differ by 2";
  for (int x = 0; x < 10; ++x) run.pixel(x, 0)[1] = 200;
  EXPECT_TRUE(accepts(run)) << "0.1 %";
  run.pixel(10, 0)[1] = 3;
  EXPECT_FALSE(accepts(run)) << "11 pixels";
  const std::vector<Check> checks = picture_checks(golden, run, tolerances);
  EXPECT_EQ(checks[1].sentence, "0.11 % of the pixels differ by more than 2/255");
}

TEST(PictureChecks, FailForABlockOf8x8InAGoldenPicture) {
  const Image golden(720, 405);
  Image run = golden;
  for (int y = 200; y < 208; ++y)
    for (int x = 100; x < 108; ++x) run.pixel(x, y)[0] = 10;
  const std::vector<Check> checks = picture_checks(golden, run, Tolerances{});
  ASSERT_FALSE((Comparison{"", checks}.passed()));
  EXPECT_NE(checks[0].sentence.find("x = 100, y = 200"), std::string::npos) << checks[0].sentence;
}

}  // namespace
}  // namespace sandstroke
