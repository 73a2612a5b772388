#include "sweep/run_sweep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/file_lock.h"
#include "core/input_file.h"
#include "core/output_file.h"
#include "hdf5/hdf5_reader.h"
#include "io/map_files.h"
#include "io/png_file.h"
#include "kept_log.h"
#include "run/run_scene.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

class ASweep : public testing::Test {
 protected:
  ASweep() {
    put_text(temporary / "scene.toml",
             "[bed]\nsize = [0.2, 0.2]\ncells = [80, 80]\n[stroke]\nfile = \"line.toml\"\n"
             "[view]\nsize = [64, 48]\n");
    put_text(temporary / "line.toml",
             "start = [-0.05, 0]\nspeed = 0.2\n[[segment]]\nkind = \"line\"\nto = [0.05, 0]\n"
             "depth = 0.005\n");
  }

  Sweep sweep(
      const std::string& sweep_keys = "",
      const std::string& axes = "relaxation.talus_angle = [25, 35]\nforce.k_s = [500, 1000, 2000]\n") {
    put_text(temporary / "plan.toml", "[sweep]\nscene = \"scene.toml\"\n" + sweep_keys + "[axes]\n" + axes);
    return Sweep(load_plan(temporary / "plan.toml"));
  }
  SweepFolder folder(const Sweep& sweep, const std::string& name) {
    return SweepFolder::make(temporary / name, sweep.manifest());
  }

  TestFolder temporary;
};

SweepOptions with_jobs(int jobs, Shard shard = {}) {
  SweepOptions options;
  options.jobs = jobs;
  options.shard = shard;
  return options;
}

HeightGrid surface_in(const SweepFolder& folder, std::size_t point) {
  return Hdf5Reader(folder.surface_file(point)).grid("/surface");
}

/// Same verdicts, metrics (but for times) and surfaces, to the bit.
void expect_equal(const SweepFolder& a, const SweepFolder& b) {
  ASSERT_EQ(a.points(), b.points());
  for (std::size_t point = 0; point < a.points(); ++point) {
    const auto one = a.read(point), other = b.read(point);
    ASSERT_TRUE(one && other) << point;
    EXPECT_EQ(one->verdict, other->verdict);
    EXPECT_EQ(one->reason, other->reason);
    for (std::size_t i = 0; i < a.metrics().size(); ++i) {
      if (a.metrics()[i].timing) continue;
      const double p = one->metrics[i], q = other->metrics[i];
      EXPECT_TRUE(p == q || (std::isnan(p) && std::isnan(q))) << point << " " << a.metrics()[i].name;
    }
    if (a.manifest().keep_surface) {
      EXPECT_TRUE((surface_in(a, point) == surface_in(b, point)).all());
    }
  }
}

TEST_F(ASweep, PointsOfEqualSandShareASimulationAndTheirInputs) {
  Sweep s = sweep();
  const SweepCounters counters = s.run(folder(s, "out"), {});
  EXPECT_EQ(counters.points, 6u);
  EXPECT_EQ(counters.run, 6u);
  EXPECT_EQ(counters.simulations, 2u);
  EXPECT_EQ(counters.strokes_loaded, 1);
  EXPECT_EQ(counters.beds_loaded, 1);
  EXPECT_EQ(counters.failed(), 0u);
}

TEST_F(ASweep, SharesOnlyInputsWithADynamicDevice) {
  Sweep s = sweep("", "device.model = [\"dynamic\"]\nforce.k_s = [500, 1000]\n");
  const SweepCounters counters = s.run(folder(s, "out"), {});
  EXPECT_EQ(counters.simulations, 2u);
  EXPECT_EQ(counters.beds_loaded, 1);
}

TEST_F(ASweep, AScriptThatPressesByForceIsAnotherStrokeForOtherConstants) {
  put_text(temporary / "line.toml",
           "start = [-0.05, 0]\n[[segment]]\nkind = \"line\"\nto = [0.05, 0]\nforce = 2.0\n");
  Sweep s = sweep();
  const SweepCounters counters = s.run(folder(s, "out"), {});
  EXPECT_EQ(counters.simulations, 6u);
  EXPECT_EQ(counters.strokes_loaded, 3);
}

TEST_F(ASweep, GivesTheSameForAnyNumberOfJobsAndShards) {
  Sweep s = sweep("keep = [\"surface\"]\n");
  const SweepFolder one = folder(s, "one"), many = folder(s, "many"), shards = folder(s, "shards");
  s.run(one, with_jobs(1));
  s.run(many, with_jobs(3));
  expect_equal(one, many);
  std::size_t run = 0;
  for (int i = 1; i <= 3; ++i) {
    const SweepCounters counters = s.run(shards, with_jobs(1, {i, 3}));
    run += counters.run;
    EXPECT_LE(counters.simulations, 1u);  // two groups: one shard has none
  }
  EXPECT_EQ(run, 6u);
  expect_equal(one, shards);
}

