#include "io/scene_toml.h"
#include "io/scene_keys.h"

#include <gtest/gtest.h>

#include <sstream>

#include "core/error.h"

namespace sandstroke {
namespace {

Scene read(const std::string& text, const std::vector<std::string>& overrides = {}) {
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
  EXPECT_EQ(scene.relaxation.law, RelaxationLaw::isotropic);
  EXPECT_EQ(scene.displacement.deposit, Deposit::ring);
  EXPECT_EQ(scene.relaxation.talus_angle, 25.0);
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
  const Scene scene = read(
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

TEST(SceneToml, EveryKeyOfTheTableIsAKeyOfScenesAndItsValueTheDefault) {
  std::istringstream lines(scene_key_table());
  int keys = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  ")) continue;
    std::istringstream words(line);
    std::string key;
    words >> key;
    std::string value = line.substr(line.find(key) + key.size());
    value = value.substr(value.find_first_not_of(' '));
    value = value.starts_with("[") ? value.substr(0, value.find(']') + 1) : value.substr(0, value.find(' '));
    if (key == "stroke.file" || key == "bed.surface.file") value = "\"x.h5\"";  // these must be given
    std::vector<std::string> overrides = {key + "=" + value};
    for (const char* of_dynamic : {"device.delay", "device.dropped_ticks", "device.drag"})
      if (key == of_dynamic) overrides.push_back("device.model=dynamic");
    if (key == "displacement.distance") overrides.push_back("displacement.deposit=outward");
    if (key == "relaxation.step_tolerance") overrides.push_back("relaxation.method=rkl");
    if (key.starts_with("stroke.")) overrides.push_back("stroke.file=\"x.h5\"");
    if (key.starts_with("bed.surface.") && key != "bed.surface.kind") {
      bool accepted = false;  // by the kinds of surface that have it
      for (const char* kind : {"cylinder", "noise", "ripples", "file"}) {
        try {
          read("", {"bed.surface.kind=" + std::string(kind),
                    key == "bed.surface.file" ? overrides[0] : "bed.surface.kind=" + std::string(kind),
                    overrides[0],
                    kind == std::string("file") ? "bed.surface.file=\"x.h5\""
                                                : "bed.surface.kind=" + std::string(kind)});
          accepted = true;
        } catch (const Error&) {
        }
      }
      EXPECT_TRUE(accepted) << key;
    } else {
      EXPECT_NO_THROW(read("", overrides)) << key << " = " << value;
    }
    ++keys;
  }
  EXPECT_GT(keys, 50);
}

TEST(SceneToml, TheEngineThatOldRunFilesNameIsReadAndNotWritten) {
  const std::string text = scene_text(read("[relaxation]\nengine = 'tiles'\nrate = 30.0\n"));
  EXPECT_EQ(text, scene_text(read("[relaxation]\nrate = 30.0\n")));
  EXPECT_EQ(text.find("engine"), std::string::npos);
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
  refuses("[bed]\ncells = [1.5, 10]\n", "integers");
  refuses("[bed]\ncells = [1000, 999]\n", "square");
  refuses("[bed]\ncells = [65536, 65536]\nsurface = { kind = 'noise', amplitude = 1.0 }\n", "memory");
  refuses("[bed.surface]\nradius = 1.0\n", "unknown key bed.surface.radius");  // flat has none
  refuses("[bed]\nsurface = { kind = 'file' }\n", "bed.surface.file");
  refuses("[relaxation]\ntalus_angle = 0\n", "above 0 and below 90");
  refuses("[relaxation]\ntalus_angle = 90.0\n", "above 0 and below 90");
  refuses("[relaxation]\nlaw = 'magic'\n", "paper, isotropic");
  refuses("[relaxation]\nlaw = 'isotropic'\nshare = 0.3\n", "0.25");
  refuses("[relaxation]\nengine = 'reference'\n",
          "scene.toml:2: relaxation.engine is 'reference'; leave it out");
  refuses("[tool]\nradius = 3.0\n[stroke]\nfile = \"x.toml\"\n", "fit");
  refuses("[tool]\nradius = 1e-4\n[stroke]\nfile = 'x.h5'\n", "half a cell");
  refuses("[stroke]\nscale = 2\n", "stroke.file");
  refuses("[device]\nservo_rate = 0\n", "device.servo_rate");
  refuses("[force]\nk_s = inf\n", "finite");
}

}  // namespace
}  // namespace sandstroke
