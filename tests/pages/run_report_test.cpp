#include "pages/run_report.h"

#include <gtest/gtest.h>

#include "browser.h"
#include "compare/synthetic_run.h"
#include "core/error.h"
#include "report/hostile_text.h"

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

Names names_of(const Json& list, const char* key) {
  Names names;
  for (const Json& one : list) names.push_back(one[key]);
  return names;
}

/// A run made up by a test, with a stroke of 104 ticks along x: 1 mm/s against a force that grows.
struct Reported {
  Reported() {
    run.scene = "[stroke]\nfile = \"line.toml\"\n";
    for (std::size_t tick = 0; tick < run.trace.size(); ++tick) {
      run.trace[tick].device_position = {1e-3 * static_cast<double>(tick) - 0.05, 0.0, -0.001};
      run.trace[tick].hand.position = run.trace[tick].device_position;
      run.trace[tick].device_force.x() = -2.0;
    }
  }
  PageOfParts page(const std::optional<ErrorEstimate>& error = {}) {
    run.write(folder / "run.h5");
    return run_report(
        RunFile(folder / "run.h5"), [](const LastSurface&) { return Image(72, 40); }, error);
  }

  SyntheticRun run;
  TestFolder folder;
};

const Names all_parts = {"Picture", "The sand in 3-D", "Force, depth and energy over time",
                         "Profiles of the sand", "Error estimate"};

TEST(RunReport, HasEveryPartOfAWholeRun) {
  const PageOfParts page = Reported().page();
  EXPECT_EQ(page.title, "run.h5");
  EXPECT_EQ(names_of(page.data["parts"], "title"), all_parts);
  EXPECT_TRUE(page.data["missing"].empty()) << page.data["missing"];
  EXPECT_EQ(page.data["provenance"][0], Json({"scene_hash", "0123456789abcdef"}));
  EXPECT_NE(page.data["scene"].get<std::string>().find("line.toml"), std::string::npos);
}

TEST(RunReport, FiguresAreThoseOfTheTrace) {
  const Json figures = Reported().page().data["figures"];
  const auto value = [&](const std::string& name) {
    for (const Json& figure : figures)
      if (figure["name"] == name) return figure["value"].get<double>();
    return -1.0;
  };
  EXPECT_NEAR(value("Stroke"), 0.104, 1e-12);
  EXPECT_NEAR(value("Largest force"), std::hypot(2.0, 1000.0 * std::expm1(0.5 * 0.0104)), 1e-12);
  EXPECT_NEAR(value("Largest depth"), 10.4, 1e-9);                 // mm
  EXPECT_NEAR(value("Energy into the sand"), 2.0 * 0.104, 1e-12);  // force times way
}

TEST(RunReport, ShowsWhatACutOffRunHas) {
  Reported reported;
  reported.run.complete = reported.run.has_final = false;
  const PageOfParts page = reported.page();
  EXPECT_EQ(names_of(page.data["parts"], "title"), all_parts);
  ASSERT_EQ(names_of(page.data["missing"], "name"), Names{"The end of the run"});
  EXPECT_NE(page.data["missing"][0]["sentence"].get<std::string>().find("its initial surface"),
            std::string::npos);
  EXPECT_EQ(page.data["parts"][0]["maps"][0]["name"], "initial surface");
}

TEST(RunReport, HasThePictureAndASentenceWithoutAStrokeOrATrace) {
  struct Case {
    std::function<void(SyntheticRun&)> change;
    std::string sentence;
  };
  for (const auto& [change, sentence] :
       {Case{[](SyntheticRun& run) { run.scene = "[bed]\n"; }, "the bed only came to rest"},
        Case{[](SyntheticRun& run) { run.has_trace = false; }, "output.trace = true"},
        Case{[](SyntheticRun& run) { run.trace.clear(); }, "before its first tick"},
        Case{[](SyntheticRun& run) { run.missing_column = "depth"; }, "/trace/depth"}}) {
    Reported reported;
    change(reported.run);
    const PageOfParts page = reported.page();
    EXPECT_EQ(names_of(page.data["parts"], "title"), (Names{"Picture", "The sand in 3-D", "Error estimate"}));
    ASSERT_EQ(names_of(page.data["missing"], "name"), Names{"The stroke"});
    EXPECT_NE(page.data["missing"][0]["sentence"].get<std::string>().find(sentence), std::string::npos)
        << page.data["missing"];
  }
}

TEST(RunReport, HasCurvesAndNoProfileWithoutAContact) {
  Reported reported;
  for (TickRecord& tick : reported.run.trace) tick.contact = false;
  const PageOfParts page = reported.page();
  EXPECT_EQ(names_of(page.data["parts"], "title"),
            (Names{all_parts[0], all_parts[1], all_parts[2], all_parts[4]}));
  EXPECT_EQ(names_of(page.data["missing"], "name"), Names{"A profile of the sand"});
}

