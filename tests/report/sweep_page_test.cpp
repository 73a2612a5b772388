#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <functional>

#include "browser.h"
#include "hostile_text.h"
#include "sweep/sweep_page.h"

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;

// A picture of one pixel.
const std::string picture =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNkYPhfDwAChwGA60e6kgAAAABJRU5ErkJggg==";

Json axis(const std::string& name, const std::string& unit, const Json& values, bool log = false) {
  return {{"name", name},
          {"unit", unit},
          {"log", log},
          {"numeric", values.empty() || values[0].is_number()},
          {"values", values}};
}

const Json angles = {20, 22.5, 25, 27.5};
const Json stiffnesses = {100, 1000, 10000};

/// The first metric of the point at these values: one for each point.
double force_at(const std::vector<int>& at) {
  double force = 1.5, weight = 1.0;
  for (const int i : at) {
    force += weight * i;
    weight *= 10.0;
  }
  return force;
}

/// A sweep over axes: the full grid, its last axis the fastest, or a point for each value where it is Latin.
Json sweep_data(const Json& axes, const std::string& design = "grid") {
  Json points = Json::array();
  std::vector<int> at(axes.size(), 0);
  const auto add = [&] {
    std::string command = "sandstroke run strokes/wscg/scene.toml";
    for (std::size_t i = 0; i < at.size(); ++i)
      command += " --set " + axes[i]["name"].get<std::string>() + "=" + axes[i]["values"][at[i]].dump();
    points.push_back({{"point", points.size()},
                      {"at", at},
                      {"verdict", "at rest"},
                      {"reason", ""},
                      {"metrics", {force_at(at), 1000.0 - force_at(at)}},
                      {"thumbnail", picture},
                      {"command", command}});
  };
  if (design == "latin") {
    for (int i = 0; i < static_cast<int>(axes[0]["values"].size()); ++i) {
      std::fill(at.begin(), at.end(), i);
      add();
    }
  } else {
    const std::function<void(std::size_t)> walk = [&](std::size_t k) {
      if (k == axes.size()) return add();
      for (at[k] = 0; at[k] < static_cast<int>(axes[k]["values"].size()); ++at[k]) walk(k + 1);
    };
    walk(0);
  }
  return {
      {"title", "talus"},
      {"machine", {{"cpu", "Test CPU"}, {"cores", 2}}},
      {"scene", "strokes/wscg/scene.toml"},
      {"design", design},
      {"axes", axes},
      {"metrics",
       {{{"name", "max_force"}, {"title", "peak force"}, {"unit", "N"}, {"definition", "largest |F| <b>"}},
        {{"name", "passes"}, {"title", "passes"}, {"unit", ""}, {"definition", "of all"}}}},
      {"effects", {Json::array(), Json::array()}},
      {"idle", Json::array()},
      {"points", points},
      {"counts", {{"points", points.size()}, {"done", points.size()}, {"failed", 0}, {"missing", 0}}}};
}

void fail(Json& data, std::size_t point, const std::string& verdict, const std::string& reason) {
  Json& one = data["points"][point];
  one["verdict"] = verdict;
  one["reason"] = reason;
  one["metrics"] = Json::array({nullptr, nullptr});
  one["thumbnail"] = nullptr;
  Json& counts = data["counts"];
  counts["done"] = counts["done"].get<int>() - 1;
  Json& other = counts[verdict == "missing" ? "missing" : "failed"];
  other = other.get<int>() + 1;
}

/// 4 x 3 points; 4 and 5 failed for one reason, 7 for another, 9 is missing.
Json grid_data() {
  Json data = sweep_data(
      {axis("relaxation.talus_angle", "deg", angles), axis("force.k_s", "N/m", stiffnesses, true)});
  fail(data, 4, "unstable", "the device oscillates");
  fail(data, 5, "unstable", "the device oscillates");
  fail(data, 7, "refused", "too steep");
  fail(data, 9, "missing", "");
  return data;
}

Json three_axes_data() {
  return sweep_data({axis("relaxation.talus_angle", "deg", angles),
                     axis("force.k_s", "N/m", stiffnesses, true),
                     axis("relaxation.law", "", {"paper", "isotropic"})});
}

const std::string as_map = "x=relaxation.talus_angle&second=force.k_s&chart=map";

