#include "pages/compare_page.h"

#include <gtest/gtest.h>

#include "browser.h"
#include "compare/compare_runs.h"
#include "compare/synthetic_run.h"
#include "report/hostile_text.h"

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;

/// Two made-up runs; a test changes them before it asks for the page.
struct Pair {
  SyntheticRun golden, run;

  PageOfParts page(const std::string& name = "run.h5") {
    golden.write(folder / "golden.h5");
    run.write(folder / name);
    const RunFile a(folder / "golden.h5"), b(folder / name);
    return run_page(a, b, compare_runs(a, b, Tolerances{}), Tolerances{});
  }

  TestFolder folder;
};

/// Two runs that differ in a block of cells and in the force of a tick.
struct DifferentPair : Pair {
  DifferentPair() {
    run.final.block(12, 24, 2, 2) += 0.002;
    run.trace[90].device_force.y() += 0.5;
  }
};

std::vector<std::string> names_in(const Json& list, const char* key) {
  std::vector<std::string> names;
  for (const Json& one : list) names.push_back(one[key]);
  return names;
}
using Names = std::vector<std::string>;

TEST(ComparePage, HasSurfacesAndTracesOfTwoRuns) {
  const PageOfParts page = Pair().page();
  EXPECT_EQ(page.title, "run.h5 against golden.h5");
  EXPECT_EQ(page.data["passed"], true);
  EXPECT_EQ(names_in(page.data["parts"], "title"),
            (Names{"Final height", "Both in 3-D", "Force and depth over time"}));
  EXPECT_TRUE(page.data["missing"].empty()) << page.data["missing"];
  EXPECT_EQ(page.data["golden"]["provenance"][0], Json({"scene_hash", "0123456789abcdef"}));
}

TEST(ComparePage, ShowsInitialSurfacesThatDiffer) {
  Pair pair;
  pair.run.initial(3, 3) += 2e-6;
  EXPECT_EQ(names_in(pair.page().data["parts"], "title").front(), "Initial height");
  pair.run.initial(3, 3) = 5e-7;
  EXPECT_EQ(names_in(pair.page().data["parts"], "title").front(), "Final height");
}

TEST(ComparePage, ShowsAFinerBedInTheMeansThatAreCompared) {
  Pair pair;
  pair.run.cell_size /= 2.0;
  pair.run.initial = HeightGrid::Zero(60, 80);
  pair.run.final = HeightGrid::NullaryExpr(
      60, 80, [&](Eigen::Index row, Eigen::Index col) { return pair.golden.final(row / 2, col / 2); });
  pair.page();
  const RunFile a(pair.folder / "golden.h5"), b(pair.folder / "run.h5");
  const auto maps = [&](bool coarsen) {
    return run_page(a, b, {}, Tolerances{}, coarsen).data["parts"][0]["maps"].size();
  };
  EXPECT_EQ(maps(false), 2u) << "no difference";
  EXPECT_EQ(maps(true), 3u);
}

TEST(ComparePage, ShowsWhatACutOffRunHasAndSaysWhatIsMissing) {
  Pair pair;
  pair.run.complete = pair.run.has_final = false;
  const PageOfParts page = pair.page();
  EXPECT_EQ(names_in(page.data["parts"], "title"), Names{"Force and depth over time"});
  ASSERT_EQ(names_in(page.data["missing"], "name"), Names{"Final height"});
  EXPECT_NE(page.data["missing"][0]["sentence"].get<std::string>().find("cut off"), std::string::npos);
}

TEST(ComparePage, ShowsTheSurfacesBesideADamagedTrace) {
  Pair pair;
  pair.run.missing_column = "depth";
  const PageOfParts page = pair.page();
  EXPECT_EQ(names_in(page.data["parts"], "title"), (Names{"Final height", "Both in 3-D"}));
  EXPECT_EQ(names_in(page.data["missing"], "name"), Names{"Traces"});
}

