#include "compare/golden_scenes.h"

#include <fstream>

#include "core/error.h"
#include "core/input_file.h"
#include "golden_fixture.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

class GoldenScenes : public Golden {
 protected:
  GoldenScenes() : folders{folder / "strokes", folder / "golden"} {
    for (const char* name : {"dune", "letters"}) {
      fs::create_directories(folders.strokes / name);
      std::ofstream(folders.scene(name)) << "";
    }
  }
  SceneRunner runner() {
    return [this](const fs::path& scene, const fs::path& run_file) {
      ran.push_back(scene.parent_path().filename());
      run.write(run_file);
      return GoldenRun{run_file, picture, {}};
    };
  }
  Comparison check(const std::string& name, const GivenTolerances& options = {}) {
    return check_golden(name, folders, runner(), options,
                        [this](const GoldenEntry& entry, const GoldenRun& one, const Comparison& comparison,
                               const Tolerances&) {
                          EXPECT_TRUE(fs::exists(one.run_file));
                          compared.emplace_back(entry.name, comparison.passed());
                        });
  }

  GoldenFolders folders;
  std::vector<std::string> ran;
  std::vector<std::pair<std::string, bool>> compared;  // the scenes, and whether they passed
};

TEST_F(GoldenScenes, UpdatedSceneChecksAndIsTold) {
  update_golden("dune", folders, runner());
  EXPECT_TRUE(check("dune").passed());
  EXPECT_EQ(ran, (std::vector<std::string>{"dune", "dune"}));
  EXPECT_EQ(compared, (std::vector{std::pair{std::string("dune"), true}}));
}

TEST_F(GoldenScenes, TheEntrysOwnTolerancesCountAndOptionsBeforeThem) {
  update_golden("dune", folders, runner());
  update_golden("letters", folders, runner());
  run.trace[47].device_force.x() += 0.005;
  EXPECT_FALSE(check("dune").passed());
  const fs::path file = folders.entry("dune").folder / "tolerances.toml";
  put_text(file, "force = 0.006   # N\npixel = 3\n");
  const Comparison own = check("dune");
  EXPECT_TRUE(own.passed()) << check_table(own);
  EXPECT_EQ(changed_tolerances(own.tolerances),
            fmt::format("force 0.006 N ({0}), pixel 3 of 255 ({0})", file.string()));
  EXPECT_FALSE(check("letters").passed()) << "which has no such file";
  const Comparison stricter = check("dune", {{"force", 0.004}});
  EXPECT_EQ(stricter.failures(), 1);
  EXPECT_EQ(changed_tolerances(stricter.tolerances),
            fmt::format("force 0.004 N (--force-tolerance), pixel 3 of 255 ({})", file.string()));
  EXPECT_TRUE(check("letters", {{"force", 0.006}}).passed());
  run = SyntheticRun();
  update_golden("dune", folders, runner());
  EXPECT_EQ(read_text_file(file), "force = 0.006   # N\npixel = 3\n") << "an update leaves it";
}

TEST_F(GoldenScenes, ToleranceFilesWithWrongNumbersFailWithoutARun) {
  update_golden("dune", folders, runner());
  ran.clear();
  for (const auto& [text, words] :
       {std::pair("force = 1e-6\n", "tolerances.toml:1: force is 1e-06; give a number 1e-05 or more"),
        {"\nforse = 1\n", "tolerances.toml:2: unknown key forse"},
        {"pixel = 1.5\n", "tolerances.toml:1: pixel is 1.5; give a whole number"},
        {"pixel_share = 2\n", "tolerances.toml:1: pixel_share is 2; give a number from 0 to 1"}}) {
    put_text(folders.entry("dune").folder / "tolerances.toml", text);
    sandstroke::expect_only_failure(check("dune"), "tolerances", words);
  }
  EXPECT_TRUE(ran.empty());
}

TEST_F(GoldenScenes, CommandsThatAreSuggestedNameTheFolders) {
  EXPECT_EQ(GoldenFolders().entry("dune").update, "sandstroke golden update dune");
  EXPECT_EQ((GoldenFolders{"strokes", "my golden"}.entry("dune").update),
            "sandstroke golden update dune --golden 'my golden'");
  EXPECT_EQ((GoldenFolders{"in/scenes", "golden"}.entry("a b").update),
            "sandstroke golden update 'a b' --strokes in/scenes");
  const std::string update = folders.entry("dune").update;
  EXPECT_NE(check("dune").checks[0].sentence.find(update), std::string::npos) << "no entry";
  update_golden("dune", folders, runner());
  run.initial(3, 3) = run.final(3, 3) = 0.01;
  EXPECT_NE(check_table(check("dune")).find(update), std::string::npos) << "another surface";
  fs::remove(folders.entry("dune").folder / "golden.h5");
  EXPECT_NE(check_table(check("dune")).find(update), std::string::npos) << "no golden.h5";
}

