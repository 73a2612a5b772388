#include "io/scene_toml.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "core/error.h"
#include "io/scene_keys.h"

namespace sandstroke {
namespace {

SceneFile read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return scene_from_text(text, "scene.toml", overrides);
}

TEST(SceneToml, AnEmptySceneIsThePapers) {
  const Scene scene = read("");
  EXPECT_EQ(scene.bed.width, 2.0);
  EXPECT_EQ(scene.bed.rows, 1000);
  EXPECT_EQ(scene.tool.radius, 0.01);
  EXPECT_EQ(scene.force.k_s, 1000.0);
  EXPECT_EQ(scene.force.k_c, 0.5);
  EXPECT_EQ(scene.force.k_f, 10.0);
  EXPECT_EQ(scene.relaxation.law, RelaxationLaw::paper);
  EXPECT_EQ(scene.relaxation.talus_angle, 30.0);
  EXPECT_EQ(scene.displacement.deposit, Deposit::ring);
  EXPECT_EQ(scene.tool.profile, ToolProfile::paper);
  EXPECT_FALSE(scene.stroke.has_value());
}

TEST(SceneToml, ThePresetIsOverriddenByKeysAndKeysBySet) {
  const Scene scene =
      read("[model]\npreset = 'accurate'\n[displacement]\ndeposit = 'ring'\n[relaxation]\ntalus_angle = 20\n",
           {"relaxation.talus_angle=25"});
  EXPECT_EQ(scene.tool.profile, ToolProfile::sphere);
  EXPECT_EQ(scene.relaxation.law, RelaxationLaw::faces);
  EXPECT_EQ(scene.displacement.deposit, Deposit::ring);
  EXPECT_EQ(scene.relaxation.talus_angle, 25.0);
}

TEST(SceneToml, AWayInCellsIsPassedOverWhereItWasNoneOrARunStoredIt) {
  EXPECT_EQ(read("[relaxation]\ntravel = 0.0\n").relaxation.way, 0.0);
  const Scene stored = stored_scene("[relaxation]\ntravel = 2.0\nrate = 50.0\n", "run.h5: /scene");
  EXPECT_EQ(stored.relaxation.rate, 50.0);
  EXPECT_THROW(stored_scene("[relaxation]\ntravl = 2.0\n", "run.h5: /scene"), Error);
}

TEST(SceneToml, DevicePresetSetsItsLimitsAndKeysOverrideThem) {
  EXPECT_EQ(read("[device]\npreset = 'touch'\n").device.max_force, 3.3);
  EXPECT_EQ(read("[device]\npreset = 'touch'\nmax_force = 1\n").device.max_force, 1.0);
}

TEST(SceneToml, ALateLoopIsADynamicDevices) {
  const DeviceSettings late = read("[device]\nmodel = 'dynamic'\ndelay = 12\ndropped_ticks = 0.25\n").device;
  EXPECT_EQ(late.delay, 12);
  EXPECT_EQ(late.dropped_ticks, 0.25);
  EXPECT_EQ(read("[device]\nmodel = 'dynamic'\ndrag = 'implicit'\n").device.drag, DragVelocity::implicit);
  for (const char* text :
       {"[device]\ndelay = 1\n", "[device]\nmodel = 'dynamic'\ndelay = -1\n",
        "[device]\nmodel = 'dynamic'\ndelay = 1001\n", "[device]\nmodel = 'dynamic'\ndropped_ticks = 1.0\n"})
    EXPECT_THROW(read(text), Error) << text;
}

TEST(SceneToml, TheResolvedTextReadsBackAsTheSameScene) {
  const SceneFile scene = read(
      "[model]\npreset = 'accurate'\n[bed]\nsize = [0.5, 1.0]\ncells = [100, 200]\n"
      "surface = { kind = 'noise', amplitude = 0.003, seed = 9 }\n[tool]\nradius = 0.0123456789\n"
      "[device]\npreset = 'touch'\nmax_force = 2.5\nmodel = 'dynamic'\n"
      "[stroke]\nfile = 'a \"b\".h5'\nplane = 'fit'\ndepth = 0.004\nstop = 3\n[view]\nname = 'top'\n");
  const std::string text = scene_text(scene);
  EXPECT_EQ(scene_text(read(text)), text);
  EXPECT_NE(text.find("radius = 0.0123456789"), std::string::npos);
  EXPECT_NE(text.find("max_force = 2.5"), std::string::npos);
  EXPECT_EQ(read(text).stroke->file, "a \"b\".h5");
}

/// The setting that brings a key: "bed.surface.kind=noise" of "bed.surface.kind is noise or ripples"; empty:
/// nothing.
std::vector<std::string> settings_that_bring(const KeyRow& row) {
  std::smatch found;
  if (!std::regex_match(row.condition, found, std::regex("([\\w.]+) is (.*)"))) return {};
  std::vector<std::string> settings;
  const std::string values = found[2];
  const std::regex either(" or ");
  for (std::sregex_token_iterator value(values.begin(), values.end(), either, -1), end; value != end; ++value)
    settings.push_back(found[1].str() + "=" + value->str());
  return settings;
}

TEST(SceneToml, EveryKeyOfTheTableIsReadWithItsDefaultJustWhereItSaysThatItApplies) {
  int keys = 0, conditional = 0;
  for (const KeySection& section : all_scene_keys()) {
    for (const KeyRow& row : section.keys) {
      // Files must be given; a key whose presence counts has no default.
      const std::string value = row.key() == "file"                  ? "\"x.h5\""
                                : row.name == "stone.1.centre"       ? "[0.0, 0.0, 0.0]"
                                : row.name == "source.1.at"          ? "[0.0, 0.0, 0.0]"
                                : row.name == "sand.region.1.points" ? "[[0, 0], [1, 0], [0, 1]]"
                                : row.name == "sand.layer.1.top"     ? "-0.02"
                                : row.key() == "friction_angle"      ? "30"
                                : row.value.empty()                  ? "1"
                                                                     : row.value;
      const auto reads = [&](const std::string& with) {
        std::vector<std::string> settings = {row.name + "=" + value};
        if (row.name.starts_with("stone.")) settings.insert(settings.begin(), "stone=[{centre = [0, 0, 0]}]");
        if (row.name.starts_with("sand.layer.")) {
          settings.insert(settings.begin(), "sand.layer=[{top = -0.01, density = 1700}]");
          settings.push_back("force.law=rft");
        }
        if (row.name == "sand.region.1.friction_angle" || row.name == "sand.region.1.density")
          settings.push_back("force.law=rft");
        if (row.name == "sand.region.1.cohesion") settings.push_back("moisture.cohesion=100");
        if (row.key() == "cohesion" || row.name.starts_with("moisture."))
          settings.insert(settings.begin(), "relaxation.law=isotropic");
        if (row.name == "force.blend") settings.insert(settings.begin(), "sand.region=[{k_s = 500}]");
        if (row.name.starts_with("sand.region."))
          settings.insert(settings.begin(), "sand.region=[{talus_angle = 30}]");
        if (row.name.starts_with("sand.map.")) settings.insert(settings.begin(), "sand.map.file=x.png");
        if (row.name.starts_with("moisture.") && row.key() != "cohesion")
          settings.insert(settings.begin(), "moisture.cohesion=100");
        if (row.name.starts_with("ground.")) settings.push_back("bed.floor=0");
        if (with == "stone.1.shape=mesh" && row.key() != "file") settings.push_back("stone.1.file=x.stl");
        if (row.name.starts_with("source."))
          settings = {"source=[{at = [0, 0, 0], rate = 1}]", "stroke.file=x.h5", settings.front()};
        if (row.name.starts_with("stroke.")) settings.push_back("stroke.file=x.h5");
        if (!with.empty()) settings.push_back(with);
        if (with == "bed.surface.kind=file") settings.push_back("bed.surface.file=x.h5");
        if (with == "relaxation.method=multilevel") settings.push_back("relaxation.law=faces");
        if (with.starts_with("tool.shape=")) settings.push_back("displacement.deposit=outward");
        if (with == "tool.shape=mesh" && row.name != "tool.file") settings.push_back("tool.file=x.stl");
        try {
          read("", settings);
          return true;
        } catch (const Error& failure) {
          EXPECT_NE(std::string(failure.what()).find(row.name + " applies only where "), std::string::npos)
              << failure.what();
          return false;
        }
      };
      const std::vector<std::string> brought_by = settings_that_bring(row);
      const bool by_default =
          brought_by.empty() || std::ranges::count(brought_by, "tool.shape=sphere") +
                                        std::ranges::count(brought_by, "force.law=paper") +
                                        std::ranges::count(brought_by, "stone.1.shape=sphere") +
                                        std::ranges::count(brought_by, "sand.region.1.shape=rectangle") >
                                    0;
      EXPECT_EQ(reads(""), by_default) << row.name;
      for (const std::string& setting : brought_by) EXPECT_TRUE(reads(setting)) << row.name << " " << setting;
      conditional += !brought_by.empty();
      ++keys;
    }
  }
  EXPECT_GT(keys, 50);
  EXPECT_EQ(conditional, 48);
}

TEST(SceneToml, AKeyThatDoesNotApplyIsToldWhereItWould) {
  const auto complaint = [](const std::string& text, const std::vector<std::string>& settings = {}) {
    try {
      read(text, settings);
      return std::string();
    } catch (const Error& failure) {
      return std::string(failure.what());
    }
  };
  EXPECT_EQ(complaint("[bed.surface]\nkind = 'file'\nfile = 'a.png'\namplitude = 0.01\n"),
            "scene.toml:4: bed.surface.amplitude applies only where bed.surface.kind is noise or ripples; "
            "remove it, or change that setting");
  EXPECT_EQ(complaint("[device]\n", {"device.delay=2"}),
            "--set device.delay=2: device.delay applies only where device.model is dynamic; remove it, or "
            "change that setting");
  EXPECT_EQ(complaint("[relaxation]\nstep_tolerence = 0.1\n"),
            "scene.toml:2: unknown key relaxation.step_tolerence; did you mean relaxation.step_tolerance?");
  EXPECT_EQ(complaint("", {"bed.surface=4"}),
            "--set bed.surface=4: bed.surface.kind 'surface' is an integer, not a table");
  EXPECT_EQ(complaint("", {"relaxation.rate.x=4"}),
            "--set relaxation.rate.x=4: relaxation.rate is a table; give a number");
  // Each choice of a preset can be made without it.
  EXPECT_EQ(complaint("[displacement]\ndistance = 1.1\n"),
            "scene.toml:2: displacement.distance applies only where displacement.deposit is outward; remove "
            "it, or change that setting");
  EXPECT_EQ(complaint("[model]\npreset = 'accurate'\n[displacement]\ndistance = 1.1\n"), "");
}

TEST(SceneToml, AnotherChoiceLeavesOutWhatTheFileSetForTheOldOne) {
  const std::string blade =
      "[bed.surface]\nkind = 'ripples'\namplitude = 0.003\nwavelength = 0.02\n[tool]\nshape = 'plate'\n"
      "width = 0.04\nthickness = 0.004\n[force]\nlaw = 'rft'\nfriction_angle = 30\n"
      "[device]\nmodel = 'dynamic'\ndelay = 2\n[displacement]\ndeposit = 'outward'\ndistance = 1.1\n";
  for (const auto& [settings, said] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"bed.surface.kind=file", "bed.surface.file=b.h5"},
            "bed.surface.amplitude, bed.surface.wavelength are left out, because they apply only where "
            "bed.surface.kind is noise or ripples"},
           {{"tool.shape=sphere"},
            "tool.thickness is left out, because it applies only where tool.shape is plate or shovel or "
            "bowl; "
            "tool.width is left out, because it applies only where tool.shape is plate"},
           {{"force.law=paper"},
            "force.friction_angle is left out, because it applies only where force.law is"},
           {{"device.model=kinematic"}, "device.delay is left out"},
           {{"displacement.deposit=ring", "tool.shape=sphere"}, "displacement.distance"},
           {{"bed.surface.kind=flat", "bed.cells=[100, 100]"}, "bed.surface.amplitude"},
           {{"force.k_s=1", "force.law=paper"}, "force.friction_angle"},
           {{"bed.cells=[100, 100]"}, ""}}) {
    std::vector<LeftOut> left_out;
    const SceneFile scene = scene_from_text({blade, "scene.toml"}, settings, &left_out);
    const std::string text = left_out_text(left_out);
    EXPECT_NE(text.find(said), std::string::npos) << text;
    EXPECT_EQ(text.empty(), said.empty()) << text;
    // The scene is as one that never had these keys.
    EXPECT_EQ(scene_text(read(scene_text(scene))), scene_text(scene));
  }
}