TEST_F(ASweep, ARerunDoesOnlyWhatIsMissingOrWasCutOff) {
  Sweep s = sweep("keep = [\"surface\"]\n");
  const SweepFolder whole = folder(s, "whole"), broken = folder(s, "broken");
  s.run(whole, {});
  s.run(broken, {});
  fs::remove(broken.point_file(1));
  fs::resize_file(broken.point_file(5), 2000);
  put_text(broken.path() / "points/000004.h5.part", hdf5_signature);  // of a run that was killed
  const SweepCounters counters = s.run(broken, {});
  EXPECT_EQ(counters.done_before, 4u);
  EXPECT_EQ(counters.run, 2u);
  EXPECT_EQ(counters.simulations, 2u);
  expect_equal(whole, broken);
  EXPECT_EQ(s.run(broken, {}).simulations, 0u);
}

TEST_F(ASweep, AFailingPointIsRecordedAndDoesNotStopTheRest) {
  // Each value can be, but scaled by 30 the stroke leaves the bed.
  Sweep s = sweep("", "device.scale = [1, 30]\nforce.k_s = [500, 1000]\n");
  const SweepFolder out = folder(s, "out");
  const SweepCounters counters = s.run(out, {});
  EXPECT_EQ(counters.run, 4u);
  EXPECT_EQ(counters.failed(), 2u);
  EXPECT_EQ(out.read(0)->verdict, PointVerdict::at_rest);
  EXPECT_EQ(out.read(3)->verdict, PointVerdict::refused);
  EXPECT_NE(out.read(3)->reason.find("outside the bed"), std::string::npos);
  EXPECT_EQ(s.run(out, {}).failed(), 2u);  // counted, not run, again
}

TEST_F(ASweep, SettingsThatDoNotGoTogetherAreRefusedPoints) {
  Sweep s = sweep("", "bed.cells = [[160, 160], [80, 80]]\ntool.radius = [0.01, 0.003, 0.0015]\n");
  const SweepFolder out = folder(s, "out");
  const SweepCounters counters = s.run(out, {});
  EXPECT_EQ(counters.failed(), 1u);  // less than two cells wide, in the coarse bed only
  EXPECT_EQ(counters.simulations, 5u);
  EXPECT_EQ(s.simulations(), 5u);
  EXPECT_EQ(out.read(5)->verdict, PointVerdict::refused);
  EXPECT_EQ(out.read(2)->verdict, PointVerdict::at_rest);
}

TEST_F(ASweep, ABedThatCannotBeReadRefusesItsOwnPointsOnly) {
  put_text(temporary / "bed.png", "no picture");
  Sweep s = sweep("",
                  "bed.surface.file = [\"bed.png\"]\nforce.k_s = [500, 1000]\n"
                  "bed.surface.kind = [\"file\"]\n");
  const SweepFolder out = folder(s, "out");
  EXPECT_EQ(s.run(out, {}).failed(), 2u);
  EXPECT_EQ(out.read(1)->verdict, PointVerdict::refused);
  EXPECT_NE(out.read(1)->reason.find("bed.png"), std::string::npos) << out.read(1)->reason;
}

TEST_F(ASweep, KeepsPicturesAndSurfacesWhereAskedTo) {
  Sweep s = sweep("keep = [\"picture\", \"surface\"]\n", "force.k_s = [500, 1000]\n");
  const SweepFolder out = folder(s, "out");
  s.run(out, {});
  EXPECT_EQ(read_png(out.picture_file(1)).width, 64);
  EXPECT_GT(surface_in(out, 1).maxCoeff(), 0.0);
  Sweep bare = sweep("", "force.k_s = [500, 1000]\n");
  const SweepFolder without = folder(bare, "bare");
  bare.run(without, {});
  EXPECT_FALSE(fs::exists(without.picture_file(0)));
}

TEST_F(ASweep, AnotherProcessAtTheSamePartIsRefusedAndAtAnotherPartIsNot) {
  Sweep s = sweep();
  const SweepFolder out = folder(s, "out");
  const auto other = FileLock::try_take(out.path() / "points/.shard-1-of-1");
  ASSERT_TRUE(other);
  EXPECT_THROW(s.run(out, {}), Error);
  EXPECT_EQ(s.run(out, with_jobs(1, {2, 2})).run, 3u);
}