TEST_F(GoldenScenes, NamesAreTheUnionOfScenesAndEntries) {
  fs::create_directories(folders.entry("old").folder);
  fs::create_directories(folders.entry("dune.part").folder);  // an update that was killed
  fs::create_directories(folders.strokes / "no-scene");
  EXPECT_EQ(golden_names(folders, {}), (std::vector<std::string>{"dune", "letters", "old"}));
  EXPECT_EQ(golden_names(folders, {"letters"}), (std::vector<std::string>{"letters"}));
  try {
    golden_names(folders, {"dunes"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 2);
    EXPECT_NE(std::string(error.what()).find("dune, letters"), std::string::npos) << error.what();
  }
}

TEST_F(GoldenScenes, NothingAtAllIsNoSuccess) {
  fs::create_directories(folder / "empty");
  EXPECT_THROW(golden_names({folder / "empty", folder / "empty"}, {}), Error);
  EXPECT_THROW(golden_names({folder / "missing", folders.golden}, {}), Error);
}

TEST_F(GoldenScenes, MissingEntryAndMissingSceneFailWithoutARun) {
  EXPECT_EQ(check("letters").failures(), 1);
  EXPECT_EQ(check("letters").checks[0].name, "golden entry");
  fs::create_directories(folders.entry("old").folder);
  EXPECT_EQ(check("old").checks[0].name, "scene");
  EXPECT_FALSE(check("old").passed());
  EXPECT_TRUE(ran.empty());
}

TEST_F(GoldenScenes, AnUpdateRefusesWhatARunEndsWithCode3For) {
  update_golden("dune", folders, runner());
  const auto refusal = [&](const std::function<void(RunResult&)>& spoil) {
    const SceneRunner doubtful = [&](const fs::path& scene, const fs::path& file) {
      GoldenRun made = runner()(scene, file);
      made.result.relaxation.converged = true;
      spoil(made.result);
      return made;
    };
    try {
      update_golden("dune", folders, doubtful);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::unstable);
      return std::string(error.what());
    }
    return std::string("updated");
  };
  EXPECT_NE(refusal([](RunResult& result) { result.relaxation.converged = false; })
                .find("dune/scene.toml: the sand is not at rest (residual 0.00e+00), so the golden entry "
                      "stays as it was; "
                      "raise relaxation.max_passes"),
            std::string::npos);
  EXPECT_NE(
      refusal([](RunResult& result) { result.device.swings_from = 0.5; }).find("from 0.500 s on the device"),
      std::string::npos);
  EXPECT_EQ(refusal([](RunResult&) {}), "updated");
  const SceneRunner unrelaxed = [&](const fs::path& scene, const fs::path& file) {
    GoldenRun made = runner()(scene, file);
    made.result.relaxation.converged = false;
    return made;
  };
  EXPECT_TRUE(update_golden("dune", folders, unrelaxed, true)) << "a scene may show just this";
}

TEST_F(GoldenScenes, ARunThatStopsIsAFailedCheck) {
  update_golden("dune", folders, runner());
  const SceneRunner stops = [](const fs::path&, const fs::path&) -> GoldenRun {
    throw_input_error("scene.toml:3: no");
  };
  const Comparison comparison = check_golden("dune", folders, stops, {});
  EXPECT_EQ(comparison.checks.at(0).sentence, "scene.toml:3: no");
  EXPECT_FALSE(comparison.passed());
  EXPECT_THROW(update_golden("dune", folders, stops), Error);
  EXPECT_TRUE(check("dune").passed()) << "a failed update changes nothing";
}

TEST_F(GoldenScenes, AnInterruptedRunIsNoSuccessAndChangesNothing) {
  update_golden("dune", folders, runner());
  const SceneRunner interrupted = [](const fs::path&, const fs::path&) {
    GoldenRun unfinished;
    unfinished.result.interrupted = true;
    return unfinished;
  };
  EXPECT_FALSE(check_golden("dune", folders, interrupted, {}).passed());
  EXPECT_FALSE(update_golden("dune", folders, interrupted));
  EXPECT_TRUE(check("dune").passed());
}

TEST_F(GoldenScenes, ADamagedEntryFailsEvenWithAReport) {
  update_golden("dune", folders, runner());
  std::ofstream(folders.entry("dune").folder / "golden.h5") << "rubbish";
  EXPECT_EQ(check("dune").failures(), 1);
}

TEST_F(GoldenScenes, UpdateOfAnUnknownSceneIsBadInput) {
  EXPECT_THROW(update_golden("dunes", folders, runner()), Error);
  // One that is there, by a path that leads out of both folders and in again.
  for (const char* name : {"../strokes/dune", "./dune", "dune/", "..", ".", ""})
    EXPECT_THROW(update_golden(name, folders, runner()), Error) << name;
}

}  // namespace
}  // namespace sandstroke
