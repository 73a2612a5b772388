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

OpenedPage open(Page page, const Json& data, const std::string& probe) {
  return open_in_chromium(page(data), probe);
}

/// A probe from statements that return its value.
std::string function(const std::string& body) { return "(() => {" + body + "})()"; }

using Bench = BrowserTest;
using Stress = BrowserTest;
using AnyPage = BrowserTest;

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
      all(figure, "stroke", surpriseColour)]);)js"));
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
  const Json bench = {{"problems", none}, {"columns", none},   {"runs", none},
                      {"orders", none},   {"estimates", none}, {"notes", none}};
  const Json stress = {
      {"surprises", 0}, {"cases", none}, {"maps", none}, {"boundaries", none}, {"traces", none}};
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

}  // namespace
}  // namespace sandstroke
