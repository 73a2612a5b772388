// The live view in a real browser, used by mouse and keyboard.
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "browser.h"
#include "cli/viewed_program.h"
#include "io/png_file.h"
#include "io/run_file.h"
#include "io/stroke_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

class CliLivePage : public BrowserTest {
 protected:
  /// Opens the view of a program and waits for the first sand.
  void open(const Viewed& program) {
    browser().open_address(program.address());
    browser().wait_for("live.view !== null && live.messages > 0");
  }
  /// The position in the window of a position on the bed [m].
  Point seen(double x, double y, double z = 0.0) {
    const nlohmann::json at = browser().evaluate(fmt::format(
        "(() => {{ const box = live.view.canvas.getBoundingClientRect(), {{ width, height }} = box, "
        "aspect = width / height, camera = live.view.camera.of(aspect), "
        "from = plus([{}, {}, {}], camera.eye, -1), deep = dot(from, camera.forward); "
        "return [box.left + width / 2 * (1 + dot(from, camera.right) / (deep * camera.tan * aspect)), "
        "box.top + height / 2 * (1 - dot(from, camera.up) / (deep * camera.tan))]; }})()",
        x, y, z));
    return {at[0], at[1]};
  }
  Image picture() {
    const fs::path file = test_folder_ / "window.png";
    std::ofstream(file, std::ios::binary) << browser().screenshot();
    return read_png(file);
  }
  static int brightness(const Image& image, Point at) {
    const std::uint8_t* pixel = image.pixel(static_cast<int>(at.x), static_cast<int>(at.y));
    return pixel[0] + pixel[1] + pixel[2];
  }
  /// The newest picture is on the screen, in full.
  void settle() {
    browser().evaluate(
        "new Promise((done) => { live.view.drawNow(); requestAnimationFrame(() => "
        "requestAnimationFrame(() => done(1))); })");
  }
  const fs::path test_folder_ = test_folder();
};

TEST_F(CliLivePage, ShowsTheFurrowWhereTheStrokeWentAndTurnsByMouseAndKeys) {
  Viewed program({"record", "--device", "scripted:line.toml", "--feel", "scene.toml", "--view", "--no-open",
                  "--max-skipped", "100", "-o", "a.h5"},
                 test_folder_);
  open(program);
  browser().wait_for("live.ended");
  EXPECT_EQ(program.end().exit_code, 0);
  // The furrow along x, seen from above without the tool, is darker where it faces away from the sun.
  browser().evaluate("(() => { const view = live.view; view.tool = null; view.camera.turn(0, 2); })()");
  settle();
  const Image window = picture();
  const auto contrast = [&](double x) {  // across the stroke
    int dark = 1000, light = 0;
    for (double y = -0.012; y <= 0.012; y += 0.001) {
      const int here = brightness(window, seen(x, y));
      dark = std::min(dark, here);
      light = std::max(light, here);
    }
    return light - dark;
  };
  EXPECT_GT(contrast(0.0), 120);  // in the stroke
  EXPECT_LT(contrast(0.09), 60);  // beyond its end
  // The page knows what was recorded: deeper than 2 mm in the middle, level far away.
  EXPECT_LT(browser().evaluate("(() => { const { heights } = live.view.picture, { rows, cols } = live.hello; "
                               "return heights[Math.floor(rows / 2) * cols + Math.floor(cols / 2)]; })()"),
            -0.002);

  const auto azimuth = [&] { return browser().evaluate("live.view.camera.state.azimuth").get<double>(); };
  const double before = azimuth();
  const Point middle = browser().centre("canvas");
  browser().drag(middle, {middle.x + 100, middle.y});
  const double dragged = azimuth();
  EXPECT_LT(dragged, before);  // the sand follows the hand
  browser().press("ArrowLeft");
  EXPECT_GT(azimuth(), dragged);
  const double distance = browser().evaluate("live.view.camera.state.distance");
  browser().press("+");
  EXPECT_LT(browser().evaluate("live.view.camera.state.distance"), distance);
  browser().press("Home");
  EXPECT_DOUBLE_EQ(azimuth(), browser().evaluate("(-70 * Math.PI) / 180").get<double>());
  // Colours by height: by key, and the button says so.
  const Image sand = picture();
  browser().press("c");
  settle();
  EXPECT_EQ(browser().evaluate("document.querySelector('.tools button').getAttribute('aria-pressed')"),
            "true");
  EXPECT_NE(picture().rgb, sand.rgb);
  EXPECT_TRUE(browser().errors().empty()) << browser().errors().front();
}

