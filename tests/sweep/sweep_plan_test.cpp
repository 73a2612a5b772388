#include "sweep/sweep_plan.h"

#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/output_file.h"
#include "sweep/metrics.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

constexpr const char* begin_plan = "[sweep]\nscene = \"scenes/scene.toml\"\n";  // two lines

class APlan : public testing::Test {
 protected:
  APlan() {
    fs::create_directories(folder / "scenes");
    put_text(folder / "scenes/scene.toml",
             "[bed]\nsize = [0.3, 0.3]\ncells = [60, 60]\n[tool]\nradius = 0.01\n"
             "[stroke]\nfile = \"line.toml\"\n");
    for (const char* name : {"scenes/line.toml", "other.toml"})
      put_text(folder / name,
               "depth = 0.005\n[[segment]]\nkind = \"line\"\nfrom = [-0.1, 0]\nto = [0.1, 0]\n");
  }

  SweepPlan load(const std::string& text) {
    put_text(folder / "plan.toml", text);
    return load_plan(folder / "plan.toml");
  }
  /// The sentence with which it is refused.
  std::string refusal(const std::string& text) {
    try {
      load(text);
    } catch (const Error& failure) {
      EXPECT_EQ(failure.kind(), ErrorKind::input);
      return failure.what();
    }
    return "no refusal";
  }
  SweepDesign axes(const std::string& text) {
    return load(std::string(begin_plan) + "[axes]\n" + text).design;
  }

  TestFolder temporary;
  const fs::path folder = temporary.path();
};

TEST_F(APlan, TakesRangesListsAndLogarithms) {
  const SweepDesign design = axes(
      "relaxation.talus_angle = { from = 20, to = 45, step = 2.5 }\n"
      "force.k_s = { from = 1, to = 10000, count = 5, scale = \"log\" }\n"
      "model.preset = [\"paper\", \"accurate\"]\n"
      "bed.cells = [[60, 60], [30, 30]]\n");
  ASSERT_EQ(design.axes.size(), 4u);  // in the order of the file
  EXPECT_EQ(design.shape(), (std::vector<std::size_t>{11, 5, 2, 2}));
  EXPECT_EQ(design.axes[0].unit, "deg");
  EXPECT_EQ(design.axes[0].values[1], "22.5");
  EXPECT_EQ(design.axes[0].values.back(), "45");
  EXPECT_EQ(design.axes[1].values[3], "1000");
  EXPECT_TRUE(design.axes[1].logarithmic);
  EXPECT_EQ(design.axes[2].label(1), "accurate");
  EXPECT_EQ(design.axes[3].values[1], "[30, 30]");
}

TEST_F(APlan, AStepThatDoesNotReachTheEndStopsBeforeIt) {
  EXPECT_EQ(axes("force.k_s = { from = 1, to = 2, step = 0.4 }").axes[0].values,
            (std::vector<std::string>{"1", "1.4", "1.8"}));
  EXPECT_EQ(axes("view.azimuth = { from = 30, to = -30, step = -30 }").axes[0].values,
            (std::vector<std::string>{"30", "0", "-30"}));
  EXPECT_EQ(axes("view.azimuth = { from = -0.3, to = 0.05, step = 0.1 }").axes[0].values,
            (std::vector<std::string>{"-0.3", "-0.2", "-0.1", "0"}));
}

TEST_F(APlan, ALatinHypercubeFillsRangesAndLists) {
  const SweepPlan plan = load(
      "[sweep]\nscene = \"scenes/scene.toml\"\ndesign = \"latin\"\nsamples = 40\nseed = 3\n"
      "[axes]\nrelaxation.talus_angle = { from = 20, to = 40 }\n"
      "force.k_s = { from = 1, to = 1e4, scale = \"log\" }\nmodel.preset = [\"paper\", \"accurate\"]\n");
  ASSERT_EQ(plan.design.points(), 40u);
  std::vector<int> fortieths(40), decades(4), presets(2);
  for (std::size_t i = 0; i < 40; ++i) {
    const double angle = plan.design.axes[0].number(i), k_s = plan.design.axes[1].number(i);
    ++fortieths.at(static_cast<std::size_t>((angle - 20.0) * 2.0));
    ++decades.at(static_cast<std::size_t>(std::log10(k_s)));
    ++presets[plan.design.axes[2].label(i) == "paper"];
  }
  EXPECT_EQ(fortieths, std::vector<int>(40, 1));
  EXPECT_EQ(decades, std::vector<int>(4, 10));
  EXPECT_EQ(presets, std::vector<int>(2, 20));
}