TEST(ComparePage, HasChangePictureAndTracesOfAGoldenEntry) {
  Pair pair;
  pair.page();
  const GoldenRun run{pair.folder / "golden.h5", Image(72, 40), {}};
  const GoldenEntry entry{"dune", pair.folder / "entry", "sandstroke golden update dune"};
  write_golden(entry.folder, run);
  const auto page = [&] {
    return golden_page(entry, run, compare_golden(entry, run, Tolerances{}), Tolerances{}).data;
  };
  const Json whole = page();
  EXPECT_EQ(whole["passed"], true);
  EXPECT_EQ(names_in(whole["parts"], "title"),
            (Names{"Change of height", "Picture", "Force and depth over time"}));
  EXPECT_TRUE(whole["missing"].empty());
  EXPECT_EQ(whole["golden"]["provenance"][0][0], "version");
  const Json& force = whole["parts"][2]["quantities"][0];
  EXPECT_EQ(force["golden"]["at"], force["run"]["at"]);
  EXPECT_EQ(force["run"]["at"].size(), SyntheticRun::ticks);

  std::filesystem::remove(entry.folder / "golden.h5");
  std::filesystem::remove(entry.folder / "provenance.toml");
  EXPECT_EQ(names_in(page()["missing"], "name"), (Names{"Change of height", "Traces"}));
}

TEST(ComparePage, TellsAGoldenEntryFromTheRun) {
  Pair pair;
  pair.run.initial = HeightGrid(pair.run.initial.topRows(20));
  pair.run.final = HeightGrid(pair.run.final.topRows(20));
  pair.golden.write(pair.folder / "golden.h5");
  pair.run.write(pair.folder / "run.h5");
  const GoldenEntry entry{"dune", pair.folder / "entry", "sandstroke golden update dune"};
  write_golden(entry.folder, {pair.folder / "golden.h5", Image(72, 40), {}});
  const GoldenRun run{pair.folder / "run.h5", Image(72, 40), {}};
  const Json data = golden_page(entry, run, {}, Tolerances{}).data;
  EXPECT_EQ(data["parts"][0]["text"], "They differ in shape: golden has 40 x 30 cells, the run 40 x 20.");
}

class ComparePageInBrowser : public BrowserTest {
 protected:
  void open(const PageOfParts& page) {
    browser().open_text(page.html());
    expect_no_errors();
  }
  void expect_no_errors() {
    EXPECT_EQ(browser().evaluate("Number(document.documentElement.dataset.errors)"), 0);
    EXPECT_TRUE(browser().errors().empty()) << browser().errors().front();
  }
  /// The position of the wipe's edge, and what is cut from the upper picture [% of the width].
  double edge() { return browser().evaluate("parseFloat(document.querySelector('.edge').style.left)"); }
  double cut() {
    return browser().evaluate(
        "parseFloat(document.querySelector('.wipe .layer .layer:last-child').style.clipPath.split(' ')[3])");
  }
  /// A position on the wipe, in fractions of its width and height.
  Point on_wipe(double right, double down) {
    browser().centre(".wipe");  // scrolls
    const Json box = browser().evaluate(
        "(() => { const b = document.querySelector('.wipe').getBoundingClientRect();"
        " return [b.left, b.top, b.width, b.height]; })()");
    return {box[0].get<double>() + right * box[2].get<double>(),
            box[1].get<double>() + down * box[3].get<double>()};
  }
};

TEST_F(ComparePageInBrowser, SaysTheOutcomeAndTheFailedChecksFirst) {
  open(DifferentPair().page());
  EXPECT_EQ(
      browser().evaluate("[...document.querySelectorAll('.facts dd')].slice(0, 2).map((d) => d.textContent)"),
      Json({"different", "2 of 12"}));
  EXPECT_EQ(browser().evaluate("[...document.querySelectorAll('#checks tbody tr')].slice(0, 3)"
                               ".map((line) => [line.children[0].textContent, line.className])"),
            Json::array({{"final height", "surprise"}, {"force", "surprise"}, {"golden complete", ""}}));
  EXPECT_NE(browser()
                .evaluate("document.getElementById('checks').textContent")
                .get<std::string>()
                .find("at time 0.09 s"),
            std::string::npos);
  EXPECT_EQ(browser().evaluate("charts.length"), 4);
}

