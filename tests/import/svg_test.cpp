#include "import/svg.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "complaint.h"
#include "import/drawn_lines.h"

namespace sandstroke {
namespace {

using std::numbers::pi;
using testing::AllOf;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pointwise;

/// A page of 100 x 50 mm, one unit of which is a mm.
SampleTable page(const std::string& inside) {
  return parse_svg(
      "<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='50mm' viewBox='0 0 100 50'>" + inside +
          "</svg>",
      "drawing.svg");
}

std::string svg_complaint(const std::string& inside) {
  return complaint_of([&] { page(inside); });
}

void expect_points(const SampleTable& table, const std::vector<double>& x, const std::vector<double>& y,
                   const std::string& what = "") {
  EXPECT_THAT(column(table, "x").values, Pointwise(DoubleNear(1e-9), x)) << what;
  EXPECT_THAT(column(table, "y").values, Pointwise(DoubleNear(1e-9), y)) << what;
}

TEST(Svg, LinesOfAPathAbsoluteAndRelative) {
  for (const char* data : {"M10 20 L30 20 V40 H10 Z", "m10,20 l20,0 v20 h-20 z", "M10 20 30 20 30 40 10 40Z",
                           "m10 20 20 0 0 20-20 0z", "M1e1+20L30,20v20H10.0z"}) {
    const SampleTable table = page(fmt::format("<path d='{}'/>", data));
    expect_points(table, {10, 30, 30, 10, 10}, {-20, -20, -40, -40, -20}, data);
    EXPECT_THAT(table.lifts, ElementsAre(false, false, false, false, true)) << data;
    EXPECT_EQ(column(table, "x").unit, "mm");
    EXPECT_THAT(table.warnings, ElementsAre());
  }
}

TEST(Svg, EverySubpathLifts) {
  const SampleTable table = page("<path d='M0 0h5m5 0h5zl0 5M1 1M2 2h1'/><line x2='3' y2='4'/>");
  expect_points(table, {0, 5, 10, 15, 10, 10, 10, 2, 3, 0, 3}, {0, 0, 0, 0, 0, 0, -5, -2, -2, 0, -4});
  EXPECT_THAT(table.lifts,
              ElementsAre(false, true, false, false, true, false, true, false, true, false, true));
  EXPECT_THAT(table.description, HasSubstr("SVG: 5 pen strokes, 11 points, 15 x 5 mm"));
  EXPECT_THAT(table.description, HasSubstr("y points down in the file"));
}

TEST(Svg, ADotIsOneSample) { expect_points(page("<path d='M3 4z'/>"), {3}, {-4}); }

/// Each curve keeps its tolerance from its closed form.
TEST(Svg, CurvesAreDividedWithinTheTolerance) {
  const struct {
    const char* data;
    double x0, y0, rx, ry, length;  // of the circle on which they lie
  } arcs[] = {
      {"M20 10 A10 10 0 0 1 10 20", 10, 10, 10, 10, 5 * pi},
      {"M20 10 A10 10 0 1 0 10 20", 10, 10, 10, 10, 15 * pi},
      {"M20 10 A10 10 0 0 0 10 20", 20, 20, 10, 10, 5 * pi},
      {"m20 10a10 10 0 01-10 10", 10, 10, 10, 10, 5 * pi},
      {"M20 10 A1 1 0 0 1 10 10", 15, 10, 5, 5, 5 * pi},  // radii that do not reach
  };
  for (const auto& arc : arcs) {
    const SampleTable table = page(fmt::format("<path d='{}'/>", arc.data));
    const auto &x = column(table, "x").values, &y = column(table, "y").values;
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_NEAR(std::hypot(x[i] - arc.x0, -y[i] - arc.y0), arc.rx, 1e-9) << arc.data;
      if (i == 0) continue;
      const double middle = std::hypot(0.5 * (x[i] + x[i - 1]) - arc.x0, -0.5 * (y[i] + y[i - 1]) - arc.y0);
      EXPECT_GE(middle, arc.rx - drawing_curve_tolerance) << arc.data;
    }
    EXPECT_NEAR(path_length(table), arc.length, 1e-2) << arc.data;
    EXPECT_LT(table.size(), 500u);
  }
}

/// Points on the curves by de Casteljau's halves.
TEST(Svg, BezierCurvesGoThroughTheirMiddle) {
  const struct {
    const char *data, *same;
    double x, y;  // at half of the last curve
  } curves[] = {
      {"M0 0 C0 10 10 10 10 0", "m0 0c0 10 10 10 10 0", 5, 7.5},
      {"M0 0 Q5 10 10 0",
       "M0 0 C3.3333333333333335 6.666666666666667 6.666666666666667 6.666666666666667 10 0", 5, 5},
      {"M0 0 C0 10 10 10 10 0 S20 -10 20 0", "M0 0 C0 10 10 10 10 0 C10 -10 20 -10 20 0", 15, -7.5},
      {"M0 0 Q5 10 10 0 T20 0", "M0 0 q5 10 10 0 q5 -10 10 0", 15, -5},
      {"M0 0 S10 10 10 0", "M0 0 C0 0 10 10 10 0", 5, 3.75},
      {"M0 0 T10 0", "M0 0 L10 0", 5, 0},
  };
  for (const auto& curve : curves) {
    const SampleTable table = page(fmt::format("<path d='{}'/>", curve.data));
    const auto &x = column(table, "x").values, &y = column(table, "y").values;
    double nearest = 1e9;
    for (std::size_t i = 1; i < x.size(); ++i) {  // of the lines to the point
      const Eigen::Vector2d a(x[i - 1], y[i - 1]), b(x[i], y[i]), p(curve.x, -curve.y);
      const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (p - a - t * (b - a)).norm());
    }
    EXPECT_LE(nearest, drawing_curve_tolerance) << curve.data;
    EXPECT_NEAR(path_length(table), path_length(page(fmt::format("<path d='{}'/>", curve.same))), 1e-2)
        << curve.data;
  }
}

