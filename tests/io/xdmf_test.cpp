#include "io/xdmf.h"

#include <gtest/gtest.h>

#include <regex>

namespace sandstroke {
namespace {

TEST(Xdmf, SaysOfEachStepItsTimeAndItsDatasetOverCellCentresInTheXYPlane) {
  const BedGeometry bed(100, 150, 0.002);
  const std::string text = xdmf_text("a&b.h5", bed, {{0.0, "/surface/initial"}, {0.25, "/surface/final"}});
  EXPECT_TRUE(text.starts_with(xdmf_output.begin));
  EXPECT_NE(text.find(xdmf_output.mark), std::string::npos);
  const std::string number = "([-.0-9e]+)";
  const std::regex step(
      "<Time Value=\"" + number +
      "\"/>\\s*<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"1 100 150\"/>\\s*<Geometry "
      "GeometryType=\"ORIGIN_DXDYDZ\">\\s*<DataItem[^>]*>0 " +
      number + " " + number + "</DataItem>\\s*<DataItem[^>]*>" + number + " " + number + " " + number +
      "</DataItem>[^$]*?Dimensions=\"1 100 150\"[^>]*>a&amp;b.h5:([/a-z]+)</DataItem>");
  std::vector<std::pair<double, std::string>> steps;
  for (std::sregex_iterator found(text.begin(), text.end(), step), end; found != end; ++found) {
    EXPECT_EQ(std::stod((*found)[2]), bed.y_of(0));
    EXPECT_EQ(std::stod((*found)[3]), bed.x_of(0));
    for (int i = 4; i < 7; ++i) EXPECT_EQ(std::stod((*found)[i]), 0.002);
    steps.emplace_back(std::stod((*found)[1]), (*found)[7]);
  }
  EXPECT_EQ(steps, (std::vector<std::pair<double, std::string>>{{0.0, "/surface/initial"},
                                                                {0.25, "/surface/final"}}));
}

TEST(Xdmf, EachStepHasTheFloor) {
  const BedGeometry bed(4, 5, 0.5);
  const std::vector<XdmfStep> steps = {{0.0, "/surface/initial"}, {0.25, "/surface/final"}};
  const auto count = [](const std::string& text, const std::string& words) {
    int found = 0;
    for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++found;
    return found;
  };
  const std::string with = xdmf_text("a.h5", bed, steps, "/surface/floor");
  EXPECT_EQ(count(with, "<Attribute Name=\"floor\""), 2);
  EXPECT_EQ(count(with, ">a.h5:/surface/floor</DataItem>"), 2);
  EXPECT_EQ(count(with, ">a.h5:/surface/final</DataItem>"), 1);
  EXPECT_EQ(count(xdmf_text("a.h5", bed, steps), "floor"), 0);
}

}  // namespace
}  // namespace sandstroke