TEST_F(ASweep, AGoldenSurfaceOfAnotherShapeIsRefusedOrComparedWithThoseItFits) {
  Sweep first = sweep("", "force.k_s = [1000]\n");
  const SceneFile scene = first.plan().scene_of(0);
  RunOptions options;
  options.scene_folder = temporary.path();
  run_scene(scene, temporary / "golden.h5", options);
  EXPECT_THROW(sweep("golden = \"golden.h5\"\n", "bed.cells = [[160, 160]]\n"), Error);
  Sweep s = sweep("golden = \"golden.h5\"\nmetrics = [\"golden_max\", \"work\"]\n",
                  "bed.cells = [[160, 160], [80, 80]]\n");
  const SweepFolder out = folder(s, "out");
  EXPECT_EQ(s.run(out, {}).failed(), 0u);
  EXPECT_TRUE(std::isnan(out.read(0)->metrics[0]));
  EXPECT_FALSE(std::isnan(out.read(0)->metrics[1]));
  EXPECT_EQ(out.read(1)->metrics[0], 0.0);
}

TEST_F(ASweep, EachBedIsLoadedOnceWhateverTheOrder) {
  Sweep s = sweep(
      "", "force.k_s = [1, 2]\nrelaxation.talus_angle = [20, 30, 40]\nbed.cells = [[80, 80], [160, 160]]\n");
  EXPECT_EQ(s.run(folder(s, "out"), {}).beds_loaded, 2);
}

TEST_F(ASweep, AMapOfTheSandIsReadOnceForEachBedsCells) {
  const int cells = 77;  // of none of the beds
  put_text(temporary / "talus.npy",
           npy_bytes<double>(HeightGrid::NullaryExpr(cells, cells,
                                                     [](auto row, auto col) {
                                                       return 15.0 +
                                                              static_cast<double>((5 * row + 3 * col) % 20);
                                                     }),
                             "<f8"));
  const auto swept = [&](const std::string& name, const std::string& beds, int jobs) {
    Sweep s = sweep("keep = [\"surface\"]\n",
                    "sand.map.file = [\"talus.npy\"]\nforce.k_s = [500, 1000]\n"
                    "bed.surface.height = [0.08]\nbed.surface.radius = [0.08]\n"
                    "bed.surface.kind = [\"cone\"]\nbed.cells = " +
                        beds);
    const SweepFolder out = folder(s, name);
    EXPECT_EQ(s.run(out, with_jobs(jobs)).failed(), 0u);
    return out;
  };
  const KeptLog log;
  const SweepFolder both = swept("both", "[[80, 80], [60, 60]]\n", 2);
  int read = 0;
  for (std::size_t at = log.text().find("talus angles"); at != std::string::npos;
       at = log.text().find("talus angles", at + 1))
    ++read;
  EXPECT_EQ(read, 2);
  const SweepFolder one = swept("one", "[[80, 80]]\n", 1), other = swept("other", "[[60, 60]]\n", 1);
  EXPECT_TRUE((surface_in(both, 0) == surface_in(one, 0)).all());
  EXPECT_TRUE((surface_in(both, 1) == surface_in(other, 0)).all());
  EXPECT_GT(surface_in(both, 0).maxCoeff(), 0.01);
  const SweepManifest before = sweep("", "sand.map.file = [\"talus.npy\"]\n").manifest();
  put_text(temporary / "talus.npy", "another file");
  EXPECT_NE(sweep("", "sand.map.file = [\"talus.npy\"]\n").manifest().inputs, before.inputs);
}

TEST_F(ASweep, WhatCannotBeWrittenEndsIt) {
  Sweep s = sweep();
  const SweepFolder out = folder(s, "out");
  fs::remove_all(out.path() / "points");
  EXPECT_THROW(s.run(out, with_jobs(2)), Error);
}

TEST_F(ASweep, AnEstimateLeavesNothingAndCountsAllPoints) {
  Sweep s = sweep("keep = [\"surface\"]\n");
  const Sweep::Estimate estimate = s.estimate();
  EXPECT_GT(estimate.seconds, 0.0);
  const SweepFolder out = folder(s, "out");
  s.run(out, {});
  double bytes = 0.0;
  for (const auto& file : fs::directory_iterator(out.path() / "points"))
    bytes += static_cast<double>(file.file_size());
  EXPECT_NEAR(estimate.bytes / bytes, 1.0, 0.1);
}

TEST_F(ASweep, ItsManifestTellsItsInputsApart) {
  const SweepManifest before = sweep().manifest();
  EXPECT_EQ(sweep().manifest().inputs, before.inputs);
  put_text(temporary / "line.toml", read_text_file(temporary / "line.toml") + "wait = 0.1\n");
  EXPECT_NE(sweep().manifest().inputs, before.inputs);
}