TEST_F(APlan, StrokesAreAnAxisWhoseFilesAreRelativeToThePlan) {
  const SweepPlan plan = load(
      "[sweep]\nscene = \"scenes/scene.toml\"\nstrokes = [\"scenes/line.toml\", \"other.toml\"]\n"
      "[set]\nbed.cells = [80, 80]\n[axes]\nforce.k_s = [1, 2, 3]\n");
  EXPECT_EQ(plan.design.shape(), (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(plan.design.axes[0].label(1), "../other.toml");
  const Scene scene = plan.scene_of(4);
  EXPECT_EQ(scene.stroke->file, "../other.toml");
  EXPECT_EQ(scene.force.k_s, 2.0);
  EXPECT_EQ(scene.bed.cols, 80);
}

TEST_F(APlan, StrokesMayBeAnAxisLikeAnyOther) {
  EXPECT_EQ(axes("force.k_s = [1]\nstroke.file = [\"line.toml\", \"../other.toml\"]\n").points(), 2u);
}

TEST_F(APlan, CollectsAllMetricsOrThoseNamed) {
  const auto metrics_with = [&](const std::string& keys) {
    return load(std::string(begin_plan) + keys + "[axes]\nforce.k_s = [1]\n").metrics.size();
  };
  const auto needing = [](Metric::Needs what) {
    return static_cast<std::size_t>(
        std::count_if(all_metrics().begin(), all_metrics().end(),
                      [&](const Metric& metric) { return metric.needs == what; }));
  };
  put_text(folder / "golden.h5", "checked when it is read");
  const std::string golden = "golden = \"golden.h5\"\n", error = "estimate_error = \"coarser\"\n";
  EXPECT_EQ(metrics_with(""), all_metrics().size() - needing(Metric::golden) - needing(Metric::error));
  EXPECT_EQ(metrics_with(golden), all_metrics().size() - needing(Metric::error));
  EXPECT_EQ(metrics_with(golden + error), all_metrics().size());
  const SweepPlan plan =
      load(std::string(begin_plan) +
           "metrics = [\"work\", \"passes\"]\nkeep = [\"picture\"]\n[axes]\nforce.k_s = [1]\n");
  EXPECT_EQ(plan.metrics, (std::vector<std::string>{"work", "passes"}));
  EXPECT_TRUE(plan.keep_picture);
  EXPECT_FALSE(plan.keep_surface);
}

TEST_F(APlan, IsRefusedInOneSentenceThatSaysWhere) {
  const std::string start = begin_plan;
  const std::string axes = start + "[axes]\n";
  // The plan, and what the sentence must hold.
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "sweep.scene is missing; add it"},
      {"[swep]\nscene = \"scenes/scene.toml\"\n",
       "plan.toml: sweep.scene is missing; add it, or is swep meant to be sweep?"},
      {"[sweep]\nscen = \"scenes/scene.toml\"\n",
       "plan.toml: sweep.scene is missing; add it, or is scen meant to be scene?"},
      {"[sweep]\nscene = 5\n", "plan.toml:2: sweep.scene is an integer"},
      {start, "axes is missing or empty"},
      {start + "[axes]\n", "axes is missing or empty"},
      {start + "colour = 1\n[axes]\nforce.k_s = [1]\n", "plan.toml:3: unknown key sweep.colour"},
      {axes + "force.k_s = []\n", "plan.toml:4: axes.force.k_s is empty"},
      {axes + "force.k_s = [1, 1]\n", "plan.toml:4: axes.force.k_s contains a value twice"},
      {axes + "device.delay = [16, 0x10]\n", "plan.toml:4: axes.device.delay contains a value twice"},
      {axes + "force.ks = [1]\n",
       "plan.toml:4: axes.force.ks cannot be 1: unknown key force.ks; did you mean force.k_s?"},
      {axes + "force.k_s = [1]\nrelaxation.talus_angle = [30, 95]\n",
       "plan.toml:5: axes.relaxation.talus_angle cannot be 95: relaxation.talus_angle is 95; give a number "
       "above 0"},
      {axes + "force.k_s = [1, \"two\"]\n", "axes.force.k_s cannot be \"two\": force.k_s is a string"},
      {axes + "force.k_s = [1, nan]\n", "axes.force.k_s cannot be nan"},
      {axes + "tool.radius = [0.01, 0.2]\n",
       "plan.toml:4: axes.tool.radius cannot be 0.2: tool.radius = 0.2 m: the tool"},
      {axes + "force.k_s = { from = 1 }\n", "axes.force.k_s.to is missing"},
      {axes + "force.k_s = { to = 2, step = 1 }\n", "axes.force.k_s.from is missing"},
      {axes + "force.k_s = { step = 1 }\n", "axes.force.k_s.from is missing"},
      {axes + "force.k_s = { start = 1, stop = 2 }\n",
       "plan.toml:4: axes.force.k_s.start cannot be 1: force.k_s is a table; give a number"},
      {axes + "force.k_s = { from = 1, to = 1, count = 3 }\n",
       "plan.toml:4: axes.force.k_s contains a value twice"},
      {start + "strokes = [\"other.toml\", \"scenes/../other.toml\"]\n",
       "sweep.strokes contains a value twice"},
      {axes + "force.k_s = { from = 1, to = 2 }\n", "has no number of values; add count or step"},
      {axes + "force.k_s = { from = 1, to = 2, step = 0 }\n", "axes.force.k_s.step"},
      {axes + "force.k_s = { from = 1, to = 2, step = -1 }\n", "goes away from `to`: from = 1, to = 2"},
      {axes + "force.k_s = { from = 1, to = 2, count = 0 }\n", "axes.force.k_s.count is 0"},
      {axes + "force.k_s = { from = 1, to = 2, count = 2, step = 1 }\n", "both count and step"},
      {axes + "force.k_s = { from = 0, to = 2, count = 2, scale = \"log\" }\n", "give from and to above 0"},
      {axes + "force.k_s = { from = 1, to = 2, count = 2, scale = \"cubic\" }\n", "take one of: linear, log"},
      {axes + "force.k_s = { from = 1, to = 2, cuont = 2 }\n", "axes.force.k_s"},
      {axes + "force.k_s = { from = 1, to = 2e300, step = 1e-300 }\n", "sweep.max_points is 10000"},
      {axes + "\"force.k_s\" = [1]\n", "write dotted keys without quotes"},
      {axes +
           "force.k_s = { from = 1, to = 2, count = 200 }\nforce.k_f = { from = 1, to = 2, count = 200 }\n",
       "give 40000 points and sweep.max_points is 10000"},
      {start + "max_points = 3\n[axes]\nforce.k_s = [1, 2, 3, 4]\n",
       "give 4 points and sweep.max_points is 3"},
      {start + "design = \"latin\"\n[axes]\nforce.k_s = [1]\n", "sweep.samples is missing"},
      {start + "samples = 5\n[axes]\nforce.k_s = [1]\n",
       "plan.toml:3: sweep.samples applies only where sweep.design is latin; remove it, or change that"},
      {axes + "bed.surface.amplitude = [0.001]\n",
       "plan.toml:4: axes.bed.surface.amplitude cannot be 0.001: bed.surface.amplitude applies only where "
       "bed.surface.kind is noise or ripples"},
      {start + "[set]\nforce.k_s = 5\n[axes]\nforce.k_s = [1]\n", "is also in [set]"},
      {start + "[set]\nforce.k_s = -5\n[axes]\nforce.k_f = [1]\n", "plan.toml:4: set.force.k_s cannot be -5"},
      {start + "strokes = []\n[axes]\nforce.k_s = [1]\n", "sweep.strokes is empty"},
      {start + "strokes = [\"other.toml\"]\n[axes]\nstroke.file = [\"x\"]\n", "also in sweep.strokes"},
      {start + "strokes = [\"other.toml\"]\n[set]\nstroke.file = \"x\"\n",
       "plan.toml:5: set.stroke.file is also in sweep.strokes"},
      {start + "metrics = [\"weight\"]\n[axes]\nforce.k_s = [1]\n", "names 'weight'; take from: max_force"},
      {start + "metrics = [\"golden_rms\"]\n[axes]\nforce.k_s = [1]\n", "and with sweep.golden"},
      {start + "metrics = []\n[axes]\nforce.k_s = [1]\n", "sweep.metrics is empty"},
      {start + "keep = [\"all\"]\n[axes]\nforce.k_s = [1]\n", "take from: surface, picture"},
      {"[sweep\n", "plan.toml:1: not valid TOML"},
  };
  for (const auto& [plan, sentence] : cases) {
    const std::string refused = refusal(plan);
    EXPECT_NE(refused.find(sentence), std::string::npos) << plan << "\n" << refused;
    EXPECT_EQ(refused.find('\n'), std::string::npos) << refused;
  }
}