TEST_F(ComparePageInBrowser, AllPicturesAreLoadedAndLieExactlyOverOneAnother) {
  open(DifferentPair().page());
  EXPECT_EQ(browser().evaluate("Promise.all([...document.images].map((one) => one.decode()))"
                               ".then(() => document.images.length)"),
            5);
  EXPECT_EQ(browser().evaluate(R"js((() => {
    const box = (one) => { const b = one.getBoundingClientRect(); return [b.left, b.top, b.width, b.height]; };
    const [below, above] = document.querySelectorAll(".wipe img");
    return [below.naturalWidth === above.naturalWidth, below.naturalHeight === above.naturalHeight,
            JSON.stringify(box(below)) === JSON.stringify(box(above)), below.src === above.src];
  })())js"),
            Json({true, true, true, false}));
}

TEST_F(ComparePageInBrowser, TheEdgeFollowsADragAndTheSliderWithIt) {
  open(DifferentPair().page());
  EXPECT_EQ(edge(), 50.0);
  browser().drag(on_wipe(0.5, 0.5), on_wipe(0.25, 0.6));
  EXPECT_NEAR(edge(), 25.0, 0.2);
  EXPECT_EQ(cut(), edge());
  EXPECT_NEAR(browser().evaluate("Number(document.querySelector('input[type=range]').value)"), edge(), 1e-9);
  browser().drag(on_wipe(0.3, 0.5), on_wipe(1.5, 0.5));
  EXPECT_EQ(edge(), 100.0) << "no further than the border";
  browser().hover(on_wipe(0.7, 0.5));
  EXPECT_EQ(edge(), 100.0) << "only while it is held";
  expect_no_errors();
}

TEST_F(ComparePageInBrowser, TheSliderIsDraggedAndItsThumbIsAtTheEdge) {
  open(DifferentPair().page());
  const Point middle = browser().centre("input[type=range]");
  EXPECT_NEAR(middle.x, on_wipe(0.5, 0.5).x, 0.6);
  const Point quarter = on_wipe(0.75, 0.5);
  browser().drag(browser().centre("input[type=range]"), {quarter.x, browser().centre("input[type=range]").y});
  EXPECT_NEAR(edge(), 75.0, 0.5);
}

TEST_F(ComparePageInBrowser, TheKeyboardReachesTheSliderAndMovesTheEdge) {
  open(DifferentPair().page());
  for (int i = 0; i < 60; ++i) {
    if (browser().evaluate("document.activeElement.type") == "range") break;
    browser().press("Tab");
  }
  ASSERT_EQ(browser().evaluate("document.activeElement.type"), "range");
  browser().press("ArrowRight");
  const double one = edge();
  EXPECT_GT(one, 50.0);
  EXPECT_LE(one, 52.0);
  browser().press("ArrowLeft");
  browser().press("ArrowLeft");
  EXPECT_LT(edge(), 50.0);
  browser().press("Home");
  EXPECT_EQ(edge(), 0.0);
  browser().press("End");
  EXPECT_EQ(edge(), 100.0);
  EXPECT_EQ(cut(), 100.0);
  EXPECT_NE(browser()
                .evaluate("document.activeElement.getAttribute('aria-valuetext')")
                .get<std::string>()
                .find("100 %"),
            std::string::npos);
}

TEST_F(ComparePageInBrowser, WipesToTheDifferenceToo) {
  open(DifferentPair().page());
  browser().choose("#part-1 select", "golden.h5 and difference");
  EXPECT_EQ(browser().evaluate("[...document.querySelectorAll('.wipe .tag')].map((one) => one.textContent)"),
            Json({"golden.h5", "difference"}));
  EXPECT_EQ(browser().evaluate("document.querySelectorAll('.wipe img')[1].src === "
                               "document.querySelectorAll('#part-1 .charts:last-child img')[2].src"),
            true);
  EXPECT_EQ(cut(), edge());
}

