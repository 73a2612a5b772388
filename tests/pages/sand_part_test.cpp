#include "pages/sand_part.h"

#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bed_on_stones.h"
#include "browser.h"
#include "core/asset.h"
#include "core/error.h"
#include "pages/page_of_parts.h"

SANDSTROKE_DECLARE_ASSET(run);

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;

/// A slope along x, 1 mm a cell, that is `lift` [m] higher where y > 0.
HeightField slope(int rows, int cols, double lift) {
  HeightGrid heights(rows, cols);
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < cols; ++col) heights(row, col) = 1e-3 * col + (2 * row >= rows ? lift : 0.0);
  return HeightField(heights, 0.002);
}

std::string page_of(const Json& part) {
  PageOfParts page{SANDSTROKE_ASSET(run), "sand", {}};
  page.data = {{"figures", Json::array()},
               {"parts", {part}},
               {"missing", Json::array()},
               {"scene", ""},
               {"provenance", Json::array()}};
  return page.html();
}

TEST(SandPart, SaysTheBedAsItIsUpToItsLargestSide) {
  SandPart part("Sand", "", slope(40, 60, 0.0));
  part.add("one", slope(40, 60, 0.0));
  const Json json = part.json();
  EXPECT_EQ(json["rows"], 40);
  EXPECT_EQ(json["cols"], 60);
  EXPECT_DOUBLE_EQ(json["cell_size"], 0.002);
  EXPECT_DOUBLE_EQ(json["x0"], -0.059);
  EXPECT_DOUBLE_EQ(json["y0"], -0.039);
  EXPECT_DOUBLE_EQ(json["low"], 0.0);
  EXPECT_DOUBLE_EQ(json["high"], 0.059);
}

TEST(SandPart, TakesMeansOfAsFewCellsAsItMay) {
  const HeightField bed(1026, 513, 0.001);
  const Json json = SandPart("Sand", "", bed).json();  // three by three
  EXPECT_EQ(json["rows"], 342);
  EXPECT_EQ(json["cols"], 171);
  EXPECT_DOUBLE_EQ(json["cell_size"], 0.003);
}

class SandPartInBrowser : public BrowserTest {};

TEST_F(SandPartInBrowser, StonesAreGrayWhereTheyAreBareAndTheBottomIsOfWood) {
  const HeightField bed = [] {
    constexpr double bottom = -0.01;
    HeightField made = sand_with_a_stone(80, 120, 0.002, 0.03, -0.01, bottom);
    for (int row = 0; row < 80; ++row)
      for (int col = 0; col < 30; ++col) made.set(row, col, bottom);
    return made;
  }();
  SandPart part("Sand", "A stone.", bed);
  part.add("one", bed);
  EXPECT_FALSE(SandPart("Sand", "", HeightField(80, 120, 0.002)).json().contains("floor"));
  browser().open_text(page_of(part.json()));
  browser().wait_for("sandParts[0].ready");
  browser().evaluate("sandParts[0].view.drawNow()");
  // What the light of a cell is kept as: red, green, blue.
  const auto colour = [&](int row, int col) {
    return browser()
        .evaluate(fmt::format("sandParts[0].view.picture.colourOf({}, {})", row, col))
        .get<std::vector<int>>();
  };
  const std::vector<int> stone = colour(40, 60), sand = colour(10, 110), wood = colour(40, 10);
  const auto [least, most] = std::minmax_element(stone.begin(), stone.begin() + 3);
  EXPECT_LT(*most - *least, 25);
  EXPECT_GT(sand[0] - sand[2], 45);
  EXPECT_GT(wood[0] - wood[2], 30);
  EXPECT_LT(wood[0], sand[0] - 40);
  EXPECT_TRUE(browser().errors().empty()) << browser().errors().front();
}

TEST(SandPart, RefusesWhatCannotBeShown) {
  EXPECT_THROW(SandPart("Sand", "", HeightField(5000, 5000, 0.001)), Error);
  HeightField bed(4, 4, 0.001);
  SandPart part("Sand", "", bed);
  bed.set(1, 2, std::nan(""));
  EXPECT_THROW(part.add("one", bed), Error);
}