TEST_F(APlan, OverKindsNamesPerKindWhatIsLeftOut) {
  put_text(folder / "scenes/scene.toml",
           "[bed]\nsize = [0.3, 0.3]\ncells = [300, 300]\n[tool]\nradius = 0.02\n[force]\nk_s = 500\n"
           "[displacement]\ndeposit = 'outward'\n[stroke]\nfile = \"line.toml\"\n");
  const SweepPlan plan = load(std::string(begin_plan) +
                              "[set]\ntool.width = 0.05\n[axes]\ntool.shape = [\"sphere\", \"plate\"]\n"
                              "force.law = [\"paper\", \"rft\"]\n");
  EXPECT_EQ(
      plan.notes,
      (std::vector<std::string>{
          "tool.shape = sphere: tool.width is left out, because it applies only where tool.shape is plate",
          "tool.shape = plate: tool.radius is left out, because it applies only where tool.shape is "
          "sphere or cylinder or cone or rake or bowl",
          "force.law = rft: force.k_s is left out, because it applies only where force.law is paper"}));
  EXPECT_EQ(plan.scene_of(0).tool.radius, 0.02);
  EXPECT_EQ(plan.scene_of(3).tool.width, 0.05);
  EXPECT_EQ(plan.scene_of(3).force.law, ForceLaw::rft);
}

