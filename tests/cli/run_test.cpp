#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "io/run_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

TEST(CliRun, WritesARunFileXdmfAndPicture) {
  const fs::path folder = test_folder();
  const ProgramResult run = run_program({"run", "scene.toml", "-o", "a.h5", "--png", "a.png"}, folder);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(RunFile(folder / "a.h5").complete());
  EXPECT_TRUE(fs::exists(folder / "a.xdmf"));
  EXPECT_GT(fs::file_size(folder / "a.png"), 1000u);
  EXPECT_NE(run.out.find("volume drift"), std::string::npos);
}

TEST(CliRun, JsonIsOneObjectWithTheDesignsNames) {
  const fs::path folder = test_folder();
  const ProgramResult run = run_program({"run", "scene.toml", "--json", "--threads", "2"}, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json json = nlohmann::json::parse(run.out);
  for (const char* name : {"wall_seconds", "ticks", "real_time_factor", "passes", "residual",
                           "volume_initial", "volume_final", "volume_drift", "moved_volume", "max_force",
                           "cells_visited", "tiles_active_max", "converged", "threads"})
    EXPECT_TRUE(json.contains(name)) << name;
  EXPECT_TRUE(json["converged"]);
  EXPECT_EQ(json["threads"], 2);
  EXPECT_LE(json["volume_drift"], 1e-12);
  EXPECT_TRUE(fs::exists(folder / "scene.h5"));  // the default name
}

TEST(CliRun, SetOverridesSceneKeys) {
  const fs::path folder = test_folder();
  const ProgramResult run =
      run_program({"run", "scene.toml", "-o", "a.h5", "--set", "relaxation.law=isotropic", "--set",
                   "force.k_s=500", "--frames", "10"},
                  folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const RunFile file(folder / "a.h5");
  EXPECT_NE(file.scene_text().find("law = \"isotropic\""), std::string::npos);
  EXPECT_NE(file.scene_text().find("k_s = 500.0"), std::string::npos);
  EXPECT_GT(file.frame_times().size(), 3u);
}

TEST(CliRun, AnotherStrokeCanBePlayed) {
  const fs::path folder = test_folder();
  write_file(folder / "other.toml",
             "start = [0.0, -0.05]\n[[segment]]\nkind = \"line\"\nto = [0.0, 0.05]\ndepth = 0.002\n");
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5", "--stroke", "other.toml"}, folder).exit_code, 0);
  const RunTrace trace = RunFile(folder / "a.h5").trace();
  for (const auto& position : trace.hand_position) EXPECT_NEAR(position.x(), 0.0, 1e-12);
}

TEST(CliRun, ARunThatIsNotAtRestSaysSoAndExitsWith3) {
  const fs::path folder = test_folder();
  const ProgramResult run =
      run_program({"run", "scene.toml", "-o", "a.h5", "--set", "relaxation.max_passes=1"}, folder);
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("not at rest"), std::string::npos);
  EXPECT_TRUE(RunFile(folder / "a.h5").complete());
}

TEST(CliRun, InterruptedItKeepsWhatIsCompleteAndMarksItSo) {
  const fs::path folder = test_folder();
  write_file(folder / "long.toml",
             "start = [-0.05, 0.0]\nspeed = 0.0001\n[[segment]]\nkind = \"line\"\nto = [0.05, 0.0]\n"
             "depth = 0.004\n");
  const ProgramResult run =
      run_program({"run", "scene.toml", "-o", "a.h5", "--stroke", "long.toml"}, folder, 1500);
  EXPECT_EQ(run.exit_code, 130) << run.err;
  EXPECT_FALSE(fs::exists(folder / "a.h5"));
  const RunFile part(folder / "a.h5.part");
  EXPECT_FALSE(part.complete());
  EXPECT_GT(part.trace().size(), 100u);
  const ProgramResult render = run_program({"render", "a.h5.part", "-o", "a.png"}, folder);
  EXPECT_EQ(render.exit_code, 2);
  EXPECT_NE(render.err.find("cut off"), std::string::npos) << render.err;
}

TEST(CliInfo, ShowsARunAndTheSceneKeys) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5"}, folder).exit_code, 0);
  const nlohmann::json json = nlohmann::json::parse(run_program({"info", "a.h5", "--json"}, folder).out);
  EXPECT_EQ(json["cells"][0], 150);
  EXPECT_TRUE(json["complete"]);
  EXPECT_TRUE(json["provenance"].contains("version"));
  EXPECT_NE(run_program({"info", "--scene-keys"}, folder).out.find("relaxation.talus_angle"),
            std::string::npos);
  const ProgramResult scene = run_program({"info", "a.h5", "--scene"}, folder);
  write_file(folder / "again.toml", scene.out);
  EXPECT_EQ(run_program({"run", "again.toml", "-o", "b.h5"}, folder).exit_code, 0);
  EXPECT_EQ(run_program({"compare", "a.h5", "b.h5"}, folder).exit_code, 0);
}

TEST(CliHelp, EveryCommandExplainsItself) {
  const fs::path folder = test_folder();
  for (const char* command : {"run", "render", "compare", "golden", "stroke", "info"}) {
    const ProgramResult help = run_program({command, "--help"}, folder);
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_GT(help.out.size(), 200u) << command;
  }
  EXPECT_EQ(run_program({"--version"}, folder).exit_code, 0);
}

}  // namespace
}  // namespace sandstroke
