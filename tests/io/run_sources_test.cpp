// Sources of sand: their keys make a run, whose file tells what they did.
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "core/error.h"
#include "io/run_file.h"
#include "io/run_writer.h"
#include "io/scene_toml.h"
#include "io/source_path.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

const std::string bed_of_sources = "[bed]\nsize = [0.2, 0.2]\ncells = [50, 50]\n",
                  poured = "[[source]]\nat = [0.0, 0.0, 0.1]\nrate = 0.02\nstop = 0.4\n",
                  taken = "[[source]]\nat = [0.0, 0.0, 0.004]\nrate = -0.01\nradius = 0.006\nstop = 0.6\n";

TEST(RunSources, AreInTheRunFileAlsoOfARunThatWentOn) {
  const TestFolder folder;
  const auto path = folder.path() / "run.h5";
  const Scene scene = scene_from_text(bed_of_sources + poured + taken, "scene.toml");
  std::string state;
  RunResult whole;
  std::optional<HeightGrid> end;
  {
    Simulation simulation(scene, starting_bed(scene.bed), std::nullopt);
    RunWriter writer(path, simulation, ViewSettings{}, "");
    int ticks = 0;
    Checkpoints keeps;
    keeps.due = [&] { return ++ticks == 300; };
    keeps.keep = [&](std::string kept) { state = std::move(kept); };
    whole = simulation.run({&writer}, keeps);
    writer.end(whole, simulation.bed());  // it was stopped as it estimated its error
    end = simulation.bed().grid();
  }
  ASSERT_FALSE(state.empty());
  Simulation simulation(scene, starting_bed(scene.bed), std::nullopt);
  RunWriter writer(path, simulation, ViewSettings{}, "", "", Hdf5Writer::Begins::from_part);
  Checkpoints from;
  from.from = state;
  writer.end(simulation.run({&writer}, from), simulation.bed());
  writer.finish();

  const RunFile file(path);
  EXPECT_TRUE((file.final() == *end).all());
  const std::vector<SourceLedger> sources = file.sources();
  ASSERT_EQ(sources.size(), 2u);
  EXPECT_NEAR(sources[0].poured, 0.02 * 0.4, 1e-17);
  EXPECT_EQ(sources[0].landed, whole.sources[0].landed);
  EXPECT_EQ(sources[0].in_air, 0.0);
  EXPECT_NEAR(sources[1].asked, 0.01 * 0.6, 1e-17);
  EXPECT_EQ(sources[1].taken, whole.sources[1].taken);
  EXPECT_GT(sources[1].taken, 0.0);
  EXPECT_LT(sources[1].taken, sources[1].asked);
  EXPECT_EQ(file.scene().sources[1].radius, 0.006);
}

TEST(RunSources, OfAKeyThatIsMissingOrOfNoUseOneSentenceSays) {
  const auto error_in = [](const std::string& text) -> std::string {
    try {
      scene_from_text(bed_of_sources + text, "scene.toml");
    } catch (const Error& failure) {
      return failure.what();
    }
    return "no error";
  };
  EXPECT_NE(error_in("[[source]]\nrate = 1.0\n").find("source.1.at is missing"), std::string::npos);
  EXPECT_NE(error_in(poured + "[[source]]\nat = [0, 0, 0]\n").find("source.2.rate is missing"),
            std::string::npos);
  EXPECT_NE(error_in("[[source]]\nat = [0, 0, 0]\nrate = 1.0\n").find("source.1.stop is missing"),
            std::string::npos);
  EXPECT_EQ(error_in("[[source]]\npath = 'x.toml'\nrate = 1.0\n[force]\ndensity = 1500.0\n"), "no error");
  EXPECT_EQ(
      error_in("[force]\ndensity = 1500.0\n"),
      "scene.toml:5: force.density applies only where force.law is rft or archimedes; remove it, or change "
      "that setting");
}

TEST(RunSources, FollowAStrokeFileWithHeights) {
  const TestFolder folder;
  put_text(
      folder.path() / "path.toml",
      "start = [-0.05, 0.0]\nspeed = 0.1\n[[segment]]\nkind = \"line\"\nto = [0.05, 0.0]\ndepth = -0.02\n");
  put_text(
      folder.path() / "force.toml",
      "start = [-0.05, 0.0]\nspeed = 0.1\n[[segment]]\nkind = \"line\"\nto = [0.05, 0.0]\nforce = 1.0\n");
  SourceSettings source;
  source.path = "path.toml";
  const std::vector<SourceSettings> loaded = with_paths({source}, folder.path());
  ASSERT_TRUE(loaded[0].stroke);
  EXPECT_NEAR(loaded[0].stroke->duration(), 1.0, 0.02);
  EXPECT_NEAR(loaded[0].stroke->position.back().z(), 0.02, 1e-12);
  source.path = "force.toml";
  EXPECT_THROW(with_paths({source}, folder.path()), Error);
  source.path = "none.toml";
  EXPECT_THROW(with_paths({source}, folder.path()), Error);
}

}  // namespace
}  // namespace sandstroke