TEST_F(APlan, ChecksTheValuesOfAnAxisThatAppliesOnlyWithAnotherKind) {
  const std::string shapes = std::string(begin_plan) +
                             "[set]\ndisplacement.deposit = \"outward\"\nbed.cells = [300, 300]\n"
                             "[axes]\ntool.shape = [\"sphere\", \"plate\"]\n";
  EXPECT_EQ(load(shapes + "tool.width = [0.02, 0.05]\n").design.axes[1].unit, "m");
  EXPECT_NE(refusal(shapes + "tool.width = [0.02, -0.05]\n").find("axes.tool.width cannot be -0.05"),
            std::string::npos);
  EXPECT_NE(
      refusal(shapes + "tool.teeth = [2, 3]\n").find("tool.teeth applies only where tool.shape is rake"),
      std::string::npos);
  EXPECT_NE(refusal(std::string(begin_plan) + "[set]\ntool.width = 0.02\n[axes]\nforce.k_s = [1]\n")
                .find("set.tool.width cannot be 0.02: tool.width applies only where tool.shape is plate"),
            std::string::npos);
}

/// A plan of a few kilobytes could ask for 1e10 numbers.
TEST_F(APlan, VariesStonesRegionsAndTheFloor) {
  const std::string garden =
      "[bed]\nsize = [0.3, 0.3]\ncells = [60, 60]\nfloor = -0.02\n[tool]\nradius = 0.01\n"
      "[[sand.region]]\ntalus_angle = 35.0\n[[stone]]\ncentre = [0.0, 0.0, 0.0]\n"
      "[[stone]]\nshape = 'box'\ncentre = [0.1, 0.0, 0.0]\n";
  put_text(folder / "scenes/scene.toml", garden);
  const SweepPlan plan = load(std::string(begin_plan) +
                              "[set]\nstone.2.turn = 20.0\n[axes]\nstone.1.radius = [0.02, 0.03]\n"
                              "bed.floor = { from = -0.04, to = -0.02, count = 3 }\n"
                              "sand.region.1.talus_angle = [30.0, 40.0]\n");
  EXPECT_EQ(plan.design.shape(), (std::vector<std::size_t>{2, 3, 2}));
  EXPECT_EQ(plan.design.axes[0].unit, "m");
  EXPECT_EQ(plan.design.axes[2].unit, "deg");
  const SceneFile last = plan.scene_of(11);
  EXPECT_EQ(last.ground.stones[0].radius, 0.03);
  EXPECT_EQ(last.ground.stones[1].turn, 20.0);
  EXPECT_EQ(last.ground.floor, -0.02);
  EXPECT_EQ(last.ground.regions[0].talus_angle, 40.0);

  // A key of a box is left out where the stone is a sphere.
  const SweepPlan shapes = load(std::string(begin_plan) +
                                "[axes]\nstone.2.shape = ['box', 'sphere']\n"
                                "stone.2.size = [[0.1, 0.1, 0.02], [0.1, 0.1, 0.04]]\n");
  EXPECT_EQ(shapes.scene_of(1).ground.stones[1].size.z(), 0.04);
  EXPECT_EQ(shapes.scene_of(3).ground.stones[1].shape, StoneShape::sphere);
  EXPECT_NE(refusal(std::string(begin_plan) + "[axes]\nstone.3.radius = [0.02, 0.03]\n")
                .find("axes.stone.3.radius cannot be 0.02: " + (folder / "scenes/scene.toml").string() +
                      " has 2 [[stone]] tables, counted "
                      "from 1, and no stone.3"),
            std::string::npos)
      << refusal(std::string(begin_plan) + "[axes]\nstone.3.radius = [0.02, 0.03]\n");
  EXPECT_NE(refusal(std::string(begin_plan) + "[axes]\nstone.1.radius = [0.02, -0.03]\n")
                .find("axes.stone.1.radius cannot be -0.03: stone.1.radius is -0.03; give a number above 0"),
            std::string::npos);
}