TEST_F(CliLivePage, DrawsTheToolAsItIs) {
  Viewed program({"record", "--device", "scripted:line.toml", "--feel", "scene.toml", "--set",
                  "tool.shape=plate", "--set", "tool.width=0.12", "--set", "tool.thickness=0.006", "--set",
                  "model.preset=accurate", "--view", "--no-open", "--max-skipped", "100", "-o", "plate.h5"},
                 test_folder_);
  open(program);
  browser().wait_for("live.ended && live.view.tool !== null");
  EXPECT_EQ(program.end().exit_code, 0);
  browser().evaluate("live.view.camera.turn(0, 2)");
  settle();
  const Image window = picture();
  const nlohmann::json tip = browser().evaluate("live.view.tool.tip");
  const double top = tip[2].get<double>() + 0.04;  // tool.height
  const auto is_steel = [&](double x, double y) {  // bluish, as no sand is
    const Point at = seen(tip[0].get<double>() + x, tip[1].get<double>() + y, top);
    const std::uint8_t* pixel = window.pixel(static_cast<int>(at.x), static_cast<int>(at.y));
    return pixel[2] > pixel[0];
  };
  SCOPED_TRACE(browser().evaluate("JSON.stringify(live.head)").get<std::string>());
  // Along y, as far as the blade is wide, and nowhere else.
  for (const double y : {-0.055, -0.03, 0.0, 0.03, 0.055}) EXPECT_TRUE(is_steel(0.0, y)) << y;
  for (const double y : {-0.068, 0.068}) EXPECT_FALSE(is_steel(0.0, y)) << y;
  for (const double x : {-0.012, 0.012}) EXPECT_FALSE(is_steel(x, 0.03)) << x;
}

TEST_F(CliLivePage, DrawsTheSandOnTheTool) {
  write_file(test_folder_ / "shovel.toml",
             "[model]\npreset = \"accurate\"\n[bed]\nsize = [0.3, 0.2]\ncells = [75, 50]\n[tool]\n"
             "shape = \"shovel\"\nsize = [0.06, 0.06, 0.025]\nthickness = 0.008\ncarries = true\n[stroke]\n"
             "file = \"spoon.toml\"\n");
  write_file(test_folder_ / "spoon.toml",
             "clearance = 0.05\nspeed = 0.2\nplunge_speed = 0.2\nstart = [-0.1, 0.0]\n[[segment]]\n"
             "kind = \"line\"\nto = [-0.02, 0.0]\ndepth = [0.0, 0.02, 0.02, -0.05]\n");
  Viewed program({"run", "shovel.toml", "-o", "a.h5", "--view", "--no-open"}, test_folder_);
  open(program);
  browser().wait_for("live.ended");
  EXPECT_EQ(program.end().exit_code, 0);
  browser().evaluate("live.view.camera.turn(0, 2)");
  settle();
  const Image window = picture();
  const nlohmann::json tip = browser().evaluate("live.view.tool.tip");
  const auto is_sand = [&](double x, double y, double above) {  // reddish, as no steel is
    const Point at = seen(tip[0].get<double>() + x, tip[1].get<double>() + y, tip[2].get<double>() + above);
    const std::uint8_t* pixel = window.pixel(static_cast<int>(at.x), static_cast<int>(at.y));
    return pixel[0] > pixel[2];
  };
  EXPECT_TRUE(is_sand(-0.005, 0.0, 0.015));   // in the middle of the shovel
  EXPECT_FALSE(is_sand(-0.026, 0.0, 0.025));  // on its back
  EXPECT_TRUE(browser().errors().empty()) << browser().errors().front();
}

TEST_F(CliLivePage, AMouseDrawsAStrokeWhoseRunIsWhatWasSeen) {
  const std::vector<std::string> firm = {"--set", "relaxation.talus_angle=85", "--set", "relaxation.rate=0"};
  std::vector<std::string> arguments = {"record",  "--max-skipped", "100",        "--device",
                                        "pointer", "--feel",        "scene.toml", "-o",
                                        "hand.h5", "--no-open",     "--json"};
  arguments.insert(arguments.end(), firm.begin(), firm.end());
  Viewed program(arguments, test_folder_);
  open(program);
  const Point from = seen(-0.04, 0.0), to = seen(0.04, 0.0);
  browser().drag(from, to, 40, 60.0);
  browser().click(".finish");
  browser().wait_for("live.ended");
  const ProgramResult recorded = program.end();
  ASSERT_EQ(recorded.exit_code, 0) << recorded.err;
  const nlohmann::json seen_heights =
      browser().evaluate("Array.from(live.view.picture.heights, (height) => Math.round(1e7 * height))");
  std::vector<std::string> again = {"run", "scene.toml", "--stroke", "hand.h5", "-o", "hand-run.h5"};
  again.insert(again.end(), firm.begin(), firm.end());
  ASSERT_EQ(run_program(again, test_folder_).exit_code, 0);
  const HeightField run = last_surface(RunFile(test_folder_ / "hand-run.h5")).surface;
  double deepest = 0.0, apart = 0.0;
  for (int row = 0; row < run.rows(); ++row)
    for (int col = 0; col < run.cols(); ++col) {
      deepest = std::min(deepest, run(row, col));
      const double there =
          1e-7 * seen_heights[static_cast<std::size_t>(row * run.cols() + col)].get<double>();
      apart = std::max(apart, std::abs(run(row, col) - there));
    }
  EXPECT_LT(deepest, -0.002);
  // Neither knows more between two samples than both: the longest way from one to the next.
  const Stroke stroke = read_stroke_file(test_folder_ / "hand.h5");
  double way = 0.0;  // m
  for (std::size_t i = 1; i < stroke.size(); ++i)
    way = std::max(way, (stroke.position[i] - stroke.position[i - 1]).norm());
  EXPECT_LE(apart, way);
  EXPECT_TRUE(browser().errors().empty()) << browser().errors().front();
}

}  // namespace
}  // namespace sandstroke