TEST_F(ComparePageInBrowser, PointingAtAPositionReadsOffItsHeights) {
  DifferentPair pair;
  open(pair.page());
  // The middle of cell (12, 25), from the extent of what is shown.
  const Json extent =
      browser().evaluate("JSON.parse(document.getElementById('data').textContent).parts[0].extent");
  const double x = (25 - 19.5) * 0.01, y = (12 - 14.5) * 0.01;
  const double left = extent["x"][0], right = extent["x"][1], bottom = extent["y"][0], top = extent["y"][1];
  browser().hover(on_wipe((x - left) / (right - left), (top - y) / (top - bottom)));
  const std::string text = browser().evaluate("document.querySelector('.readout').textContent");
  const auto number_after = [&](const std::string& word) {
    const std::string rest = text.substr(text.find(word + " ") + word.size() + 1), minus = "−";
    const bool negative = rest.starts_with(minus);
    const double size = std::stod(rest.substr(negative ? minus.size() : 0));
    return negative ? -size : size;
  };
  EXPECT_NEAR(number_after("x"), x, 5e-4) << text;
  EXPECT_NEAR(number_after("y"), y, 5e-4) << text;
  EXPECT_NEAR(number_after("golden.h5"), 1e3 * pair.golden.final(12, 25), 1e-3) << text;
  EXPECT_NEAR(number_after("run.h5"), 1e3 * pair.run.final(12, 25), 1e-3) << text;
  EXPECT_NEAR(number_after("difference"), 2.0, 1e-3) << text;
}

TEST_F(ComparePageInBrowser, AComponentOfTheForceIsChosenAndAllChartsZoomAlike) {
  open(DifferentPair().page());
  const std::string range =
      "charts.map(({ drawn }) => drawn.getOption().dataZoom[0]).map(({ start, end }) => [start, end])";
  EXPECT_EQ(browser().evaluate(range + ".every(([start, end]) => start === 0 && end === 100)"), true);
  browser().click(".buttons button:first-child");
  EXPECT_EQ(browser().evaluate(range + ".every(([start, end]) => Math.abs(start - 25) < 1e-6 && "
                                       "Math.abs(end - 75) < 1e-6)"),
            true);
  const auto highest = "Math.max(...charts[1].drawn.getOption().series[0].data.map(([, value]) => value))";
  EXPECT_NEAR(browser().evaluate(highest), 0.5, 1e-12);
  browser().choose("#part-3 select", "along x");
  EXPECT_EQ(browser().evaluate(highest), 0.0);
  browser().choose("#part-3 select", "along y");
  EXPECT_NEAR(browser().evaluate(highest), 0.5, 1e-12);
  EXPECT_EQ(browser().evaluate(range + "[0][0] > 24"), true) << "what was zoomed into stays";
  EXPECT_EQ(browser().evaluate("charts[0].drawn.getOption().yAxis[0].name"), "along y (N)");
  // A drag over a chart moves all of them.
  const Point chart = browser().centre("#part-3 .canvas");
  browser().drag(chart, {chart.x + 150, chart.y});
  EXPECT_EQ(browser().evaluate(range + ".every(([start]) => start < 24)"), true) << browser().evaluate(range);
  browser().click(".buttons button:last-child");
  EXPECT_EQ(browser().evaluate(range + ".every(([start, end]) => start === 0 && end === 100)"), true);
  expect_no_errors();
}

TEST_F(ComparePageInBrowser, PointingAtAChartReadsOffBothTraces) {
  open(DifferentPair().page());
  browser().hover("#part-3 .canvas");
  browser().wait_for("document.querySelector('#part-3 .tip')");
  EXPECT_EQ(
      browser().evaluate("[...document.querySelectorAll('#part-3 .tip dt')].map((one) => one.textContent)"),
      Json({"golden.h5 (N)", "run.h5 (N)"}));
  expect_no_errors();
}

TEST_F(ComparePageInBrowser, WhatIsMissingIsSaidAndTheRestIsDrawn) {
  Pair pair;
  pair.run.complete = pair.run.has_final = pair.run.has_trace = false;
  open(pair.page());
  EXPECT_NE(
      browser().evaluate("document.querySelector('.warning').textContent").get<std::string>().find("cut off"),
      std::string::npos);
  EXPECT_EQ(browser().evaluate("charts.length"), 2) << "golden's force and depth, no differences";

  Pair shapes;
  shapes.run.initial = shapes.run.final = HeightGrid::Zero(20, 20);
  open(shapes.page());
  EXPECT_EQ(browser().evaluate("document.images.length"), 2);
  EXPECT_EQ(browser().evaluate("document.querySelectorAll('input').length"), 0);
}