TEST(SceneToml, OverridesThatContradictEachOtherOrAFileThatDoesAreStillRefused) {
  const std::string contrary = "[force]\nlaw = 'rft'\nk_s = 3\n";
  EXPECT_THROW(read(contrary), Error);
  EXPECT_THROW(read(contrary, {"tool.shape=plate", "displacement.deposit=outward"}), Error);
  EXPECT_THROW(read("", {"force.law=rft", "force.k_s=3"}), Error);
  EXPECT_THROW(read("", {"force.k_s=3", "force.law=rft"}), Error);
  EXPECT_THROW(read("", {"force={law='rft', k_s=3}"}), Error);
  // A mapping's settings are a scene's own: others replace them.
  std::vector<LeftOut> left_out;
  const SceneText mapping{"", "scene", {"force.k_s=3"}};
  EXPECT_EQ(scene_from_text(mapping, {"force.law=rft"}, &left_out).force.law, ForceLaw::rft);
  EXPECT_EQ(left_out.size(), 1u);
}

TEST(SceneToml, AKeyOrASectionCanBeTakenOut) {
  const std::string text = "[tool]\nradius = 0.02\n[stroke]\nfile = 'line.toml'\ndepth = 0.01\n";
  EXPECT_EQ(read(text, {"!tool.radius"}).tool.radius, 0.01);
  EXPECT_EQ(read(text, {"!stroke.depth"}).stroke->placement.depth, 0.0);
  EXPECT_FALSE(read(text, {"!stroke"}).stroke.has_value());
  EXPECT_EQ(read(text, {"!stroke", "stroke.file=other.toml"}).stroke->file, "other.toml");
  for (const auto& [key, said] : {std::pair{"tool.radus",
                                            "--unset tool.radus: scene.toml has no such key; did "
                                            "you mean tool.radius?"},
                                  {"force.k_s", "--unset force.k_s: scene.toml has no such key"},
                                  {"tool.radius.x", "no such key"},
                                  {"tool.radius=1", "--unset tool.radius=1: give only the key"},
                                  {"", "no such key"}}) {
    try {
      read(text, {std::string("!") + key});
      ADD_FAILURE() << key;
    } catch (const Error& failure) {
      EXPECT_NE(std::string(failure.what()).find(said), std::string::npos) << failure.what();
    }
  }
}