TEST(RunReport, APictureThatCannotBeDrawnIsSaid) {
  Reported reported;
  reported.run.write(reported.folder / "run.h5");
  const PageOfParts page = run_report(
      RunFile(reported.folder / "run.h5"),
      [](const LastSurface&) -> Image { throw_input_error("a bed of 9 x 9 cells cannot be drawn"); }, {});
  EXPECT_EQ(names_of(page.data["missing"], "name"), Names{"The picture"});
  EXPECT_EQ(page.data["parts"].size(), 4u);
}

TEST(RunReport, SaysTheErrorThatWasEstimated) {
  ErrorEstimate error;
  error.height_share = 0.25;
  error.height_rms = 1e-4;
  error.height_max = 2e-3;
  error.force_rms = 0.1;
  error.force_max = 0.5;
  const Json part = Reported().page(error).data["parts"][4];
  std::vector<double> values;
  for (const Json& figure : part["figures"]) values.push_back(figure["value"]);
  EXPECT_EQ(values, (std::vector{25.0, 0.1, 2.0, 0.1, 0.5}));
  EXPECT_EQ(names_of(part["figures"], "unit"), (Names{"%", "mm", "mm", "N", "N"}));
  error.at_rest = false;
  EXPECT_NE(Reported().page(error).data["parts"][4]["text"].get<std::string>().find("not at rest"),
            std::string::npos);
  EXPECT_NE(Reported().page().data["parts"][4]["text"].get<std::string>().find("--estimate-error"),
            std::string::npos);
}

class RunReportInBrowser : public BrowserTest {
 protected:
  void open(const PageOfParts& page) {
    browser().open_text(page.html());
    EXPECT_EQ(browser().evaluate("Number(document.documentElement.dataset.errors)"), 0);
    EXPECT_TRUE(browser().errors().empty()) << browser().errors().front();
  }
  Json texts(const std::string& selector) {
    return browser().evaluate("[...document.querySelectorAll('" + selector + "')].map((e) => e.textContent)");
  }
};

TEST_F(RunReportInBrowser, DrawsPictureCurvesProfilesAndTables) {
  open(Reported().page(ErrorEstimate{}));
  EXPECT_EQ(texts("h2"), Json({"Picture", "The sand in 3-D", "Force, depth and energy over time",
                               "Profiles of the sand", "Error estimate", "Settings", "File"}));
  EXPECT_EQ(texts(".facts dt")[3], "Energy into the sand");
  EXPECT_EQ(texts(".facts dd")[3], "0.2080\u00a0J");
  EXPECT_EQ(browser().evaluate("charts.length"), 5);
  EXPECT_EQ(browser().evaluate("Promise.all([...document.images].map((one) => one.decode()))"
                               ".then(() => [document.images.length, document.images[0].naturalWidth])"),
            Json({1, 72}));
  // The charts hold the work of 2 N over 104 mm, and the way of the tip in contact.
  EXPECT_NEAR(browser().evaluate("charts[2].drawn.getOption().series[0].data.at(-1)[1]"), 0.208, 1e-12);
  EXPECT_EQ(browser().evaluate("charts.map(({ drawn }) => drawn.getOption().yAxis[0].name)"),
            Json({"magnitude (N)", "depth (mm)", "energy (J)", "height (mm)", "height (mm)"}));
  EXPECT_EQ(browser().evaluate("charts.slice(3).map(({ drawn }) => drawn.getOption().series.length)"),
            Json({2, 2}));
  EXPECT_EQ(texts("#settings tbody td"), Json({"stroke.file", "\"line.toml\""}));
  EXPECT_EQ(browser().evaluate("document.querySelectorAll('#part-5 tbody tr').length"), 5);
}

TEST_F(RunReportInBrowser, ARunWithoutAStrokeIsDrawnAndSaysSo) {
  Reported reported;
  reported.run.scene = "[bed]\n";
  reported.run.has_trace = false;
  open(reported.page());
  EXPECT_EQ(browser().evaluate("charts.length"), 0);
  EXPECT_NE(texts(".warning")[0].get<std::string>().find("the bed only came to rest"), std::string::npos);
}

TEST_F(RunReportInBrowser, TextOfTheFileStaysText) {
  PageOfParts page = Reported().page();
  page.data["scene"] = "[tool]\nradius = \"" + hostile + "\"\n";
  page.data["missing"] = {{{"name", "The stroke"}, {"sentence", "damaged"}}};
  for (const char* part : {"provenance", "missing"}) poison(page.data[part]);
  page.title = hostile;
  open(page);
  for (const char* place : {"h1", ".warning", "#file"})
    EXPECT_NE(texts(place)[0].get<std::string>().find(hostile.substr(0, 100)), std::string::npos) << place;
  EXPECT_EQ(browser().evaluate("document.documentElement.dataset.hacked ?? null"), nullptr);
}

}  // namespace
}  // namespace sandstroke