TEST(ComparePage, CallsFilesByTheirNames) {
  const Pair pair;
  const auto labels = [&](const std::string& golden, const std::string& run) {
    const PageOfParts page = picture_page(golden, Image(2, 2), run, Image(2, 2), {}, Tolerances{});
    return std::vector<std::string>{page.title, page.data["golden"].value("label", ""),
                                    page.data["run"].value("label", "")};
  };
  EXPECT_EQ(labels("a/before.png", "b/after.png"),
            (Names{"after.png against before.png", "before.png", "after.png"}));
  EXPECT_EQ(labels("a/sand.png", "b/sand.png"),
            (Names{"b/sand.png against a/sand.png", "a/sand.png", "b/sand.png"}));
  EXPECT_EQ(labels("sand.png", "sand.png"), (Names{"sand.png against sand.png", "", ""})) << "golden and run";
}

TEST_F(ComparePageInBrowser, CallsFilesByTheirNamesInMapsTablesAndCharts) {
  open(DifferentPair().page("after.h5"));
  const auto texts = [&](const std::string& selector) {
    return browser().evaluate("[...document.querySelectorAll('" + selector +
                              "')].map((one) => one.firstChild.data)");
  };
  EXPECT_EQ(texts("#part-1 .charts figcaption"),
            Json({"Golden: golden.h5", "Run: after.h5", "Difference: after.h5 − golden.h5"}));
  EXPECT_EQ(browser().evaluate(
                "[...document.querySelectorAll('#files th')].slice(0, 3).map((one) => one.textContent)"),
            Json({"Entry", "Golden: golden.h5", "Run: after.h5"}));
  EXPECT_EQ(browser().evaluate("charts[0].drawn.getOption().series.map(({ name }) => name)"),
            Json({"golden.h5", "after.h5"}));
}

TEST_F(ComparePageInBrowser, PicturesOfTwoFiles) {
  Image golden(200, 100), run(200, 100);
  run.pixel(150, 20)[0] = 90;
  const Comparison comparison{"b.png", picture_checks(golden, run, Tolerances{})};
  open(picture_page("a.png", golden, "b.png", run, comparison, Tolerances{}));
  EXPECT_EQ(browser().evaluate("document.images.length"), 5);
  EXPECT_EQ(browser().evaluate("charts.length"), 0);
  // The ring is around the only pixel that differs.
  EXPECT_EQ(browser().evaluate("[parseFloat(document.querySelector('.ring').style.left), "
                               "parseFloat(document.querySelector('.ring').style.bottom)]"),
            Json({100 * 150.5 / 200, 100 * 79.5 / 100}));
}

TEST_F(ComparePageInBrowser, TextOfTheFilesStaysText) {
  // Texts that come from files: their names, provenance and scenes, and sentences that tell of them.
  PageOfParts page = DifferentPair().page();
  page.data["golden"]["scene"] = "[tool]\nradius = 0.01\n";
  page.data["run"]["scene"] = "[tool]\nradius = \"" + hostile + "\"\n";
  page.data["missing"] = {{{"name", "Traces"}, {"sentence", "damaged"}}};
  for (const char* part : {"golden", "run", "checks", "missing"}) poison(page.data[part]);
  page.title = hostile;
  open(page);
  EXPECT_EQ(browser().evaluate("document.querySelector('h1').textContent.includes('<img src=x')"), true);
  for (const char* place : {".warning", "#checks", "#files"})
    EXPECT_NE(browser()
                  .evaluate("document.querySelector('" + std::string(place) + "').textContent")
                  .get<std::string>()
                  .find(hostile.substr(0, 100)),
              std::string::npos)
        << place;
  EXPECT_EQ(browser().evaluate("document.documentElement.dataset.hacked ?? null"), nullptr);
  EXPECT_EQ(browser().evaluate("[...document.images].filter((one) => !one.src.startsWith('data:')).length"),
            0);
}

}  // namespace
}  // namespace sandstroke