TEST(SceneToml, TheEngineThatOldRunFilesNameIsReadAndNotWritten) {
  const std::string text = scene_text(read("[relaxation]\nengine = 'tiles'\nrate = 30.0\n"));
  EXPECT_EQ(text, scene_text(read("[relaxation]\nrate = 30.0\n")));
  EXPECT_EQ(text.find("engine"), std::string::npos);
}

const std::string two_stones =
    "[[stone]]\nshape = 'box'\ncentre = [0.1, 0.2, 0.0]\nsize = [0.1, 0.2, 0.3]\nturn = 20.0\n"
    "[[stone]]\ncentre = [0.3, 0.0, 0.02]\nradius = 0.04\ntalus_angle = 20.0\n";
const std::string two_regions =
    "[[sand.region]]\nsoft = 0.02\ntalus_angle = 35.0\n"
    "[[sand.region]]\nshape = 'polygon'\npoints = [[0.0, 0.0], [0.5, 0.0], [0.0, 0.25]]\n"
    "talus_angle = 25.0\n";

TEST(SceneToml, StonesAndRegionsReadBackAsTheSame) {
  const SceneFile scene = read("[bed]\nfloor = -0.1\n" + two_regions + two_stones);
  ASSERT_EQ(scene.ground.stones.size(), 2u);
  EXPECT_EQ(scene.ground.stones[0].size.z(), 0.3);
  EXPECT_EQ(scene.ground.stones[1].radius, 0.04);
  ASSERT_EQ(scene.ground.regions.size(), 2u);
  EXPECT_EQ(scene.ground.regions[1].points.size(), 3u);
  const std::string text = scene_text(scene);
  EXPECT_NE(text.find("[[stone]]\nshape = \"box\"\n"), std::string::npos) << text;
  EXPECT_NE(text.find("points = [[0.0, 0.0], [0.5, 0.0], [0.0, 0.25]]\n"), std::string::npos) << text;
  EXPECT_EQ(scene_text(read(text)), text);
  EXPECT_EQ(read(text).ground.stones, scene.ground.stones);
  EXPECT_EQ(read(text).ground.regions, scene.ground.regions);
}

