#include "import/hpgl.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <numbers>

#include "complaint.h"

namespace sandstroke {
namespace {

using std::numbers::pi;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

SampleTable plot(const std::string& text) { return parse_hpgl(text, "plot.plt"); }

std::string plot_complaint(const std::string& text) {
  return complaint_of([&] { plot(text); });
}

TEST(Hpgl, LinesInTheUnitOfPlotters) {
  for (const char* text : {"IN;SP1;PU400,800;PD800,800,800,1200;PU;PD400,1200;SP0;",
                           "in;sp1;pu 400 800;pd 800 800 800 1200;pu;pd400 1200",
                           "IN;\nSP1;\nPA400,800;\nPD;\nPA800,800;\nPA800,1200;\nPU;\nPD;PA400,1200;\n",
                           "PU;PR400,800;PD400,0,0,400PUPD;PR-400,0",
                           "\x1B.(\x1B.I81;;17:\x1B%0BIN;VS20;PU400,800PD800,800PD800,1200PUPD400,1200;",
                           "PU400,800;PD800,800,800,1200;PU;PA;PD400,1200"}) {
    const SampleTable table = plot(text);
    EXPECT_THAT(column(table, "x").values, ElementsAre(10, 20, 20, 20, 10)) << text;
    EXPECT_THAT(column(table, "y").values, ElementsAre(20, 20, 30, 30, 30)) << text;
    EXPECT_THAT(table.lifts, ElementsAre(false, false, true, false, true)) << text;
    EXPECT_EQ(column(table, "x").unit, "mm");
    EXPECT_THAT(table.warnings, ElementsAre());
    EXPECT_THAT(table.description, HasSubstr("HPGL: 2 pen strokes, 5 points, 10 x 10 mm, 40 units per mm"));
  }
}

TEST(Hpgl, ArcsAndCircles) {
  EXPECT_NEAR(path_length(plot("PU400,0;PD;AA0,0,90;")), 5 * pi, 1e-2);
  EXPECT_NEAR(path_length(plot("PU400,0;PD;AR-400,0,-180,5;")), 10 * pi, 1e-2);
  const SampleTable arc = plot("PU400,0;PD;AA0,0,90;PD0,0");
  EXPECT_NEAR(column(arc, "y").values[arc.size() - 2], 10.0, 1e-12);
  const SampleTable circle = plot("PU800,800;CI400;PD1200,800;");
  EXPECT_EQ(std::count(circle.lifts.begin(), circle.lifts.end(), true), 2);
  EXPECT_NEAR(path_length(circle), 20 * pi + 10 + 10, 1e-2);
  EXPECT_EQ(path_length(plot("PU0,0;EA400,800;")), 60.0);
  EXPECT_EQ(path_length(plot("PU400,400;ER400,800;")), 60.0);
}

TEST(Hpgl, LabelsAndAreasAreSaidNotToBeDrawn) {
  EXPECT_THAT(plot("PU0,0;LBPD900,900;\x03PD400,0;DT!;LBtext!RA5,5;").warnings,
              ElementsAre(HasSubstr("1 filled areas, 2 labels not drawn")));
  EXPECT_EQ(path_length(plot("PU0,0;LBPD900,900;\x03PD400,0;")), 10.0);
}

TEST(Hpgl, QuotedTextsHoldNoInstructions) {
  for (const char* text : {"IN;CO \"PROFILE 2; PD9,9;\";PU0,0;PD400,0;",
                           "BP1,\"PD9,9 Border\";PU0,0;PD400,0;", "IN;CO\"PU\"\"PE\";PU0,0PD400,0;"}) {
    EXPECT_THAT(column(plot(text), "x").values, ElementsAre(0, 10)) << text;
    EXPECT_TRUE(looks_like_hpgl(text)) << text;
  }
  EXPECT_THAT(plot_complaint("IN;\nCO \"PU;PD400,0;"), HasSubstr("plot.plt:2: a quoted text has no end"));
}

TEST(Hpgl, SaysWhatIsWrong) {
  EXPECT_THAT(plot_complaint("IN;\nSC0,100,0,100;PD5,5;"),
              AllOf(HasSubstr("plot.plt:2: SC scales"), HasSubstr("1/40 mm")));
  EXPECT_EQ(plot_complaint("IN;SC;RO0;PD5,5;"), "");
  EXPECT_THAT(plot_complaint("RO90;PD5,5;"), HasSubstr("turns the plot"));
  EXPECT_THAT(plot_complaint("PE<=abc;"), HasSubstr("encoded"));
  EXPECT_THAT(plot_complaint("PM0;PD5,5;"), HasSubstr("polygon"));
  EXPECT_THAT(plot_complaint("PD5,5,5;"), HasSubstr("only one coordinate"));
  EXPECT_THAT(plot_complaint("PD;AA5,5;"), HasSubstr("AA needs 3 numbers"));
  EXPECT_THAT(plot_complaint("PD;AA5,5,4000;"), HasSubstr("more than 360 degrees"));
  EXPECT_THAT(plot_complaint("IN;PU5,5;"), HasSubstr("no lines to draw"));
}

TEST(Hpgl, IsKnownByItsInstructions) {
  for (const char* text :
       {"IN;SP1;PU0,0;", "\x1B.(;IN;PD5,5", "PU;PA5,5", "SP1;PD0,0", "IN;\nSP1;\nPU5,5;",
        "PU 400 800 PD 800 800", "PU-4,8PD+8,.5\nPD1,2", "\x1B.I81;;17:SP1PU0,0", "PD0,0,\n5,5;"})
    EXPECT_TRUE(looks_like_hpgl(text)) << text;
  for (const char* text : {"IN;OUT\n1;2\n", "x,y\n1,2\n", "SPEED x\n1 2\n", "",
                           "PATIENT,t_s,x_mm,y_mm\nPD01,0,1,2\nPD01,1,2,2\n", "PD;x_mm;y_mm;t_s\n1;2;3;4\n",
                           "PU x_mm y_mm\n1 2 3\n", "PU;PA;PD;\n1;2;3;\n", "PU PA PD\n0 1 2\n",
                           "PU,PA,PD\n1,2,3\n", "SPOT\tPD0\n1\t2\n"})
    EXPECT_FALSE(looks_like_hpgl(text)) << text;
}

}  // namespace
}  // namespace sandstroke