class SweepPage : public BrowserTest {
 protected:
  static void open(const Json& data, const std::string& state = "") {
    browser().open_text(sweep_page(data));
    EXPECT_EQ(browser().evaluate("document.documentElement.dataset.errors"), "0");
    if (state.empty()) return;
    browser().evaluate(
        "new Promise((done) => { addEventListener('hashchange', () => done(), { once: true });"
        "location.hash = " +
        Json(state).dump() + "; })");
  }
  void TearDown() override {
    if (IsSkipped()) return;
    for (const std::string& error : browser().errors()) ADD_FAILURE() << error;
  }
  static Json ask(const std::string& expression) { return browser().evaluate(expression); }
  /// The text of the first element of a selector, or of all; but for pictures.
  static Json text(const std::string& selector) {
    const Json all = texts(selector);
    return all.empty() ? Json() : all[0];
  }
  static Json texts(const std::string& selector) {
    return ask(
        "[...document.querySelectorAll(\"" + selector +
        "\")].map((one) => { const own = one.cloneNode(true);"
        "own.querySelectorAll('svg').forEach((picture) => picture.remove()); return own.textContent; })");
  }
  static Json selected() { return text(".detail h2"); }
  /// The position in the window of data's (x, y), which are positions of the chart's axes.
  static Point at(const Json& x, const Json& y) {
    browser().centre(".canvas");
    const Json place = ask(
        fmt::format("(() => {{ const {{ canvas, drawn }} = charts[0], box = canvas.getBoundingClientRect();"
                    "const [x, y] = drawn.convertToPixel({{ xAxisIndex: 0, yAxisIndex: 0 }}, [{}, {}]);"
                    "return [box.x + x, box.y + y]; }})()",
                    x.dump(), y.dump()));
    return {place[0], place[1]};
  }
  /// The items of a chart's series, as [the point's number, value].
  static Json items(const std::string& series) {
    return ask("charts[0].drawn.getOption().series.filter(({ name }) => name.startsWith('" + series +
               "')).map(({ data }) => data.map(({ point, value }) => [point.point, value]))");
  }
};

TEST_F(SweepPage, SaysWhatMattersAndShowsItFirst) {
  Json data = three_axes_data();
  data["effects"] = {{{{"axes", {1}}, {"share", 0.7}, {"least", 1.0}, {"greatest", 12.5}},
                      {{"axes", {0, 1}}, {"share", 0.2}, {"least", 0.0}, {"greatest", 15.0}},
                      {{"axes", {0}}, {"share", 0.1}, {"least", -1.0}, {"greatest", 2.0}},
                      {{"axes", {2}}, {"share", 0.0}, {"least", 0.0}, {"greatest", 0.0}}},
                     Json::array()};
  data["idle"] = {2};
  open(data);
  const Json rows =
      browser().evaluate("[...document.querySelectorAll('.effects tr')].map((row) => row.textContent)");
  EXPECT_EQ(rows, Json({"force.k_s70 %mean from 1 to 12.5 N",
                        "relaxation.talus_angle and force.k_s20 %together, beyond what each does alone",
                        "relaxation.talus_angle10 %mean from −1 to 2 N"}));
  EXPECT_EQ(browser().evaluate("document.querySelector('.effects .note').textContent"),
            "Without any effect on any metric: relaxation.law.");
  EXPECT_EQ(browser().evaluate("[...document.querySelectorAll('select')].slice(0, 4).map((one) => "
                               "one.selectedOptions[0].textContent)")[2],
            "force.k_s")
      << "the horizontal axis is what matters most";
  browser().click(".effects tr:nth-child(3) button");
  EXPECT_EQ(browser().evaluate("document.querySelector('select[name=x]').selectedOptions[0].textContent"),
            "relaxation.talus_angle");
  browser().choose("select[name=metric]", "passes");
  EXPECT_NE(browser()
                .evaluate("document.querySelector('.effects').textContent")
                .get<std::string>()
                .find("the same at all points"),
            std::string::npos);
  EXPECT_TRUE(browser().errors().empty());
}

TEST_F(SweepPage, TheEffectsStandInTheFirstScreen) {
  Json data = three_axes_data();
  Json effects = Json::array();
  for (const Json& axes : {Json::array({0}), Json::array({1}), Json::array({2}), Json::array({0, 1}),
                           Json::array({0, 2}), Json::array({1, 2})})
    effects.push_back({{"axes", axes}, {"share", 0.15}, {"least", 0.0}, {"greatest", 1.0}});
  data["effects"] = {effects, Json::array()};
  open(data);
  browser().resize(1280, 900);
  browser().wait_for("innerWidth === 1280");
  EXPECT_LT(browser().evaluate("document.querySelector('.effects').getBoundingClientRect().bottom"), 900);
  browser().resize(400, 900);
  browser().wait_for("innerWidth === 400");
  EXPECT_LE(browser().evaluate("document.documentElement.scrollWidth"), 400);
}