TEST(SceneToml, ASceneWithoutAGroundDoesNotSpeakOfIt) {
  for (const char* word : {"floor", "stone", "region", "[ground]"})
    EXPECT_EQ(scene_text(read("")).find(word), std::string::npos) << word;
}

TEST(SceneToml, AStoneIsChangedByItsPlace) {
  EXPECT_EQ(read(two_stones, {"stone.2.radius=0.1"}).ground.stones[1].radius, 0.1);
  std::vector<LeftOut> left_out;
  const SceneFile scene = scene_from_text({two_stones, "scene.toml"}, {"stone.1.shape=sphere"}, &left_out);
  EXPECT_EQ(scene.ground.stones[0].shape, StoneShape::sphere);
  EXPECT_EQ(
      left_out_text(left_out),
      "stone.1.size is left out, because it applies only where stone.1.shape is ellipsoid or box; "
      "stone.1.turn is left out, because it applies only where stone.1.shape is ellipsoid or box or mesh");
  EXPECT_TRUE(applies_conditionally("stone.2.radius"));
  EXPECT_FALSE(applies_conditionally("stone.2.centre"));
}

TEST(SceneToml, RefusesStonesAndRegionsThatCannotBeMeant) {
  const auto said = [](const std::string& text, const std::vector<std::string>& settings = {}) {
    try {
      read(text, settings);
    } catch (const Error& failure) {
      EXPECT_EQ(failure.kind(), ErrorKind::input);
      return std::string(failure.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(said("[[stone]]\n"), "scene.toml:1: stone.1.centre is missing; add it");
  EXPECT_EQ(said("[stone]\nradius = 1.0\n"),
            "scene.toml:1: stone is one table; write [[stone]], with two brackets");
  EXPECT_EQ(said("stone = 3\n"), "scene.toml:1: stone is an integer; write [[stone]] tables");
  EXPECT_EQ(said("[[sand]]\nx = 3\n"),
            "scene.toml:1: sand.map is not found: 'sand' is a list of tables; write [sand]");
  EXPECT_EQ(said("[sand]\nregoin = 3\n"), "scene.toml:2: unknown key sand.regoin; did you mean sand.region?");
  EXPECT_EQ(
      said("[[sand.region]]\n"),
      "scene.toml: sand.region.1 says nothing of its sand; give it a talus_angle, friction_angle, density, "
      "k_s or cohesion");
  EXPECT_EQ(said(two_stones + "size = [1.0, 1.0, 1.0]\n"),
            "scene.toml:10: stone.2.size applies only where stone.2.shape is ellipsoid or box; remove it, or "
            "change that setting");
  EXPECT_EQ(
      said("[ground]\nstiffness = 3.0\n"),
      "scene.toml:1: ground applies only where there is a bed.floor or a [[stone]]; remove it, or change "
      "that setting");
  EXPECT_EQ(said(two_stones, {"stone.3.radius=1"}),
            "--set stone.3.radius=1: scene.toml has 2 [[stone]] tables, counted from 1, and no stone.3");
  EXPECT_EQ(said(two_stones, {"stone.2.centre=[5, 0, 0]"}),
            "--set stone.2.centre=[5, 0, 0]: stone.2 lies outside the bed of 2 m by 2 m; change "
            "stone.2.centre, or remove it");
}

TEST(SceneToml, RefusesWhatCannotBeMeant) {
  const auto refuses = [](const std::string& text, const std::string& part) {
    try {
      read(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const Error& failure) {
      EXPECT_EQ(failure.exit_code(), 2);
      EXPECT_NE(std::string(failure.what()).find("scene.toml"), std::string::npos) << failure.what();
      EXPECT_NE(std::string(failure.what()).find(part), std::string::npos) << failure.what();
    }
  };
  refuses("[tool]\nradus = 1\n", "did you mean tool.radius");
  refuses("[bed]\ncells = [0, 10]\n", "from 1 to 65536");
  refuses("[bed]\ncells = [1.5, 10]\n", "1.5; give a whole number");
  refuses("[bed]\ncells = [1000, 999]\n", "square");
  refuses("[bed]\ncells = [65536, 65536]\nsurface = { kind = 'noise', amplitude = 1.0 }\n", "memory");
  refuses("[bed.surface]\nradius = 1.0\n",
          "bed.surface.radius applies only where bed.surface.kind is cylinder or cone");
  refuses("[bed]\nsurface = { kind = 'file' }\n", "bed.surface.file");
  refuses("[relaxation]\ntalus_angle = 0\n", "above 0 and below 90");
  refuses("[relaxation]\ntalus_angle = 90.0\n", "above 0 and below 90");
  refuses("[relaxation]\nlaw = 'magic'\n", "paper, isotropic");
  refuses("[relaxation]\nlaw = 'isotropic'\nshare = 0.3\n", "0.25");
  refuses("[relaxation]\ntravel = 2.0\n",
          "scene.toml:2: relaxation.travel was replaced by relaxation.way, in tool radii instead of cells");
  refuses("[relaxation]\nengin = 1\n", "unknown key relaxation.engin; did you mean relaxation.law?");
  refuses("[tool]\nradius = 3.0\n[stroke]\nfile = \"x.toml\"\n", "fit");
  refuses("[tool]\nradius = 1e-4\n[stroke]\nfile = 'x.h5'\n", "0.1 cells wide");
  refuses("[stroke]\nscale = 2\n", "stroke.file");
  refuses("[device]\nservo_rate = 0\n", "device.servo_rate");
  refuses("[force]\nk_s = inf\n", "finite");
}

}  // namespace
}  // namespace sandstroke