TEST(Svg, Shapes) {
  expect_points(page("<rect x='1' y='2' width='30' height='4'/>"), {1, 31, 31, 1, 1}, {-2, -2, -6, -6, -2});
  expect_points(page("<polyline points='1,2 3,4 5 6'/>"), {1, 3, 5}, {-2, -4, -6});
  expect_points(page("<polygon points='1 2,3 4,5 2'/>"), {1, 3, 5, 1}, {-2, -4, -2, -2});
  expect_points(page("<line x1='10%' y1='10%' x2='1cm' y2='2'/>"), {10, 10 * 96 / 25.4}, {-5, -2});
  EXPECT_NEAR(path_length(page("<circle cx='9' cy='8' r='7'/>")), 14 * pi, 1e-2);
  const SampleTable ellipse = page("<ellipse cx='9' cy='8' rx='7' ry='3'/>");
  for (std::size_t i = 0; i < ellipse.size(); ++i)
    EXPECT_NEAR(
        std::hypot((column(ellipse, "x").values[i] - 9) / 7, (column(ellipse, "y").values[i] + 8) / 3), 1.0,
        1e-9);
  EXPECT_NEAR(path_length(page("<rect width='20' height='10' rx='2'/>")), 2 * (16 + 6) + 4 * pi, 1e-2);
  EXPECT_NEAR(path_length(page("<rect width='20' height='10' rx='50' ry='5'/>")),
              path_length(page("<ellipse cx='10' cy='5' rx='10' ry='5'/>")), 1e-2);
}

TEST(Svg, TransformsOfGroupsGoFromTheInsideOut) {
  const struct {
    const char* transform;
    double x, y;  // of the point (10, 0)
  } transforms[] = {
      {"translate(5)", 15, 0},
      {"translate(5 , 6)", 15, 6},
      {"scale(2)", 20, 0},
      {"scale(2,3)", 20, 0},
      {"rotate(90)", 0, 10},
      {"rotate(90 10 10)", 20, 10},
      {"skewY(45)", 10, 10},
      {"skewX(45) rotate(90)", 10, 10},
      {"matrix(1 2 3 4 5 6)", 15, 26},
      {"translate(1,1)scale(2)", 21, 1},
      {"scale(2), translate(1,1)", 22, 2},
      {"", 10, 0},
      {"none", 10, 0},
  };
  for (const auto& one : transforms) {
    const std::string line = "<line x1='10' y1='0' x2='10' y2='0'/>";
    expect_points(page(fmt::format("<g transform='{}'>{}</g>", one.transform, line)), {one.x}, {-one.y},
                  one.transform);
  }
  expect_points(page("<g transform='scale(2)'><g><path transform='translate(3 0)' d='M1 1h1'/></g></g><path "
                     "d='M1 1h1'/>"),
                {8, 10, 1, 2}, {-2, -2, -1, -1});
  // A circle that becomes an ellipse is divided by its size on the page.
  EXPECT_NEAR(path_length(page("<g transform='scale(100)'><circle r='0.07'/></g>")), 14 * pi, 1e-2);
}

TEST(Svg, ThePageGivesTheUnit) {
  const struct {
    const char* page;
    double mm;  // of one unit
    bool warns;
  } pages[] = {
      {"width='96' height='96'", 25.4 / 96, false},
      {"width='210mm' height='297mm' viewBox='0 0 210 297'", 1, false},
      {"width='1in' height='1in' viewBox='0 0 10 10'", 2.54, false},
      {"width='20cm' viewBox='0 0 100 100'", 2, false},
      {"height='720pt' viewBox='0 0 100 100'", 2.54, false},
      {"width='100mm' height='10mm' viewBox='0 0 10 10' preserveAspectRatio='xMinYMin'", 1, false},
      {"width='100mm' height='10mm' viewBox='0 0 10 10' preserveAspectRatio='none'", 10, false},
      {"viewBox='0 0 10 10'", 25.4 / 96, true},
      {"width='100%' height='100%' viewBox='0 0 10 10'", 25.4 / 96, true},
      {"", 25.4 / 96, true},
  };
  for (const auto& one : pages) {
    const SampleTable table =
        parse_svg(fmt::format("<svg {}><path d='M1 0h1'/></svg>", one.page), "drawing.svg");
    expect_points(table, {one.mm, 2 * one.mm}, {0, 0}, one.page);
    EXPECT_EQ(!table.warnings.empty(), one.warns) << one.page;
    if (one.warns) {
      EXPECT_THAT(table.warnings[0], HasSubstr("gives no width or height"));
    }
  }
  // The view begins at (10, 20); the drawing is in the middle of a page that is too wide.
  expect_points(
      parse_svg("<svg width='60mm' height='20mm' viewBox='10 20 10 10'><path d='M10 20h10'/></svg>", "a"),
      {20, 40}, {0, 0});
  // A page in a page.
  expect_points(page("<svg x='10' y='10' width='20' height='20' viewBox='0 0 2 2'><path d='M1 1h1'/></svg>"),
                {20, 30}, {-20, -20});
}