TEST_F(SandPartInBrowser, ShowsEverySurfaceAndHeightsAlongALine) {
  SandPart part("Sand", "Three surfaces.", slope(40, 60, 0.0));
  for (const double lift : {0.0, 0.01, -0.02, 0.03}) part.add("lift", slope(40, 60, lift));
  browser().open_text(page_of(part.json()));
  browser().wait_for("sandParts[0].ready");
  // Heights are right to half a quantum, which is a thousandth of a cell.
  const std::string apart =
      "Math.max(...sandParts[0].heights.map((heights, k) => Math.max(...heights.map((height, i) "
      "=> Math.abs(height - 1e-3 * (i % 60) - (i >= 20 * 60 ? [0, 0.01, -0.02, 0.03][k] : 0))))))";
  EXPECT_LE(browser().evaluate(apart), 1.001e-6);
  // The slider goes through them; the picture has the one that it stands on.
  browser().evaluate("document.querySelector('input[type=range]').focus()");
  browser().press("ArrowLeft");
  browser().press("ArrowLeft");
  EXPECT_EQ(browser().evaluate("sandParts[0].shown"), 1);
  EXPECT_NEAR(browser().evaluate("sandParts[0].view.picture.heights[39 * 60]"), 0.01, 1e-6);
  // A line of 40 mm along x in the upper half: the slope is a half.
  browser().evaluate("sandParts[0].draw([[-0.02, 0.02], [0.02, 0.02]])");
  const Json line = browser().evaluate(
      "charts.at(-1).option.series.map(({ data }) => [data.length, data[0], data.at(-1)])");
  EXPECT_EQ(line[0][0], 21);
  EXPECT_NEAR(line[1][1][1], 1e-3 * 20 + 0.01, 1.1e-3);  // the nearest cell's
  EXPECT_NEAR(line[1][2][0], 0.04, 1e-9);
  EXPECT_NEAR(line[1][2][1].get<double>() - line[1][1][1].get<double>(), 0.02, 1e-5);
  // Drawn by mouse it is where the mouse was.
  browser().click("button[aria-pressed]");
  const Point middle = browser().centre("canvas");
  browser().drag({middle.x - 60, middle.y}, {middle.x + 60, middle.y});
  EXPECT_GT(browser().evaluate("Math.hypot(...plus(sandParts[0].line[1], sandParts[0].line[0], -1))"), 0.005);
  EXPECT_TRUE(browser().errors().empty()) << browser().errors().front();
}

TEST_F(SandPartInBrowser, ShowsHowFarTwoSurfacesAreApart) {
  SandPart part("Sand", "Two surfaces.", slope(40, 60, 0.0));
  part.add("golden.h5", slope(40, 60, 0.0));
  part.add("run.h5", slope(40, 60, -0.004));
  part.offer_difference("by the difference");
  browser().open_text(page_of(part.json()));
  browser().wait_for("sandParts[0].ready");
  browser().choose("section label:nth-of-type(2) select", "by the difference");
  EXPECT_NEAR(browser().evaluate("sandParts[0].view.colours.low"), -0.004, 2e-6);
  EXPECT_NEAR(browser().evaluate("sandParts[0].view.colours.values[39 * 60]"), -0.004, 2e-6);
  EXPECT_NEAR(browser().evaluate("sandParts[0].view.colours.values[0]"), 0.0, 2e-6);
  EXPECT_TRUE(browser().errors().empty()) << browser().errors().front();
}

TEST_F(SandPartInBrowser, SaysWhereThePictureIsWithoutWebGl) {
  SandPart part("Sand", "", slope(40, 60, 0.0));
  part.add("one", slope(40, 60, 0.0));
  std::string page = page_of(part.json());
  const std::string head = "<head>\n";
  page.insert(page.find(head) + head.size(),
              "<script>HTMLCanvasElement.prototype.getContext = () => null;</script>");
  browser().open_text(page);
  EXPECT_EQ(browser().evaluate("document.querySelectorAll('canvas').length"), 0);
  EXPECT_NE(browser()
                .evaluate("document.querySelector('section').textContent")
                .get<std::string>()
                .find("no WebGL 2"),
            std::string::npos);
  EXPECT_TRUE(browser().errors().empty()) << browser().errors().front();
}

}  // namespace
}  // namespace sandstroke
