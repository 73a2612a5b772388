#include "import/inkml.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include "complaint.h"

namespace sandstroke {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

SampleTable ink(const std::string& inside) {
  return parse_inkml("<ink xmlns='http://www.w3.org/2003/InkML'>\n" + inside + "\n</ink>", "pen.inkml");
}

TEST(Inkml, TracesOfXAndY) {
  const SampleTable table =
      ink("<traceGroup><trace>10 0, 9 14,\n 8.5 -28</trace></traceGroup><trace>1 2</trace>");
  EXPECT_THAT(column(table, "x").values, ElementsAre(10, 9, 8.5, 1));
  EXPECT_THAT(column(table, "y").values, ElementsAre(0, -14, 28, -2));
  EXPECT_THAT(table.lifts, ElementsAre(false, false, true, true));
  EXPECT_THAT(table.description, HasSubstr("2 pen strokes, 4 samples"));
}

/// The example of the recommendation (W3C 2011, 3.2.1): positions, then differences, then differences of
/// these.
TEST(Inkml, DifferencesOfFirstAndSecondOrder) {
  const SampleTable table = ink("<trace>1125 18432,'23'43,\"7\"-8,3-5,7 -3,6 2,6 8,3 6</trace>");
  EXPECT_THAT(column(table, "x").values, ElementsAre(1125, 1148, 1178, 1211, 1251, 1297, 1349, 1404));
  EXPECT_THAT(column(table, "y").values,
              ElementsAre(-18432, -18475, -18510, -18540, -18567, -18596, -18633, -18676));
}

TEST(Inkml, MarksStayInForceAndStarsRepeat) {
  const SampleTable table = ink("<trace>5 5, '1 *, * '2, !7 *</trace>");
  EXPECT_THAT(column(table, "x").values, ElementsAre(5, 6, 7, 7));
  EXPECT_THAT(column(table, "y").values, ElementsAre(-5, -5, -7, -9));
}

TEST(Inkml, ChannelsHaveNamesAndUnits) {
  const SampleTable table =
      ink("<inkml:inkSource xmlns:inkml='u'><inkml:traceFormat><inkml:channel name='X' type='integer' "
          "units='cm'/>"
          "<inkml:channel name='Y' units='cm'/><inkml:channel name='F' units='dev'/><inkml:channel name='T'/>"
          "<inkml:intermittentChannels><inkml:channel "
          "name='OTx'/></inkml:intermittentChannels></inkml:traceFormat>"
          "<inkml:channelProperties><inkml:channelProperty channel='X' name='resolution' value='100' "
          "units='1/mm'/>"
          "</inkml:channelProperties></inkml:inkSource><inkml:trace xmlns:inkml='u'>50 2 700 0, 60 3 710 5 "
          "99</inkml:trace>");
  ASSERT_EQ(table.columns.size(), 4u);
  EXPECT_THAT(column(table, "x").values, ElementsAre(0.5, 0.6));
  EXPECT_EQ(column(table, "x").unit, "mm");
  EXPECT_EQ(column(table, "y").unit, "cm");
  EXPECT_THAT(column(table, "y").values, ElementsAre(-2, -3));
  EXPECT_THAT(column(table, "pressure").values, ElementsAre(700, 710));
  EXPECT_EQ(column(table, "pressure").unit, "");
  EXPECT_THAT(column(table, "time").values, ElementsAre(0, 5));
  EXPECT_EQ(column(table, "time").unit, "ms");
}

/// The recommendation's table of channels: x grows to the right, y downwards, z upwards, if the orientation
/// is not "-ve".
TEST(Inkml, InkIsUprightInAnyUnit) {
  for (const char* unit : {"cm", "mm", "in", "dev"})
    for (const bool up : {false, true}) {
      const SampleTable table = ink(fmt::format(
          "<traceFormat><channel name='X' units='{0}'/><channel name='Y' units='{0}' orientation='{1}'/>"
          "<channel name='Z'/></traceFormat><trace>1 2 3, 4 5 6</trace>",
          unit, up ? "-ve" : "+ve"));
      EXPECT_THAT(column(table, "x").values, ElementsAre(1, 4)) << unit;
      EXPECT_THAT(column(table, "y").values, ElementsAre(up ? 2 : -2, up ? 5 : -5)) << unit;
      EXPECT_THAT(column(table, "z").values, ElementsAre(3, 6)) << unit;
      EXPECT_THAT(table.description, HasSubstr(up ? "y points up (orientation -ve) in the file"
                                                  : "y points down in the file and is negated"));
    }
  EXPECT_THAT(column(ink("<traceFormat><channel name='X' orientation='-ve'/><channel name='Y'/></traceFormat>"
                         "<trace>1 2</trace>"),
                     "x")
                  .values,
              ElementsAre(-1));
}

TEST(Inkml, ValuesBeyondTheirChannelAreSaid) {
  const std::string format =
      "<traceFormat><channel name='X' max='100'/><channel name='Y' min='-5' max='5'/></traceFormat>"
      "<channelProperties><channelProperty channel='X' name='resolution' value='7' units='1/mm'/>"
      "<channelProperty channel='Y' name='resolution' value='7' units='1/mm'/></channelProperties>";
  EXPECT_THAT(ink(format + "<trace>0 -5, 100 5</trace>").warnings, ElementsAre());
  EXPECT_THAT(ink(format + "<trace>0 -5, 250 6</trace>").warnings,
              ElementsAre(AllOf(HasSubstr("channel of x has values from 0 to 250"), HasSubstr("any to 100")),
                          AllOf(HasSubstr("channel of y has values from -5 to 6"), HasSubstr("-5 to 5"))));
}

TEST(Inkml, TheRateGivesTimesThatAreNotWritten) {
  const std::string rate = "<sampleRate uniform='true' value='100'/>";
  EXPECT_THAT(column(ink(rate + "<trace>1 1, 2 2</trace><trace>3 3</trace>"), "time").values,
              ElementsAre(0, 0.01, 0.02));
  const SampleTable offset =
      ink(rate + "<trace timeOffset='0'>1 1, 2 2</trace><trace timeOffset='500'>3 3, 4 4</trace>");
  EXPECT_THAT(column(offset, "time").values, ElementsAre(0, 0.01, 0.5, 0.51));
  EXPECT_EQ(column(offset, "time").unit, "s");
}

TEST(Inkml, TracesMayGoOnOrBeInTheAir) {
  const SampleTable table =
      ink("<trace continuation='begin'>1 1</trace><trace type='penDown' continuation='end'>2 2</trace>"
          "<trace type='penUp'>9 9</trace><trace>3 3</trace>");
  EXPECT_THAT(column(table, "x").values, ElementsAre(1, 2, 3));
  EXPECT_THAT(table.lifts, ElementsAre(false, true, true));
}

TEST(Inkml, SaysWhatIsWrong) {
  const auto complaint = [](const std::string& text) { return complaint_of([&] { ink(text); }); };
  EXPECT_THAT(complaint("<trace>1 2, 3</trace>"), AllOf(HasSubstr("trace 1, point 2"), HasSubstr("'3'")));
  EXPECT_THAT(complaint("<trace>1 2, ? 3</trace>"), HasSubstr("point 2"));
  EXPECT_THAT(complaint("<trace>1 2, nan 3</trace>"), HasSubstr("point 2"));
  EXPECT_THAT(complaint("<trace>1 2"), HasSubstr("pen.inkml:3: is not valid XML"));
  EXPECT_THAT(complaint(""), HasSubstr("no points"));
  EXPECT_THAT(complaint("<traceFormat><channel name='X'/></traceFormat><trace>1</trace>"),
              HasSubstr("X and Y"));
  EXPECT_THAT(
      complaint("<traceFormat><channel name='X'/><channel name='Y'/></traceFormat>"
                "<traceFormat><channel name='Y'/><channel name='X'/></traceFormat><trace>1 1</trace>"),
      HasSubstr("several formats"));
}

TEST(Inkml, DeepNestsAreNoTrouble) {
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "<g>";
  EXPECT_THAT(complaint_of([&] { ink(deep); }), HasSubstr("not valid XML"));
}

}  // namespace
}  // namespace sandstroke