TEST(Svg, WhatIsHiddenOrOnlyDefinedIsLeftOut) {
  const std::string line = "<path d='M90 40h9'/>";
  for (const char* hidden :
       {"<defs>{}</defs>", "<g display='none'>{}</g>", "<g style='fill:red; display : none'><g>{}</g></g>",
        "<symbol>{}</symbol>", "<clipPath>{}</clipPath>", "<mask>{}</mask>", "<pattern>{}</pattern>",
        "<marker>{}</marker>", "<g visibility='hidden'>{}</g>", "<metadata>{}</metadata>", "<!-- {} -->"}) {
    const SampleTable table = page(fmt::format(fmt::runtime(hidden), line) + "<path d='M1 1h1'/>");
    expect_points(table, {1, 2}, {-1, -1}, hidden);
    EXPECT_THAT(table.warnings, ElementsAre()) << hidden;
  }
}

TEST(Svg, WhatIsNotReadIsSaid) {
  EXPECT_THAT(page("<text>A</text><use href='#a'/><image/><text/><path d='M1 1h1'/>").warnings,
              ElementsAre(HasSubstr("1 image, 2 text, 1 use not drawn")));
  EXPECT_THAT(page("<style>.a { display: none }</style><path class='a' d='M1 1h1'/>").warnings,
              ElementsAre(HasSubstr("style sheet hides elements")));
  EXPECT_THAT(svg_complaint("<text>A</text>"), HasSubstr("nothing but 1 text"));
}

TEST(Svg, SaysWhatIsWrong) {
  EXPECT_THAT(svg_complaint(""), HasSubstr("drawing.svg: has no lines to draw"));
  EXPECT_THAT(svg_complaint("<path id='p7' d='M1 1 L2'/>"),
              HasSubstr("drawing.svg: path 'p7': its path data"));
  for (const char* data :
       {"1 1", "L1 1", "M1 1 X3", "M1 1z2", "M1 1A1 1 0 2 0 3 3", "M1 nan", "M1 1L1e999 3", "M", "#"})
    EXPECT_THAT(svg_complaint(fmt::format("<path d='{}'/>", data)), HasSubstr("cannot be read at")) << data;
  for (const char* transform : {"turn(3)", "rotate(1 2)", "scale(a)", "scale", "matrix(1 2 3)"})
    EXPECT_THAT(svg_complaint(fmt::format("<g transform='{}'/>", transform)),
                HasSubstr("not a transform of SVG"))
        << transform;
  EXPECT_THAT(svg_complaint("<circle r='2em'/>"),
              AllOf(HasSubstr("circle: its r \"2em\""), HasSubstr("not a length")));
  EXPECT_THAT(svg_complaint("<polyline points='1 2 3'/>"), HasSubstr("its points cannot be read at"));
  EXPECT_THAT(svg_complaint("<g transform='scale(1e300)'><g transform='scale(1e300)'><line x2='1'/></g></g>"),
              HasSubstr("1e+12 mm away"));
  EXPECT_THAT(svg_complaint("<path"), HasSubstr("drawing.svg:1: is not valid XML"));
  EXPECT_THAT(complaint_of([] { parse_svg("<html/>", "a"); }), HasSubstr("its first element is html"));
}

TEST(Svg, ManyCurvesAreTooMany) {
  std::string data = "M0 0";
  for (int i = 0; i < 20'000; ++i) data += "q 5e10 9e10 1 0";
  EXPECT_THAT(svg_complaint("<path d='" + data + "'/>"), HasSubstr("more than 5e+06 points"));
}

TEST(Svg, DeepGroupsAreNoTrouble) {
  std::string open, close;
  for (int i = 0; i < 100'000; ++i) {
    open += "<g>";
    close += "</g>";
  }
  expect_points(page(open + "<path d='M1 1h1'/>" + close), {1, 2}, {-1, -1});
}

TEST(Svg, IsKnownByItsElement) {
  EXPECT_TRUE(looks_like_svg("<?xml version='1.0'?>\n<!-- made --><svg:svg xmlns:svg=''>"));
  EXPECT_FALSE(looks_like_svg("<html><svg/></html>"));
  EXPECT_FALSE(looks_like_svg("x <svg>"));
}

}  // namespace
}  // namespace sandstroke
