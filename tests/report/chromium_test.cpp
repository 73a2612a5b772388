#include "browser.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>
#include <set>

#include "hostile_text.h"
#include "validation/stress/stress_report.h"
#include "validation/study/study_table.h"

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;

Json data_of(const char* name) {
  return Json::parse(std::ifstream(std::string(SANDSTROKE_SOURCE) + "/tests/report/" + name));
}
Json bench_data() { return data_of("bench_data.json"); }
Json stress_data() { return data_of("stress_data.json"); }

using Page = std::string (*)(const Json& data);

class AnyPage : public BrowserTest {
 protected:
  static OpenedPage open(Page page, const Json& data, const std::string& probe) {
    return open_page(page(data), probe);
  }
};

/// A probe from statements that return its value.
std::string function(const std::string& body) { return "(() => {" + body + "})()"; }

using Bench = AnyPage;
using Stress = AnyPage;

TEST_F(Bench, LoadsWithoutErrorsAndDrawsTheChartsOfItsData) {
  // The cone varies its cells and knows directions, the drag does neither.
  const OpenedPage page = open(bench_page, bench_data(), page_state);
  EXPECT_EQ(page.answer, Json({"true", 4, 0}));
  EXPECT_TRUE(page.console.empty()) << page.console.front();
}

TEST_F(Bench, EverySeriesOfAProblemHasItsCurveAndItsNameInTheLegend) {
  const Json data = bench_data();
  const OpenedPage page = open(bench_page, data, function(R"js(
    return [...document.querySelectorAll("section[id^=problem]")].map((section) => {
      const figure = section.querySelector("figure");
      return [...figure.querySelectorAll(".legend button")].map((button) => {
        const colour = button.querySelector("svg path").getAttribute("stroke");
        const drawn = [...figure.querySelectorAll(".canvas path")]
          .filter((path) => [path.getAttribute("stroke"), path.getAttribute("fill")].includes(colour));
        return [button.textContent, drawn.length];
      });
    });)js"));
  ASSERT_EQ(page.answer.size(), data["problems"].size());
  for (std::size_t i = 0; i < page.answer.size(); ++i) {
    std::set<std::string> series, drawn;
    for (const Json& run : data["runs"])
      if (run["problem"] == data["problems"][i]["name"]) series.insert(run["series"]);
    for (const auto& entry : page.answer[i]) {
      EXPECT_GE(entry[1], 1) << entry[0];
      if (series.count(entry[0])) drawn.insert(entry[0].get<std::string>());
    }
    EXPECT_EQ(drawn, series);
  }
}

TEST_F(Bench, APowerLawIsAStraightLine) {
  // rkl on the cone: the error halves as the cells double, three times. The path is "Mx yLx yLx y".
  const OpenedPage page = open(bench_page, bench_data(), function(R"js(
    const path = document.querySelectorAll("figure")[1].querySelector(`.canvas path[stroke="${colours[0]}"]`);
    return path.getAttribute("d").match(/[-0-9.]+/g).map(Number);)js"));
  const std::vector<double> at = page.answer;
  ASSERT_EQ(at.size(), 6u);
  EXPECT_GT(at[2], at[0]);
  EXPECT_GT(at[3], at[1]) << "smaller errors are further down";
  EXPECT_NEAR(at[4] - at[2], at[2] - at[0], 0.5);
  EXPECT_NEAR(at[5] - at[3], at[3] - at[1], 0.5);
}

TEST_F(Bench, MarksTheParetoFrontAndTheErrorOfTheReference) {
  const OpenedPage page = open(bench_page, bench_data(), function(R"js(
    return charts.filter((one) => one.option.series.some(({ name }) => name === "front")).map((one) => [
      one.option.series.find(({ name, type }) => name === "front" && type === "scatter").data.length,
      one.option.series.some(({ name }) => name === "converged")]);)js"));
  EXPECT_EQ(page.answer, Json({{3, false}, {2, true}}));
}

TEST_F(Bench, AnErrorOfZeroIsLeftOutOfALogarithmicChartAndSaidSo) {
  const OpenedPage page =
      open(bench_page, bench_data(),
           "[...document.querySelectorAll('figcaption small')].map((note) => note.textContent).at(-1)");
  EXPECT_NE(page.answer.get<std::string>().find("1 of 4 runs"), std::string::npos) << page.answer;
}

TEST_F(Bench, EverySymbolShowsItsFiguresUnderThePointer) {
  browser().open_text(bench_page(bench_data()));
  browser().centre(".canvas");
  const Json places = browser().evaluate(function(R"js(
    const { canvas, drawn, option } = charts[0], box = canvas.getBoundingClientRect();
    return option.series.flatMap(({ data }) => data).filter((item) => item.run).map(({ value, run }) => {
      const [x, y] = drawn.convertToPixel({ xAxisIndex: 0, yAxisIndex: 0 }, value);
      return [box.x + x, box.y + y, `${run.series} · ${run.label}`];
    });)js"));
  EXPECT_GT(places.size(), 0u);
  for (const Json& place : places) {
    browser().hover(Point{place[0], place[1]});
    browser().wait_for("document.querySelector('.tip strong')?.textContent === " + place[2].dump());
  }
}

TEST_F(Bench, ANameInTheLegendHidesItsCurveAndShowsItAgain) {
  const OpenedPage page = open(bench_page, bench_data(), function(R"js(
    const figure = document.querySelector("figure"), button = figure.querySelector(".legend button");
    const drawn = () => {
      charts[0].drawn.getZr().flush();
      return figure.querySelectorAll(`.canvas path[stroke="${colours[0]}"]`).length;
    };
    const before = drawn();
    button.click();
    const hidden = [drawn(), button.getAttribute("aria-pressed")];
    button.click();
    return [before > 0, ...hidden, drawn() === before, button.getAttribute("aria-pressed")];)js"));
  EXPECT_EQ(page.answer, Json({true, 0, "false", true, "true"}));
}

TEST_F(Bench, ATableSortsByItsHeadsWithNoneLastAndFiltersByProblem) {
  const Json data = bench_data();
  const OpenedPage page = open(bench_page, data, function(R"js(
    const section = document.getElementById("runs");
    const head = [...section.querySelectorAll("thead button")].find((one) => one.textContent === "Passes");
    const place = [...head.closest("tr").children].indexOf(head.parentElement);
    const lines = () => [...section.querySelectorAll("tbody tr:not([hidden])")];
    const column = () => lines().map((line) => line.children[place].textContent);
    const sorted = () => [head.parentElement.getAttribute("aria-sort"), column()];
    head.click();
    const up = sorted();
    head.click();
    const down = sorted();
    const choice = section.querySelector("select");
    choice.value = "1";
    choice.dispatchEvent(new Event("change"));
    return [up, down, lines().length, head.tabIndex];)js"));
  std::vector<double> passes;
  for (const Json& run : data["runs"])
    if (run["passes"].is_number()) passes.push_back(run["passes"]);
  std::sort(passes.begin(), passes.end());
  const auto texts = [&] {
    Json all = Json::array();
    for (const double p : passes) all.push_back(fmt::format("{}", p));
    all.push_back("–");
    return all;
  };
  EXPECT_EQ(page.answer[0], Json({"ascending", texts()}));
  std::reverse(passes.begin(), passes.end());
  EXPECT_EQ(page.answer[1], Json({"descending", texts()}));
  EXPECT_EQ(page.answer[2], 4) << "the runs of the second problem";
  EXPECT_EQ(page.answer[3], 0) << "the keyboard reaches it";
}

/// Advice on two subjects: which setting keeps which error, and at which cost.
Json advice() {
  const auto setting = [](const char* label, double error, double seconds, bool front) {
    return Json{{"series", "rkl"},    {"label", label},     {"error", error},
                {"seconds", seconds}, {"disturbed", false}, {"front", front}};
  };
  return {{{"subject", "Heaps"},
           {"problems", {"A cone", "A cylinder"}},
           {"settings", {setting("64 cells", 0.05, 0.004, true), setting("128 cells", 0.015, 0.5, true)}}},
          {{"subject", "Strokes"},
           {"problems", {"A stroke"}},
           {"settings", {setting("coarse", 0.08, 2.0, true), setting("odd", 0.09, 3.0, false)}}}};
}

TEST_F(Bench, SaysWhichSettingKeepsAnErrorAtWhichCost) {
  Json data = bench_data();
  data["advice"] = advice();
  const OpenedPage page = open(bench_page, data, function(R"js(
    const cells = [...document.querySelectorAll("#advice tr")].map((row) => [...row.children].map((one) => one.textContent));
    return [cells, charts[0].option.series.map(({ data }) => data.length)];)js"));
  EXPECT_EQ(page.answer[0], Json({{"Error at most", "Heaps", "Strokes"},
                                  {"10 %", "4 ms rkl, 64 cells", "2 s rkl, coarse"},
                                  {"2 %", "500 ms rkl, 128 cells", "–"},
                                  {"least error", "1.5 %", "8 %"}}));
  EXPECT_EQ(page.answer[1], Json({2, 2, 2, 1})) << "all settings of a subject, and its front";
}

TEST_F(Stress, SaysWhichLoopIsStableAndByHowMuch) {
  Json data = stress_data();
  const auto margin = [](const char* what, double value, double boundary, double factor) {
    return Json{
        {"what", what}, {"unit", "N/m"}, {"value", value}, {"boundary", boundary}, {"factor", factor}};
  };
  data["margins"] = {
      {{"name", "mine"},
       {"settings", "all of it"},
       {"stable", true},
       {"margins", {margin("stiffness", 100.0, 2500.0, 25.0), margin("rate", 1000.0, 125.0, 8.0)}}},
      {{"name", "yours"},
       {"settings", "all of it"},
       {"stable", false},
       {"margins", {margin("stiffness", 100.0, 50.0, 0.5), margin("rate", 10.0, 20.0, 0.5)}}}};
  const OpenedPage page = open(stress_page, data, function(R"js(
    const texts = (selector) => [...document.querySelectorAll(`#margins ${selector}`)].map((one) => one.textContent);
    return [texts("li"), texts("td"), [...document.querySelectorAll("#margins td strong")].map((one) => one.className)];)js"));
  EXPECT_EQ(page.answer[0], Json({"mine: stable, 8 × from its nearest boundary, that of the rate (all of it)",
                                  "yours: unstable (all of it)"}));
  EXPECT_EQ(page.answer[1][0], "25 × 100 now, stable up to 2500 N/m");
  EXPECT_EQ(page.answer[2], Json({"good", "bad", "good", "bad"}));
}

TEST_F(Stress, AMapShowsWhereASettingIsAndWhetherItsOthersAreTheMaps) {
  Json data = stress_data();
  const Json& x = data["maps"][0]["x"]["values"];
  const Json& y = data["maps"][0]["y"]["values"];
  data["maps"][0]["marks"] = {
      {{"name", "mine"}, {"x", x[0]}, {"y", y[0]}, {"same", true}, {"stable", true}},
      {{"name", "yours"}, {"x", x[0]}, {"y", 1e12}, {"same", false}, {"stable", false}}};
  const OpenedPage page = open(stress_page, data, function(R"js(
    return [charts[0].option.series.filter(({ type }) => type === "scatter").map(({ name }) => name),
            [...document.querySelectorAll("#maps figure")[0].querySelectorAll(".legend li")].map((one) => one.textContent)];)js"));
  EXPECT_EQ(page.answer[0], Json({"mine"}));
  const std::string legend = page.answer[1].dump();
  EXPECT_NE(legend.find("mine: stable\""), std::string::npos) << legend;
  EXPECT_NE(legend.find("yours: unstable, which is outside this map"), std::string::npos) << legend;
}

TEST_F(Bench, MarksEstimatesThatAreNotWithinAFactorOfThree) {
  const OpenedPage page =
      open(bench_page, bench_data(),
           "[...document.querySelectorAll('#estimates tbody tr')].map((line) => line.className)");
  EXPECT_EQ(page.answer, Json({"", "surprise"}));
}

TEST_F(Stress, LoadsWithoutErrorsAndDrawsTheChartsOfItsData) {
  // Two maps, two charts of boundaries, a trace.
  const OpenedPage page = open(stress_page, stress_data(), page_state);
  EXPECT_EQ(page.answer, Json({"true", 5, 0}));
  EXPECT_TRUE(page.console.empty()) << page.console.front();
}

TEST_F(Stress, SaysTheOutcomeUpFront) {
  const OpenedPage page =
      open(stress_page, stress_data(),
           "[...document.querySelectorAll('.facts div')].map((fact) => fact.textContent).slice(0, 4)");
  EXPECT_EQ(page.answer, Json({"Surprises2", "Cases4", "Map cells18", "Boundaries2"}));
}

TEST_F(Stress, AMapHasACellOfItsVerdictsColourForEachPairAndOutlinesSurprises) {
  const Json data = stress_data();
  const OpenedPage page = open(stress_page, data, function(R"js(
    const figures = [...document.querySelectorAll("#maps figure")];
    const all = (figure, attribute, colour) =>
      figure.querySelectorAll(`.canvas path[${attribute}="${colour}"]`).length;
    return figures.map((figure) => [
      Object.fromEntries([...verdicts].map(([name, look]) => [name, all(figure, "fill", look.fill)])),
      all(figure, "stroke", outlineColour)]);)js"));
  ASSERT_EQ(page.answer.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    std::map<std::string, int> count;
    for (const Json& row : data["maps"][i]["verdict"])
      for (const Json& verdict : row) ++count[verdict];
    for (const auto& [name, cells] : page.answer[i][0].items())
      EXPECT_EQ(cells, count[name]) << name << " in map " << i;
  }
  EXPECT_EQ(page.answer[0][1], 1);
  EXPECT_EQ(page.answer[1][1], 0);
}

TEST_F(Stress, ACurveCrossesTheCellItsPointIsIn) {
  // Logarithmic axes: the eigenvalue's (1000 Hz, 100 N/m) is the middle of the only limit cycle.
  const OpenedPage page = open(stress_page, stress_data(), function(R"js(
    const figure = document.querySelector("#maps figure");
    const path = figure.querySelector(`.canvas path[stroke="${theory[0].colour}"]`);
    const cell = figure.querySelector(`.canvas path[fill="${verdicts.get("limit cycle").fill}"]`).getBBox();
    const at = path.getAttribute("d").match(/[-0-9.]+/g).map(Number);
    return [at[2] - (cell.x + cell.width / 2), at[3] - (cell.y + cell.height / 2)];)js"));
  EXPECT_NEAR(page.answer[0], 0.0, 1.0);
  EXPECT_NEAR(page.answer[1], 0.0, 1.0);
}

TEST_F(Stress, SaysHowManyBoundariesAreOffAndWhichPassiveLoopsAreNotStable) {
  Json data = stress_data();
  const std::string probe =
      "[...document.querySelectorAll('#boundaries p span')].map((one) => [one.className, "
      "one.textContent.split(' ').slice(0, 3).join(' ')])";
  EXPECT_EQ(open(stress_page, data, probe).answer,
            Json::array({{"good", "All 2 are"}, {"good", "every loop is"}}));
  data["boundaries"][0]["measured"] = 206.0;  // 3 % off
  data["boundaries"][1]["measured"] = nullptr;
  EXPECT_EQ(open(stress_page, data, probe).answer, Json::array({{"bad", "2 of 2"}, {"bad", "1 of 2"}}));
}

TEST_F(Stress, SurprisesOnlyLeavesSurprisesOnly) {
  const OpenedPage page = open(stress_page, stress_data(), function(R"js(
    const shown = () => [...document.querySelectorAll("#cases tbody tr")]
      .filter((line) => line.offsetParent !== null).map((line) => line.children[0].textContent);
    const all = shown().length;
    document.querySelector("#cases input").click();
    return [all, shown()];)js"));
  EXPECT_EQ(page.answer, Json({4, {"in a corner"}}));
}

TEST_F(AnyPage, SaysThatItHasNoData) {
  const Json none = Json::array();
  const Json bench = {{"problems", none},  {"columns", none}, {"runs", none},         {"orders", none},
                      {"estimates", none}, {"notes", none},   {"asked_errors", none}, {"advice", none}};
  const Json stress = {{"surprises", 0}, {"margins", none},    {"cases", none},
                       {"maps", none},   {"boundaries", none}, {"traces", none}};
  for (const auto& [page_of, data, sentence] : {std::tuple{&bench_page, bench, "Nothing was measured"},
                                                std::tuple{&stress_page, stress, "Nothing was tested"}}) {
    const OpenedPage page =
        open(page_of, data, "[" + page_state + ", document.getElementById('page').textContent]");
    EXPECT_EQ(page.answer[0], Json({"true", 0, 0}));
    EXPECT_NE(page.answer[1].get<std::string>().find(sentence), std::string::npos) << page.answer[1];
    EXPECT_TRUE(page.console.empty()) << page.console.front();
  }
}

// Numbers that leave a chart no room, or nothing to draw.
TEST_F(AnyPage, ValuesWithoutASpreadOrAPositionAreNoErrors) {
  Json bench = bench_data();
  for (Json& run : bench["runs"]) {
    run["wall_seconds"] = 1.0;
    run["l1"] = run["problem"] == "cone" ? Json(1e-300) : Json(nullptr);
    run["cells"] = 512;
    if (run["slope_error"].is_array())
      for (Json& error : run["slope_error"]) error = nullptr;
  }
  Json stress = stress_data();
  stress["maps"] = {stress["maps"][0]};
  Json& map = stress["maps"][0];
  map["x"]["values"] = {1e3};
  map["y"]["values"] = {1e300};
  map["verdict"] = {{"diverged"}};
  map["surprise"] = {{true}};
  for (Json& boundary : stress["boundaries"]) boundary["measured"] = nullptr;
  Json& trace = stress["traces"][0];
  trace["time"] = {0.5};
  for (Json& series : trace["series"]) series["values"] = {1e300};
  // The cone's run times; the map and the trace.
  for (const auto& [page_of, data, charts] :
       {std::tuple{&bench_page, bench, 1}, std::tuple{&stress_page, stress, 2}}) {
    const OpenedPage page = open(
        page_of, data,
        function(
            R"js(
      return [)js" +
            page_state +
            R"js(, [...document.querySelectorAll(".canvas")].map((one) => /NaN|Infinity/.test(one.innerHTML))];)js"));
    EXPECT_EQ(page.answer[0], Json({"true", charts, 0}));
    for (const auto& broken : page.answer[1]) EXPECT_EQ(broken, false);
    EXPECT_TRUE(page.console.empty()) << page.console.front();
  }
}

TEST_F(AnyPage, AnErrorIsCountedAndShown) {
  const OpenedPage page = open(bench_page, {{"runs", 5}},
                               "[" + page_state + ", document.querySelector('.warning')?.textContent]");
  EXPECT_EQ(page.answer[0], Json({"true", 0, 1}));
  EXPECT_NE(page.answer[1].get<std::string>().find("could not be drawn"), std::string::npos);
  EXPECT_EQ(page.console.size(), 1u);
}

TEST_F(AnyPage, TextOfTheDataStaysText) {
  for (const auto& [page_of, clean] :
       {std::pair{&bench_page, bench_data()}, std::pair{&stress_page, stress_data()}}) {
    Json data = clean;
    poison(data);
    // Tooltips are shown too, of every item of every series.
    const std::string probe = function(
        R"js(
      for (const { drawn, option } of charts)
        option.series.forEach(({ data }, seriesIndex) => data.forEach((item, dataIndex) =>
          drawn.dispatchAction({ type: "showTip", seriesIndex, dataIndex })));
      const main = document.getElementById("page");
      const kinds = (root) => [...new Set([...root.querySelectorAll("*")].map((one) => one.localName))];
      return { state: )js" +
        page_state +
        R"js(, text: main.textContent, kinds: kinds(main), tips: main.querySelectorAll(".tip").length,
               drawn: [...main.querySelectorAll(".canvas svg text")].map((one) => one.textContent).join("") };)js");
    const OpenedPage page = open(page_of, data, probe);
    const int charts = page_of == bench_page ? 4 : 5;
    EXPECT_EQ(page.answer["state"], Json({"true", charts, 0}));
    EXPECT_TRUE(page.console.empty()) << page.console.front();
    EXPECT_NE(page.answer["text"].get<std::string>().find(hostile), std::string::npos);
    EXPECT_NE(page.answer["drawn"].get<std::string>().find("onerror=\"document"), std::string::npos);
    EXPECT_GT(page.answer["tips"], 0);
    for (const auto& kind : page.answer["kinds"]) {
      EXPECT_NE(kind, "img");
      EXPECT_NE(kind, "script");
    }
    EXPECT_EQ(page.dom.find("data-hacked"), std::string::npos);
  }
}

// Tools that capture a whole page give it a window of one pixel for a moment, and take the picture before a
// chart that followed could be drawn anew.
TEST_F(AnyPage, ChartsKeepTheirSizeInAWindowOfAPixel) {
  browser().open_text(stress_page(stress_data()));
  const auto widths = [&] {
    return browser().evaluate(
        "[...document.querySelectorAll('.canvas svg')].map((one) => Number(one.getAttribute('width')))");
  };
  const Json before = widths();
  browser().resize(1, 1);
  browser().wait_for("document.querySelector('.canvas').clientWidth < 100");
  browser().evaluate(
      "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))");
  EXPECT_EQ(widths(), before);
  browser().resize(800, 600);
  browser().wait_for(
      "Number(document.querySelector('.canvas svg').getAttribute('width')) === "
      "document.querySelector('.canvas').clientWidth");
  for (const Json& width : widths()) EXPECT_GE(width, 200);
  EXPECT_TRUE(browser().errors().empty());
}

/// The lowest edge of what a selector names, in a window 1280 wide.
double lowest_edge(Browser& browser, const std::string& selector) {
  browser.resize(1280, 900);
  browser.wait_for("innerWidth === 1280");
  return browser.evaluate("document.querySelector(" + Json(selector).dump() +
                          ").getBoundingClientRect().bottom");
}

TEST_F(AnyPage, TheAnswerStandsInTheFirstScreen) {
  Json bench = bench_data(), stress = stress_data();
  bench["advice"] = advice();
  bench["asked_errors"] = {0.2, 0.1, 0.05, 0.02, 0.01, 0.005};
  bench["disturbance"] = std::string(200, 'x');
  const Json margin = {{"what", "a"}, {"unit", "N"}, {"value", 1.0}, {"boundary", 2.0}, {"factor", 2.0}};
  stress["margins"] = {
      {{"name", "mine"}, {"settings", ""}, {"stable", true}, {"margins", {margin, margin, margin, margin}}}};
  browser().open_text(bench_page(bench));
  EXPECT_LT(lowest_edge(browser(), "#advice .canvas"), 900.0);
  browser().open_text(stress_page(stress));
  EXPECT_LT(lowest_edge(browser(), "#margins table"), 900.0);
}

TEST_F(AnyPage, NothingIsWiderThanANarrowWindow) {
  Json bench = bench_data(), stress = stress_data();
  bench["advice"] = advice();
  bench["problems"][0]["title"] = "A problem whose title is longer than a narrow window is wide";  // a choice
  for (const std::string& page : {bench_page(bench), stress_page(stress)}) {
    browser().open_text(page);
    browser().resize(400, 900);
    browser().wait_for("innerWidth === 400");
    EXPECT_LE(browser().evaluate("document.documentElement.scrollWidth"), 400);
  }
}

TEST_F(AnyPage, ChartsTakeTheWidthOfTheirFrame) {
  const OpenedPage page = open(stress_page, stress_data(), function(R"js(
    const widths = () => [...document.querySelectorAll(".canvas")].map((canvas) =>
      Math.abs(canvas.querySelector("svg").getBoundingClientRect().width - canvas.clientWidth));
    const wide = widths();
    dispatchEvent(new Event("beforeprint"));
    const print = widths(), sheet = document.querySelector("main").clientWidth;
    dispatchEvent(new Event("afterprint"));
    return [Math.max(...wide), Math.max(...print), sheet, Math.max(...widths())];)js"));
  EXPECT_LE(page.answer[0], 1);
  EXPECT_LE(page.answer[1], 1);
  EXPECT_EQ(page.answer[2], 688);
  EXPECT_LE(page.answer[3], 1);
}

/// The contrasts of a page: of its paper to black, the least of its charts' text to the paper, and the least
/// of the lines of its charts, as their legends show them.
const std::string contrasts = R"js((() => {
  const brightness = (colour) => {
    const [red, green, blue] = colour.match(/[\d.]+/g).map((part) => part / 255)
      .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
  };
  const contrast = (one, other) => {
    const [low, high] = [one, other].map(brightness).sort((a, b) => a - b);
    return (high + 0.05) / (low + 0.05);
  };
  const paper = getComputedStyle(document.body).backgroundColor;
  const least = (selector, property) => Math.min(...[...document.querySelectorAll(selector)]
    .map((one) => contrast(getComputedStyle(one)[property], paper)));
  return [contrast(paper, "rgb(0, 0, 0)"), least(".canvas svg text", "fill"),
          least(".legend button path:first-child", "stroke")];
})())js";

TEST_F(Bench, ChartsCanBeReadInTheDarkAndOnPaper) {
  browser().open_text(bench_page(bench_data()));
  browser().prefer("dark");
  const Json dark = browser().evaluate(contrasts);
  EXPECT_LT(dark[0], 1.5);
  EXPECT_GE(dark[1], 4.5);
  EXPECT_GE(dark[2], 3.0);
  browser().evaluate("dispatchEvent(new Event('beforeprint'))");
  const Json paper = browser().evaluate(contrasts);
  EXPECT_NEAR(paper[0], 21.0, 1e-9) << "white";
  EXPECT_GE(paper[1], 4.5);
  EXPECT_TRUE(browser().errors().empty());
}

// Charts of many items are canvases, which know no names of colours.
TEST_F(Bench, AChartOnACanvasTurnsDarkToo) {
  browser().open_text(bench_page(bench_data()));
  browser().evaluate(function(R"js(
    const one = charts[0];
    one.drawn.dispose();
    drawChart(Object.assign(one, { renderer: "canvas" }));)js"));
  for (const char* scheme : {"light", "dark"}) {
    browser().prefer(scheme);
    browser().wait_for(function(R"js(
      const name = getComputedStyle(document.documentElement).getPropertyValue("--axis");
      const axis = echarts.color.parse(name).slice(0, 3), canvas = document.querySelector(".canvas canvas");
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      let found = 0;
      for (let i = 0; i < data.length; i += 4) if (axis.every((part, k) => data[i + k] === part)) found += 1;
      return found > 100;)js"));
  }
  EXPECT_TRUE(browser().errors().empty());
}

}  // namespace
}  // namespace sandstroke
