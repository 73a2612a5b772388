#include "import/gcode_bounds.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include "gcode_tables.h"

namespace sandstroke {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// A square from (10, 20) to (50, 40), after comments.
SampleTable square(const std::string& comments, const std::string& unit = "G21") {
  return gcode_table(comments + "\n" + unit + "\nG1 X10 Y20 F600\nX50\nY40\nX10\nY20\n");
}

constexpr const char* true_comments[] = {
    ";MINX:10\n;MINY:20\n;MAXX:50\n;MAXY:40",           // Cura
    "; Bounds: X10 Y20 to X50 Y40",                     // LightBurn
    "(X min: 10.0, X max: 50.0)\n(Y min 20 Y max 40)",  // posts
    "; min_x = 10\n; max_x = 50.2",
    "; Minimum X 10 Maximum X 50",
};

TEST(GcodeBounds, CommentsThatAgreeAreNothingToTell) {
  for (const char* comments : true_comments) {
    EXPECT_THAT(square(comments).warnings, ElementsAre()) << comments;
    EXPECT_THAT(square(comments, "G20").warnings, ElementsAre()) << comments;  // of inches, too
  }
  EXPECT_THAT(square("; layer 1 of 3, max. speed 900; x-axis min").warnings, ElementsAre());
}

TEST(GcodeBounds, ThePathThatIsDrawnOrAllOfItMayBeMeant) {
  const std::string path = "G21\nM3 S0\nG0 X0 Y0\nG0 X10 Y10\nG1 X90 S500 F600\nG0 X99\n";
  EXPECT_THAT(gcode_table("; Bounds: X10 Y10 to X90 Y10\n" + path).warnings, ElementsAre());
  EXPECT_THAT(gcode_table("; Bounds: X0 Y0 to X99 Y10\n" + path).warnings, ElementsAre());
}

TEST(GcodeBounds, TheStockAndAFrameAroundThePathAreNothingToTell) {
  for (const char* comments : {"(Stock: min X 0 max X 200)", "; Material bounds: X0 Y0 to X300 Y300",
                               "; machine max_x = 500", "(block min x = 10, max x = 500)", "; bed: MAXX:220",
                               "(min X 0 max X 200)\n(min Y 0 max Y 200)", "; Bounds: X5 Y15 to X55 Y45"})
    EXPECT_THAT(square(comments).warnings, ElementsAre()) << comments;
  for (const char* comments : {"(min X 20 max X 200)", "(min X 0 max X 1016)", "(min X 10 max X 200)"})
    EXPECT_THAT(square(comments).warnings, ElementsAre(HasSubstr("its comments say"))) << comments;
}

TEST(GcodeBounds, ADisagreementNamesBoth) {
  for (const char* comments : true_comments) {
    const SampleTable table = gcode_table(std::string(comments) + "\nG1 X254 Y508\nX1270\nY1016\n");
    ASSERT_EQ(table.warnings.size(), 1u) << comments;
    EXPECT_THAT(table.warnings[0], AllOf(HasSubstr("path.gcode: its comments say"), HasSubstr("max x = 50"),
                                         HasSubstr("max x = 1270"), HasSubstr("G20, G21")))
        << comments;
  }
  EXPECT_THAT(square(";MAXX:50\n;MAXY:99").warnings,
              ElementsAre(AllOf(HasSubstr("say max y = 99 mm"), HasSubstr("has max y = 40 mm"))));
}

}  // namespace
}  // namespace sandstroke