TEST_F(ASweep, ItsManifestIsTheSameHoweverItsFilesAreNamed) {
  fs::create_directories(temporary / "m");
  fs::create_directory_symlink(temporary / "m", temporary / "z");
  for (const char* name : {"scene.toml", "line.toml"}) fs::copy(temporary / name, temporary / "m" / name);
  const std::string elsewhere = (temporary / "n.toml").string();
  put_text(elsewhere, read_text_file(temporary / "line.toml") + "wait = 0.1\n");
  put_text(temporary / "m/plan.toml",
           "[sweep]\nscene = \"scene.toml\"\n[axes]\nstroke.file = [\"line.toml\", \"" + elsewhere + "\"]\n");
  const SweepManifest one = Sweep(load_plan(temporary / "m/plan.toml")).manifest();
  SweepFolder::make(temporary / "out", one);
  EXPECT_NO_THROW(
      SweepFolder::make(temporary / "out", Sweep(load_plan(temporary / "z/plan.toml")).manifest()));
}

TEST_F(ASweep, MayLieInAFolderWhoseNameIsNoUtf8) {
  const fs::path odd = temporary.path() / "\xff";
  fs::create_directories(odd);
  for (const char* name : {"scene.toml", "line.toml"}) fs::copy(temporary / name, odd / name);
  put_text(odd / "plan.toml", "[sweep]\nscene = \"scene.toml\"\n[axes]\nforce.k_s = [500]\n");
  Sweep s(load_plan(odd / "plan.toml"));
  const SweepFolder out = SweepFolder::make(odd / "out", s.manifest());
  EXPECT_EQ(s.run(out, {}).run, 1u);
  EXPECT_EQ(s.run(SweepFolder::make(odd / "out", s.manifest()), {}).done_before, 1u);
}

TEST_F(ASweep, AnEstimateMeasuresAPointThatCanBeRun) {
  // The one in the middle has a tool that is less than two cells wide.
  Sweep s = sweep("keep = [\"surface\"]\n",
                  "tool.radius = [0.01, 0.0015, 0.003]\nbed.cells = [[160, 160], [80, 80]]\n");
  ASSERT_EQ(s.refused().size(), 1u);
  EXPECT_EQ(s.refused().begin()->first, 3u);
  EXPECT_GT(s.estimate().bytes, 6 * 80 * 80 * sizeof(double));
}

/// A box of 20 x 20 x 40 mm in millimetres, its tip at the origin.
std::string box_stl() {
  const auto corner = [](int i) {
    return fmt::format("vertex {} {} {}\n", i & 1 ? 10 : -10, i & 2 ? 10 : -10, i & 4 ? 40 : 0);
  };
  std::string text = "solid box\n";
  for (const std::array<int, 4>& face :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    for (const int side : {1, 2})
      text += "facet normal 0 0 0\nouter loop\n" + corner(face[0]) +
              corner(face[static_cast<std::size_t>(side)]) +
              corner(face[static_cast<std::size_t>(side) + 1]) + "endloop\nendfacet\n";
  return text + "endsolid box\n";
}

TEST_F(ASweep, AToolFromAFileIsSweptAsTheSameShapeByFormula) {
  put_text(temporary / "box.stl", box_stl());
  const auto swept = [&](const std::string& name, const std::string& tool) {
    put_text(temporary / "plan.toml",
             "[sweep]\nscene = \"scene.toml\"\nkeep = [\"surface\"]\n[set]\ndisplacement.deposit = "
             "\"outward\"\nforce.law = \"rft\"\n" +
                 tool + "[axes]\nforce.friction_angle = [25, 35]\n");
    Sweep sweep(load_plan(temporary / "plan.toml"));
    SweepFolder into = folder(sweep, name);
    sweep.run(into, with_jobs(1));
    return into;
  };
  const SweepFolder file =
      swept("file", "tool.shape = \"mesh\"\ntool.file = \"box.stl\"\ntool.scale = 0.001\n");
  const SweepFolder formula = swept("formula", "tool.shape = \"box\"\ntool.size = [0.02, 0.02, 0.04]\n");
  for (std::size_t point = 0; point < 2; ++point) {
    ASSERT_EQ(file.read(point)->verdict, formula.read(point)->verdict) << file.read(point)->reason;
    EXPECT_LT((surface_in(file, point) - surface_in(formula, point)).abs().maxCoeff(), 1e-9);
    EXPECT_LT(surface_in(file, point).minCoeff(), -0.001);
  }
}

}  // namespace
}  // namespace sandstroke