TEST_F(SweepPage, SaysWhatWasSweptAndWhatCameOfIt) {
  open(grid_data());
  EXPECT_EQ(
      text("main > p:not([class])"),
      "A grid of 4 × 3 over relaxation.talus_angle from 20 to 27.5 deg (4 values) and force.k_s from 100 to "
      "10\u202f000 N/m (3 values, logarithmic), from the scene strokes/wscg/scene.toml.");
  EXPECT_EQ(texts(".facts div"), Json({"Points12", "Done8", "Failed3", "Missing1"}));
  EXPECT_EQ(texts(".mishaps li"), Json({"unstable: the device oscillates 2 points: 4, 5",
                                        "refused: too steep Point 7", "missing Point 9"}));
  browser().click(".mishaps li:nth-child(2) button");
  EXPECT_EQ(selected(), "Point 7");
  EXPECT_EQ(text(".detail .bad"), "too steep");
}

TEST_F(SweepPage, AMapHasACellForEachPointInItsPositionAndColour) {
  const Json data = grid_data();
  open(data, as_map);
  const Json cells = items("cells")[0];
  ASSERT_EQ(cells.size(), 12u);
  for (const Json& cell : cells) {
    const Json& point = data["points"][cell[0].get<std::size_t>()];
    const double angle = angles[point["at"][0].get<std::size_t>()];
    const double stiffness = stiffnesses[point["at"][1].get<std::size_t>()];
    EXPECT_NEAR(cell[1][0], angle - 1.25, 1e-12);
    EXPECT_NEAR(cell[1][2], angle + 1.25, 1e-12);
    EXPECT_NEAR(cell[1][1], std::log10(stiffness) - 0.5, 1e-12);
    EXPECT_NEAR(cell[1][3], std::log10(stiffness) + 0.5, 1e-12);
  }
  // Colours go along the ramp, as the bar says, from the smallest value to the largest.
  const Json drawn = ask(R"js((() => {
    const fills = [...document.querySelectorAll(".canvas path")].map((path) => path.getAttribute("fill"));
    const share = ({ metrics: [force] }) => (force - 1.5) / 23;
    const has = (colour) => fills.filter((fill) => fill === colour).length;
    const svg = (colour) => echarts.color.stringify(echarts.color.parse(colour).slice(0, 3), "rgb");
    const all = JSON.parse(document.getElementById("data").textContent).points.filter(({ metrics }) => metrics[0]);
    return [all.map((point) => has(svg(ramp(share(point))))), ["#ad3a06", "#9aa3aa", "#eceff1"].map(has)];
  })())js");
  EXPECT_EQ(drawn[0], Json({1, 1, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(drawn[1], Json({2, 1, 1})) << "unstable, refused, missing";
  EXPECT_EQ(text(".colours > span"), "peak force (N)");
  EXPECT_EQ(texts("figure .legend li"), Json({"unstable: 2 points", "refused: 1 point", "missing: 1 point"}));
}

TEST_F(SweepPage, TooltipsDefineTheMetrics) {
  open(grid_data(), as_map);
  const Json both = {"largest |F| <b>", "of all"};
  EXPECT_EQ(ask("document.querySelector('select[name=metric]').title"), both[0]);
  const auto titles = [&](const std::string& of) {
    return ask("[...document.querySelectorAll('" + of + "')].map((one) => one.title).filter(Boolean)");
  };
  EXPECT_EQ(titles(".detail dt"), both);
  EXPECT_EQ(titles("#points th"), both);
  ask("(() => { const one = document.querySelector('select[name=metric]'); one.value = 1; "
      "one.dispatchEvent(new Event('change')); })()");
  EXPECT_EQ(ask("document.querySelector('select[name=metric]').title"), both[1]);
}

TEST_F(SweepPage, AClickOnACellSelectsItsPoint) {
  const Json data = grid_data();
  open(data, as_map);
  for (const std::size_t number : {11u, 6u, 5u, 9u}) {
    const Json& point = data["points"][number];
    const std::size_t i = point["at"][0], j = point["at"][1];
    browser().click(at(angles[i], std::log10(stiffnesses[j].get<double>())));
    EXPECT_EQ(selected(), fmt::format("Point {}", number));
    EXPECT_EQ(texts(".detail dl:first-of-type dd"),
              Json({fmt::format("{} deg", angles[i].get<double>()),
                    fmt::format("{} N/m", std::vector<std::string>{"100", "1000", "10\u202f000"}[j])}));
    EXPECT_EQ(text(".detail .verdict"), point["verdict"]);
    EXPECT_EQ(text(".detail code"), point["command"]);
    const Json metrics = point["metrics"];
    EXPECT_EQ(texts(".detail dl:last-of-type dd")[0],
              metrics[0].is_null()
                  ? Json("–")
                  : Json(ask("format(" + metrics[0].dump() + ")").get<std::string>() + " N"));
    EXPECT_EQ(items("selected")[0].size(), 1u);
    EXPECT_EQ(items("selected")[0][0][0], number);
    EXPECT_EQ(texts("tr[data-marked] td:first-child"), Json({std::to_string(number)}));
    EXPECT_EQ(ask("[...document.querySelectorAll('.picture[data-marked]')].map((one) => "
                  "one.ariaLabel.split(',')[0])"),
              Json({fmt::format("point {}", number)}));
    EXPECT_EQ(ask("new URLSearchParams(location.hash.slice(1)).get('point')"), std::to_string(number));
  }
}

TEST_F(SweepPage, LinesAreTheValuesOfTheData) {
  const Json data = grid_data();
  open(data, "x=relaxation.talus_angle&second=force.k_s&chart=lines");
  const Json lines = items("line ");
  ASSERT_EQ(lines.size(), 3u);
  for (std::size_t j = 0; j < 3; ++j) {
    ASSERT_EQ(lines[j].size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(lines[j][i][0], 3 * i + j);
      EXPECT_EQ(lines[j][i][1], Json::array({angles[i], data["points"][3 * i + j]["metrics"][0]}));
    }
  }
  EXPECT_EQ(texts("figure .legend li"), Json({"force.k_s (N/m):", "100", "1000", "10\u202f000",
                                              "unstable: 2 points", "refused: 1 point", "missing: 1 point"}));
  const Json signs = items("without")[0];
  ASSERT_EQ(signs.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(signs[i][0], (std::vector{4, 5, 7, 9}[i]));
  // The mouse points at a symbol of a line, and at a sign on the ground.
  browser().click(at(25, data["points"][8]["metrics"][0]));
  EXPECT_EQ(selected(), "Point 8");
  const Point ground = at(27.5, signs[3][1][1]);
  browser().click(Point{ground.x, ground.y - 8});
  EXPECT_EQ(selected(), "Point 9");
}

TEST_F(SweepPage, ControlsChooseMetricAxesAndKindOfChart) {
  const Json data = grid_data();
  open(data, as_map);
  EXPECT_EQ(text("figcaption"), "peak force over relaxation.talus_angle and force.k_s");
  browser().choose("select[name=metric]", "passes");
  EXPECT_EQ(text("figcaption"), "passes over relaxation.talus_angle and force.k_s");
  browser().choose("select[name=x]", "force.k_s");  // the axes change places
  EXPECT_EQ(text("figcaption"), "passes over force.k_s and relaxation.talus_angle");
  browser().choose("select[name=chart]", "lines");
  EXPECT_EQ(text("figcaption"), "passes along force.k_s");
  EXPECT_EQ(items("line ").size(), 4u);
  EXPECT_EQ(items("line ")[0][0], Json::array({0, {2, data["points"][0]["metrics"][1]}})) << "10^2 N/m";
  EXPECT_EQ(ask("document.querySelector('input[name=at-0]').checkVisibility()"), false);
  browser().choose("select[name=second]", "none");  // the other axis gets a slider
  EXPECT_EQ(items("line ").size(), 1u);
  EXPECT_EQ(text("figcaption small"), "At relaxation.talus_angle = 20 deg.");
  browser().choose("select[name=chart]", "heat map");
  EXPECT_EQ(text("figcaption"), "passes over force.k_s and relaxation.talus_angle");
  browser().click("input[name=log]");
  EXPECT_EQ(items("cells")[0].size(), 12u);
  EXPECT_EQ(ask("document.documentElement.dataset.errors"), "0");
}

TEST_F(SweepPage, PrintsUnitsAsTheyAreWritten) {
  Json data = grid_data();
  data["metrics"][0]["unit"] = "m^3";
  open(data, as_map);
  EXPECT_EQ(text(".colours > span"), "peak force (m³)");
}

TEST_F(SweepPage, ALogarithmicScaleIsOfferedWhereAllValuesArePositive) {
  Json data = grid_data();
  data["points"][0]["metrics"][1] = -1.0;
  open(data, "x=relaxation.talus_angle&second=&chart=lines");
  EXPECT_EQ(ask("document.querySelector('[name=log]').disabled"), false);
  browser().click("[name=log]");
  EXPECT_NEAR(items("line ")[0][0][1][1], std::log10(1.5), 1e-12);
  browser().choose("select[name=metric]", "passes");
  EXPECT_EQ(ask("document.querySelector('[name=log]').disabled"), true);
  EXPECT_EQ(items("line ")[0][0][1][1], -1.0);
}

TEST_F(SweepPage, ASliderMovesThroughTheAxisThatIsNotShown) {
  const Json data = three_axes_data();
  open(data, "x=force.k_s&second=relaxation.law&chart=map&point=3");
  EXPECT_EQ(text("figcaption small"), "At relaxation.talus_angle = 20 deg.");
  EXPECT_EQ(text(".slider output"), "20 deg");
  const Point middle = browser().centre("input[name=at-0]");
  const double width = ask("document.querySelector('input[name=at-0]').clientWidth");
  browser().drag({middle.x - width / 2 + 8, middle.y}, {middle.x + width / 2 - 2, middle.y});
  EXPECT_EQ(text(".slider output"), "27.5 deg");
  EXPECT_EQ(selected(), "Point 21") << "the other values stay: 1000 N/m, isotropic";
  browser().press("ArrowLeft");
  EXPECT_EQ(text(".slider output"), "25 deg");
  EXPECT_EQ(ask("document.querySelector('input[name=at-0]').getAttribute('aria-valuetext')"), "25 deg");
  EXPECT_EQ(selected(), "Point 15");
  const Json cells = items("cells")[0];
  EXPECT_EQ(cells.size(), 6u);
  for (const Json& cell : cells) EXPECT_EQ(data["points"][cell[0].get<std::size_t>()]["at"][0], 2);
  browser().choose("select[name=second]", "relaxation.talus_angle");  // the law gets the fixed value
  EXPECT_EQ(items("cells")[0].size(), 12u);
  browser().choose("select[name=at-2]", "paper");
  EXPECT_EQ(selected(), "Point 14");
  EXPECT_EQ(text("figcaption small"), "At relaxation.law = paper.");
}

TEST_F(SweepPage, SelectingAPointElsewhereBringsTheChartToIt) {
  open(three_axes_data());
  EXPECT_EQ(text("figcaption small"), "At relaxation.law = paper.");
  browser().click("tbody tr:nth-child(4) td:nth-child(2)");
  EXPECT_EQ(selected(), "Point 3");
  EXPECT_EQ(text("figcaption small"), "At relaxation.law = isotropic.");
  EXPECT_EQ(items("selected")[0][0][0], 3);
}

TEST_F(SweepPage, PicturesStandAsTheAxesOfTheChart) {
  const Json data = grid_data();
  open(data);
  // The largest stiffness is at the top, the smallest angle on the left.
  EXPECT_EQ(ask("[...document.querySelectorAll('.picture')].map((one) => one.title.split(':')[0])"),
            Json({"point 2", "point 5", "point 8", "point 11", "point 1", "point 4", "point 7", "point 10",
                  "point 0", "point 3", "point 6", "point 9"}));
  EXPECT_EQ(ask("document.querySelectorAll('.picture img').length"), 8);
  browser().wait_for(
      "document.querySelector('.gallery [role=group]').style.getPropertyValue('--aspect') === '1'");
  browser().click(".picture:nth-of-type(4)");
  EXPECT_EQ(selected(), "Point 11");
  for (const char* images : {".picture img", ".detail img"})
    browser().wait_for(std::string("[...document.querySelectorAll('") + images +
                       "')].every((one) => one.complete && one.naturalWidth === 1)");
}

TEST_F(SweepPage, TheTableSortsAndFilters) {
  open(grid_data());
  const auto numbers = [&] { return texts("#points tbody td:first-child"); };
  browser().click("#points thead th:nth-child(5) button");  // the peak force
  EXPECT_EQ(numbers(), Json({"0", "3", "6", "1", "10", "2", "8", "11", "4", "5", "7", "9"}));
  browser().click("#points thead th:nth-child(5) button");
  EXPECT_EQ(numbers(), Json({"11", "8", "2", "10", "1", "6", "3", "0", "4", "5", "7", "9"}))
      << "none stay last";
  browser().click("input[name=failed]");
  EXPECT_EQ(numbers(), Json({"4", "5", "7", "9"}));
  EXPECT_EQ(text("#points .controls [role=status]"), "4 of 12 points");
  browser().click("input[name=filter]");
  browser().type("OSCILL");
  EXPECT_EQ(numbers(), Json({"4", "5"}));
  browser().click("input[name=failed]");
  browser().click("input[name=filter]");
  browser().press("Control+a");
  browser().type("27.5");
  EXPECT_EQ(numbers(), Json({"11", "10", "9"}));
  EXPECT_EQ(text("#points .controls [role=status]"), "3 of 12 points");
  browser().click("#points tbody tr:nth-child(2)");
  EXPECT_EQ(selected(), "Point 10");
}

TEST_F(SweepPage, CopiesTheCommandLine) {
  const Json data = grid_data();
  open(data);
  browser().click("#points tbody tr:nth-child(6)");
  browser().click(".command button");
  browser().wait_for("document.querySelector('.command [role=status]').textContent === 'copied'");
  browser().click("input[name=filter]");
  browser().press("Control+v");
  EXPECT_EQ(ask("document.querySelector('[name=filter]').value"), data["points"][5]["command"]);
}

TEST_F(SweepPage, SelectsTheCommandLineWhereItMayNotCopy) {
  const Json data = grid_data();
  open(data);
  ask("Object.defineProperty(navigator, 'clipboard', { value: undefined }), document.execCommand = () => "
      "false, 0");
  browser().click(".command button");
  browser().wait_for("document.querySelector('.command [role=status]').textContent.startsWith('selected')");
  EXPECT_EQ(ask("getSelection().toString()"), data["points"][0]["command"]);
}

TEST_F(SweepPage, TheKeyboardReachesAll) {
  open(grid_data());
  // The elements that Tab reaches, each once, and whether each shows the focus.
  std::vector<std::string> stops;
  const auto walk_to = [&](const std::string& selector) {
    for (int i = 0; i < 100; ++i) {
      browser().press("Tab");
      EXPECT_EQ(ask("getComputedStyle(document.activeElement).outlineStyle !== 'none'"), true)
          << ask("document.activeElement.outerHTML");
      stops.push_back(
          ask("document.activeElement.name || document.activeElement.className || "
              "document.activeElement.localName"));
      if (ask("document.activeElement.matches(" + Json(selector).dump() + ")") == true) return;
    }
    FAIL() << selector << " is not reached: " << Json(stops).dump();
  };
  walk_to(".mishaps li:first-child button:last-child");
  browser().press("Enter");
  EXPECT_EQ(selected(), "Point 5");
  for (const char* control : {"metric", "chart", "x", "second", "log"})
    walk_to(std::string("[name=") + control + "]");
  walk_to(".keys");
  browser().press("ArrowRight");
  EXPECT_EQ(selected(), "Point 8");
  browser().press("ArrowDown");
  EXPECT_EQ(selected(), "Point 7");
  EXPECT_EQ(text(".detail [aria-live=polite]"),
            "Point 7, refused, relaxation.talus_angle 25 deg, force.k_s 1000 N/m");
  browser().press("ArrowUp");
  browser().press("ArrowUp");
  EXPECT_EQ(selected(), "Point 8") << "there is nothing further up";
  walk_to(".picture");
  browser().press("ArrowLeft");
  EXPECT_EQ(selected(), "Point 5");
  EXPECT_EQ(ask("document.activeElement.title.split(':')[0]"), "point 5");
  walk_to("[name=filter]");
  EXPECT_EQ(std::count(stops.begin(), stops.end(), "picture"), 1) << "pictures are one stop";
  walk_to("[name=failed]");
  browser().press("Space");
  walk_to("thead button");
  browser().press("Enter");
  browser().press("Enter");
  walk_to("tbody button");
  browser().press("Enter");
  EXPECT_EQ(selected(), "Point 9") << "the last of those that failed or are missing";
  walk_to(".command button");
  browser().press("Enter");
  browser().wait_for("document.querySelector('.command [role=status]').textContent === 'copied'");
  EXPECT_EQ(ask("[...document.querySelectorAll('select, input')].every((one) => one.labels.length === 1)"),
            true);
}

TEST_F(SweepPage, ALinkLeadsBackToTheView) {
  open(grid_data(), "metric=passes&chart=lines&x=force.k_s&second=&point=8");
  EXPECT_EQ(selected(), "Point 8");
  EXPECT_EQ(text("figcaption"), "passes along force.k_sAt relaxation.talus_angle = 25 deg.");
  browser().choose("select[name=metric]", "peak force (N)");
  EXPECT_EQ(ask("location.hash"), "#metric=max_force&chart=lines&x=force.k_s&second=&point=8");
  open(grid_data(), "x=nothing&point=99&chart=odd&metric=");
  EXPECT_EQ(selected(), "Point 0");
  open(grid_data(), "point=8");
  EXPECT_EQ(selected(), "Point 8");
}

TEST_F(SweepPage, ALatinHypercubeIsScattered) {
  Json data = sweep_data({axis("relaxation.talus_angle", "deg", {31, 22, 27, 40, 25}),
                          axis("force.k_s", "N/m", {100, 400, 10000, 200, 1000}, true)},
                         "latin");
  fail(data, 2, "unstable", "the device oscillates");
  open(data);
  EXPECT_EQ(
      text("main > p:not([class])"),
      "A Latin hypercube of 5 points over relaxation.talus_angle from 22 to 40 deg and force.k_s from 100 to "
      "10\u202f000 N/m (logarithmic), from the scene strokes/wscg/scene.toml.");
  const Json& points = data["points"];
  EXPECT_EQ(items("known")[0], Json({{0, {31, points[0]["metrics"][0]}},
                                     {1, {22, points[1]["metrics"][0]}},
                                     {3, {40, points[3]["metrics"][0]}},
                                     {4, {25, points[4]["metrics"][0]}}}));
  EXPECT_EQ(items("without")[0][0][0], 2);
  browser().click(at(22, points[1]["metrics"][0]));
  EXPECT_EQ(selected(), "Point 1");
  browser().press("Tab");
  ask("document.querySelector('.keys').focus()");
  browser().press("ArrowRight");
  EXPECT_EQ(selected(), "Point 4") << "the next angle";
  browser().choose("select[name=second]", "force.k_s");
  EXPECT_EQ(items("known")[0][3], Json({4, {25, 3}}));
  EXPECT_EQ(text(".colours > span"), "peak force (N)");
  browser().click(at(27, 4));
  EXPECT_EQ(selected(), "Point 2");
}

TEST_F(SweepPage, TextOfTheDataStaysText) {
  for (Json data : {grid_data(), three_axes_data()}) {
    poison(data);
    open(data);
    ask("charts[0].option.series.forEach(({ data }, seriesIndex) => data.forEach((item, dataIndex) => "
        "charts[0].drawn.dispatchAction({ type: 'showTip', seriesIndex, dataIndex })))");
    browser().choose("select[name=chart]", "lines");
    browser().choose("select[name=x]", data["axes"].back()["name"]);
    const std::string all = text("main");
    EXPECT_NE(all.find(hostile), std::string::npos);
    EXPECT_EQ(ask("document.documentElement.dataset.hacked ?? null"), nullptr);
    EXPECT_EQ(ask("document.querySelectorAll('main :is(script, img)').length"), 0);
    EXPECT_EQ(ask("document.documentElement.dataset.errors"), "0");
  }
}

TEST_F(SweepPage, OnlyPicturesWithinThePageAreShown) {
  Json data = grid_data();
  data["points"][0]["thumbnail"] = "missing.png";
  data["points"][1]["thumbnail"] = "javascript:document.documentElement.dataset.hacked = 1";
  open(data);
  EXPECT_EQ(ask("document.querySelectorAll('.picture img').length"), 6);
  EXPECT_EQ(text(".detail img"), nullptr);
}

TEST_F(SweepPage, OnePointIsEnough) {
  open(sweep_data(Json::array({axis("relaxation.talus_angle", "deg", {30})})));
  EXPECT_EQ(selected(), "Point 0");
  EXPECT_EQ(items("line ").dump(), "[[[0,[30,1.5]]]]");
  EXPECT_EQ(ask("['chart', 'second'].map((name) => document.querySelector(`[name=${name}]`).disabled)"),
            Json({true, true}));
  Json failed = sweep_data({axis("relaxation.law", "", {"paper"}), axis("force.k_s", "N/m", {0}, true)});
  fail(failed, 0, "refused", "no stiffness");
  open(failed);
  EXPECT_EQ(ask("/NaN|Infinity/.test(document.querySelector('.canvas').innerHTML)"), false);
  EXPECT_EQ(text("figcaption small"), "No point here has a value of this metric.");
}

TEST_F(SweepPage, SaysThatThereAreNoPointsOrMetrics) {
  Json none = sweep_data(Json::array({axis("relaxation.talus_angle", "deg", Json::array())}));
  open(none);
  EXPECT_NE(text("main").get<std::string>().find("Nothing was swept"), std::string::npos);
  Json bare = grid_data();
  bare["metrics"] = Json::array();
  for (Json& point : bare["points"]) {
    point["metrics"] = Json::array();
    point["thumbnail"] = nullptr;
  }
  open(bare);
  EXPECT_NE(text("main").get<std::string>().find("No metrics were collected"), std::string::npos);
  EXPECT_EQ(ask("document.querySelector('.gallery')"), nullptr);
  EXPECT_EQ(texts("#points tbody td:first-child").size(), 12u);
}

TEST_F(SweepPage, FiveAxesHaveThreeSliders) {
  Json axes = Json::array();
  for (const char* name : {"a", "b", "c", "d", "e"}) axes.push_back(axis(name, "", {1, 2, 3}));
  open(sweep_data(axes), "x=a&second=b&chart=map");
  EXPECT_EQ(ask("[...document.querySelectorAll('.slider')].filter((one) => one.checkVisibility()).length"),
            3);
  EXPECT_EQ(items("cells")[0].size(), 9u);
  browser().click(at(3, 2));
  EXPECT_EQ(selected(), fmt::format("Point {}", 2 * 81 + 27));
  browser().centre("input[name=at-4]");
  ask("document.querySelector('input[name=at-4]').focus()");
  browser().press("End");
  EXPECT_EQ(selected(), fmt::format("Point {}", 2 * 81 + 27 + 2));
}

TEST_F(SweepPage, TenThousandPointsAreDrawn) {
  Json values = Json::array();
  for (int i = 1; i <= 100; ++i) values.push_back(i);
  const Json axes = {axis("a", "", values), axis("b", "", values)};
  open(sweep_data(axes));
  EXPECT_EQ(items("cells")[0].size(), 10000u);
  browser().click(at(73, 41));
  EXPECT_EQ(selected(), fmt::format("Point {}", 72 * 100 + 40));
  // A page of the table and of the pictures at a time.
  EXPECT_EQ(texts("#points tbody tr").size(), 100u);
  EXPECT_EQ(text("#points .pager [role=status]"), "7201 to 7300 of 10\u202f000") << "the selected one's page";
  EXPECT_EQ(
      ask("(() => { const one = document.querySelector('tr[data-marked]'), box = one.closest('.scroll');"
          "const [inner, outer] = [one, box].map((element) => element.getBoundingClientRect());"
          "return inner.top > outer.top && inner.bottom < outer.bottom; })()"),
      true);
  browser().click("#points .pager button:last-child");
  EXPECT_EQ(text("#points tbody td:first-child"), "7300");
  browser().click("input[name=filter]");
  browser().type("=0.5");
  EXPECT_EQ(text("#points .controls [role=status]"), "0 of 10\u202f000 points");
  EXPECT_EQ(ask("document.querySelectorAll('.picture').length"), 120);
  EXPECT_EQ(ask("document.querySelectorAll('.picture[data-marked]').length"), 1)
      << "they turn to its page too";
  browser().choose("select[name=chart]", "lines");
  EXPECT_EQ(items("line ").size(), 100u);
  EXPECT_EQ(text(".colours > span"), "b") << "a bar instead of a hundred names";

  Json spread = Json::array();
  for (int i = 0; i < 10000; ++i) spread.push_back(7919 * i % 10007);
  open(sweep_data(Json::array({axis("a", "", spread)}), "latin"));
  EXPECT_EQ(items("known")[0].size(), 10000u);
  EXPECT_EQ(ask("document.documentElement.dataset.errors"), "0");
}

}  // namespace
}  // namespace sandstroke