TEST_F(APlan, MayHaveAsManyPointsAsMaxPointsSays) {
  EXPECT_EQ(
      load(std::string(begin_plan) + "max_points = 4\n[axes]\nforce.k_s = [1, 2, 3, 4]\n").design.points(),
      4u);
}

TEST_F(APlan, ValuesWithoutEndAreRefusedBeforeTheyAreMade) {
  std::string ranges, open_ranges;
  for (int i = 0; i < 200; ++i) {
    ranges += fmt::format("a.b{} = {{ from = 0, to = 1, count = 10000 }}\n", i);
    open_ranges += fmt::format("a.b{} = {{ from = 0, to = 1 }}\n", i);
  }
  EXPECT_NE(refusal(std::string(begin_plan) + "[axes]\n" + ranges).find("axes have over 1000000 values"),
            std::string::npos);
  const std::string latin = std::string(begin_plan) + "design = \"latin\"\nmax_points = 10000000\n";
  EXPECT_NE(
      refusal(latin + "samples = 10000000\n[axes]\n" + open_ranges).find("axes have over 1000000 values"),
      std::string::npos);
}

TEST_F(APlan, FilesThatAreNotThereAreRefused) {
  for (const std::string text : {"[sweep]\nscene = \"none.toml\"\n",
                                 "[sweep]\nscene = \"scenes/scene.toml\"\nstrokes = [\"none.h5\"]\n",
                                 "[sweep]\nscene = \"scenes/scene.toml\"\ngolden = \"none.h5\"\n"}) {
    try {
      load(text + "[axes]\nforce.k_s = [1]\n");
      ADD_FAILURE() << text;
    } catch (const Error& failure) {
      EXPECT_EQ(failure.kind(), ErrorKind::io);
      EXPECT_NE(std::string(failure.what()).find("none."), std::string::npos) << failure.what();
    }
  }
}

}  // namespace
}  // namespace sandstroke
