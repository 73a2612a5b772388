#include "io/run_file.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <thread>

#include "core/error.h"
#include "core/hash.h"
#include "core/input_file.h"
#include "core/output_file.h"
#include "io/input_kind.h"
#include "io/scene_toml.h"
#include "io/stroke_file.h"
#include "io/surface_file.h"
#include "run/run_scene.h"
#include "sim/simulation.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

class RunFileTest : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_ / "line.toml") << "start = [-0.05, 0.0]\nspeed = 0.2\n[[segment]]\nkind = 'line'\n"
                                            "to = [0.05, 0.0]\ndepth = 0.004\n";
  }

  SceneFile scene(const std::vector<std::string>& overrides = {}) {
    return scene_from_text("[bed]\nsize = [0.3, 0.2]\ncells = [150, 100]\n[stroke]\nfile = 'line.toml'\n",
                           "scene.toml", overrides);
  }
  RunResult run(const SceneFile& scene, const std::string& name, int threads = 1) {
    RunOptions options;
    options.scene_folder = folder_.path();
    options.threads = threads;
    return run_scene(scene, folder_ / name, options);
  }
  TestFolder folder_;
};

TEST_F(RunFileTest, HoldsWhatTheDesignPromises) {
  const RunResult result = run(scene({"output.frames=5", "view.azimuth=30"}), "a.h5");
  const RunFile file(folder_ / "a.h5");
  EXPECT_TRUE(file.complete());
  EXPECT_EQ(file.cell_size(), 0.002);
  EXPECT_EQ(file.initial().rows(), 100);
  EXPECT_EQ(file.initial().cols(), 150);
  EXPECT_TRUE((file.initial() == 0.0).all());
  EXPECT_LT(file.final().minCoeff(), -0.001);
  const std::vector<TickRecord> trace = file.trace();
  ASSERT_EQ(static_cast<std::int64_t>(trace.size()), result.ticks);
  double max_force = 0.0;
  for (const TickRecord& tick : trace) max_force = std::max(max_force, tick.device_force.norm());
  EXPECT_EQ(max_force, result.device.max_force);
  EXPECT_EQ(std::count_if(trace.begin(), trace.end(), [](const TickRecord& tick) { return tick.contact; }),
            result.contact_ticks);
  EXPECT_EQ(scene_text(scene_from_text(file.scene_text(), "stored")),
            scene_text(scene({"output.frames=5", "view.azimuth=30"})));

  const std::vector<double> times = file.frame_times();
  ASSERT_GT(times.size(), 3u);
  EXPECT_EQ(times[0], 0.0);
  EXPECT_DOUBLE_EQ(times[2], 0.4);
  RunFrames frames(file);
  EXPECT_TRUE((frames.surface(0).grid() == file.initial()).all());
  EXPECT_FALSE((frames.surface(static_cast<int>(times.size()) - 1).grid() == file.initial()).all());
  EXPECT_NEAR(frames.surface(2).grid().sum(), 0.0, 1e-12);

  const Hdf5Reader plain(folder_ / "a.h5");
  for (const std::string& column : plain.members("/trace"))
    EXPECT_TRUE(column == "contact" || column == "saturated" || column == "axis" ||
                plain.has_attribute("/trace/" + column, "units"))
        << column;
  EXPECT_EQ(plain.text_attribute("/trace/device_force", "units"), "N");

  EXPECT_FALSE(fs::exists(part_path(folder_ / "a.h5")));
  EXPECT_NE(read_text_file(folder_ / "a.xdmf").find("a.h5:/surface/final"), std::string::npos);
}

TEST_F(RunFileTest, SameInputSameBitsForAnyNumberOfThreads) {
  run(scene(), "one.h5", 1);
  run(scene(), "two.h5", 2);
  run(scene(), "eight.h5", 8);
  const RunFile one(folder_ / "one.h5");
  for (const char* name : {"two.h5", "eight.h5"}) {
    const RunFile other(folder_ / name);
    EXPECT_TRUE((one.final() == other.final()).all()) << name;
    const std::vector<TickRecord> a = one.trace(), b = other.trace();
    ASSERT_EQ(a.size(), b.size()) << name;
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(a[i].device_force, b[i].device_force) << name;
      ASSERT_EQ(a[i].displaced_volume, b[i].displaced_volume) << name;
    }
  }
}

TEST_F(RunFileTest, FramesHoldTilesThatCameIntoBeingBetweenThem) {
  struct Frames : SimulationObserver {
    std::vector<HeightGrid> grids;
    std::vector<int> tiles;
    void on_frame(double, const HeightField& surface) override {
      grids.push_back(surface.grid());
      tiles.push_back(surface.allocated_tiles());
    }
  } frames;
  // Ripples that rest by rule: a tile may come into being and stay as it was.
  const SceneFile rippled =
      scene({"output.frames=20", "bed.surface={ kind = 'ripples', amplitude = 0.001 }"});
  run(rippled, "a.h5");
  Simulation(
      rippled, load_surface(rippled.bed, folder_.path()),
      place_stroke(load_stroke(folder_ / "line.toml", rippled.force), rippled.stroke->placement, "line.toml"))
      .run({&frames});
  EXPECT_EQ(frames.tiles.front(), 0);
  EXPECT_LT(frames.tiles[1], frames.tiles.back());
  const RunFile file(folder_ / "a.h5");
  ASSERT_EQ(file.frame_times().size(), frames.grids.size());
  const int count = static_cast<int>(frames.grids.size());
  RunFrames in_sequence(file), backwards(file);
  for (int k = 0; k < count; ++k) {
    EXPECT_TRUE((in_sequence.surface(k).grid() == frames.grids[k]).all()) << k;
    EXPECT_TRUE((in_sequence.surface(k).grid() == frames.grids[k]).all()) << k << " again";
    EXPECT_TRUE((backwards.surface(count - 1 - k).grid() == frames.grids[count - 1 - k]).all()) << k;
  }
  std::int64_t tiles_held = 0;
  const Hdf5Reader plain(folder_ / "a.h5");
  for (const std::string& name : plain.members("/surface/frame"))
    plain.visit_written("/surface/frame/" + name + "/changed",
                        [&](auto, auto, const auto&) { ++tiles_held; });
  EXPECT_EQ(in_sequence.tiles_read(), tiles_held) << "each change is read once";
}

TEST_F(RunFileTest, ReadsTheFirstFormatButForItsFrames) {
  const fs::path path = folder_ / "old.h5";
  {
    Hdf5Writer file(path, output_kind(InputKind::run));
    file.attribute("/", "format_version", 1.0);
    file.attribute("/", "written_by", "sandstroke 0.0.9");
    file.attribute("/", "complete", 1.0);
    file.write("/provenance/threads", std::string("2"));
    file.write("/surface/initial", HeightGrid::Zero(2, 3));
    file.attribute("/surface", "cell_size", 0.002);
    file.write("/surface/frame/000000/tiles", std::vector<std::uint32_t>{0});
    file.finish();
  }
  const RunFile run(path);
  EXPECT_TRUE(run.complete());
  EXPECT_EQ(run.initial().cols(), 3);
  EXPECT_EQ(run.provenance(), (std::vector<std::pair<std::string, std::string>>{{"threads", "2"}}));
  try {
    run.frame_times();
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_NE(std::string(error.what()).find("was written by sandstroke 0.0.9, whose frames"),
              std::string::npos);
  }
}

TEST_F(RunFileTest, HoldsTheEstimatedErrorAndItsMap) {
  for (const SecondSolution second : {SecondSolution::coarser, SecondSolution::finer}) {
    RunOptions options;
    options.scene_folder = folder_.path();
    options.second = second;
    options.error_map = true;
    const RunResult result = run_scene(scene(), folder_ / "e.h5", options);
    ASSERT_TRUE(result.error);
    const RunFile file(folder_ / "e.h5");
    const std::optional<ErrorEstimate> read = file.error_estimate();
    ASSERT_TRUE(read);
    visit_error_fields([&](const FieldText& field, const auto& of) {
      EXPECT_EQ(of(*read), of(*result.error)) << field.name;
    });
    const HeightGrid map = file.error_map()->grid();
    EXPECT_EQ(map.maxCoeff(), read->height_max);
    const auto changed = static_cast<double>((file.final() != file.initial()).count());
    EXPECT_NEAR(std::sqrt(map.square().sum() / changed), read->height_rms, 1e-12);
  }
  run(scene(), "plain.h5");
  EXPECT_FALSE(RunFile(folder_ / "plain.h5").error_estimate());
  EXPECT_FALSE(RunFile(folder_ / "plain.h5").error_map());
}

TEST_F(RunFileTest, ASurfaceCanComeFromARunFile) {
  run(scene(), "first.h5");
  SceneFile second = scene({"bed.surface={ kind = 'file', file = 'first.h5' }"});
  run(second, "second.h5");
  EXPECT_TRUE((RunFile(folder_ / "second.h5").initial() == RunFile(folder_ / "first.h5").final()).all());
  // On other cells the sand stays where it is: two by two cells have the height of one.
  run(scene({"bed.surface={ kind = 'file', file = 'first.h5' }", "bed.cells=[300, 200]"}), "third.h5");
  const RunFile fine(folder_ / "third.h5"), own(folder_ / "first.h5");
  EXPECT_NEAR(fine.initial_bed().volume(), own.final_bed().volume(), 1e-18);
  const HeightGrid on_fine = fine.initial(), on_own = own.final();
  for (int row = 0; row < 200; ++row)
    for (int col = 0; col < 300; ++col)
      ASSERT_EQ(on_fine(row, col), on_own(row / 2, col / 2)) << row << ", " << col;
}

TEST_F(RunFileTest, RefusesOtherFiles) {
  Hdf5Writer writer(folder_ / "other.h5");
  writer.write("/data", std::vector<double>{1.0});
  writer.finish();
  EXPECT_THROW(RunFile(folder_ / "other.h5"), Error);
  EXPECT_THROW(RunFile(folder_ / "line.toml"), Error);
}

TEST_F(RunFileTest, SaysOfWhatItIsAndWithHowManyThreads) {
  RunOptions options;
  options.scene_folder = folder_.path();
  options.scene_file = folder_ / "scenes" / "dune.toml";
  options.threads = 2;
  fs::create_directory(folder_ / "runs");
  const auto provenance = [&](const SceneFile& scene) {
    run_scene(scene, folder_ / "runs" / "a.h5", options);
    std::map<std::string, std::string> entries;
    for (const auto& [name, value] : RunFile(folder_ / "runs" / "a.h5").provenance()) entries[name] = value;
    return entries;
  };
  std::map<std::string, std::string> entries = provenance(scene());
  EXPECT_EQ(entries["threads"], std::to_string(std::min(2u, std::thread::hardware_concurrency())));
  EXPECT_EQ(entries["scene_file"], "../scenes/dune.toml") << "as seen from the run's folder";
  EXPECT_EQ(entries["scene_hash"], content_hash(scene_text(scene())));
  EXPECT_EQ(entries["stroke_hash"], content_hash(read_text_file(folder_ / "line.toml")));

  // A recorded stroke's is of its content, not of the file, which tells more.
  const Stroke stroke = load_stroke(folder_ / "line.toml", {});
  write_stroke_file(folder_ / "line.h5", stroke);
  EXPECT_EQ(provenance(scene({"stroke.file=line.h5"}))["stroke_hash"], content_hash(stroke));
  EXPECT_EQ(provenance(scene({"stroke.file=line.h5", "stroke.offset=[0.01, 0, 0]"}))["stroke_hash"],
            content_hash(stroke));
}

TEST_F(RunFileTest, RecordedForcesAreComparedWithThoseOfTheRun) {
  const SceneFile at_hand = scene({"relaxation.rate=0"});
  ASSERT_FALSE(run(at_hand, "a.h5").recorded_force);
  const std::vector<TickRecord> trace = RunFile(folder_ / "a.h5").trace();
  Stroke felt;  // in every tick what the run felt in it, in one of them 0.25 N more
  for (const TickRecord& tick : trace) {
    felt.time.push_back(tick.time);
    felt.position.push_back(tick.hand.position);
    felt.force.push_back(tick.device_force);
  }
  write_stroke_file(folder_ / "felt.h5", felt);
  const std::optional<ForceAgreement> same =
      run(scene({"relaxation.rate=0", "stroke.file=felt.h5"}), "b.h5").recorded_force;
  ASSERT_TRUE(same);
  EXPECT_EQ(same->ticks, static_cast<std::int64_t>(trace.size()));
  EXPECT_LT(same->rms, 0.02);  // drag is of a curve through the samples
  EXPECT_GT(same->correlation, 0.999);
  EXPECT_EQ(same->lag, 0.0);
  EXPECT_TRUE(std::isnan(trace.front().recorded_force.x()));  // in a file that has none
  EXPECT_FALSE(RunFile(folder_ / "a.h5").trace_content().recorded_force);
  EXPECT_TRUE(RunFile(folder_ / "b.h5").trace_content().recorded_force);
  run(scene({"device.model=dynamic", "device.dropped_ticks=0.25"}), "c.h5");
  EXPECT_TRUE(RunFile(folder_ / "c.h5").trace_content().dropped_ticks);
  const std::vector<TickRecord> late = RunFile(folder_ / "c.h5").trace();
  EXPECT_TRUE(std::any_of(late.begin(), late.end(), [](const TickRecord& tick) { return tick.dropped; }));
  const std::vector<TickRecord> kept = RunFile(folder_ / "b.h5").trace();
  ASSERT_EQ(kept.size(), trace.size());
  for (std::size_t i = 0; i < kept.size(); ++i) EXPECT_EQ(kept[i].recorded_force, trace[i].device_force);
  felt.force[trace.size() / 2].z() += 10.0;
  write_stroke_file(folder_ / "more.h5", felt);
  const std::optional<ForceAgreement> more =
      run(scene({"relaxation.rate=0", "stroke.file=more.h5"}), "b.h5").recorded_force;
  EXPECT_NEAR(more->max, 10.0, 0.1);
  EXPECT_LT(more->correlation, same->correlation);
  EXPECT_NEAR(more->rms, 10.0 / std::sqrt(static_cast<double>(trace.size())), 0.02);
}

TEST_F(RunFileTest, TheDepthThatWasAskedIsKeptWhereTheStrokeFollowsTheSand) {
  Stroke stroke;  // a slope of 10 mm in 0.4 s, then a sample in the air
  stroke.time = {0.0, 0.4, 0.45};
  stroke.position = {{-0.04, 0.0, 0.002}, {0.04, 0.0, -0.008}, {0.04, 0.0, -0.008}};
  stroke.contact = {pen_down, pen_down, pen_up};
  stroke.gap_threshold = 1.0;
  write_stroke_file(folder_ / "slope.h5", stroke);
  const std::vector<std::string> settings = {"relaxation.rate=0", "stroke.file=slope.h5"};
  run(scene(settings), "bed.h5");
  EXPECT_FALSE(RunFile(folder_ / "bed.h5").trace_content().asked_depth);
  run(scene({settings[0], settings[1], "stroke.follow=sand"}), "sand.h5");
  const RunFile file(folder_ / "sand.h5");
  EXPECT_TRUE(file.trace_content().asked_depth);
  for (const TickRecord& tick : file.trace())
    if (tick.time < 0.3995) {
      EXPECT_NEAR(tick.asked_depth, 0.025 * tick.time - 0.002, 1e-9) << tick.time;
    } else if (tick.time > 0.4005) {
      EXPECT_TRUE(std::isnan(tick.asked_depth)) << tick.time;
    }
}

TEST_F(RunFileTest, TheFurrowIsBetweenTheFirstSurfaceAndTheLast) {
  const RunResult result = run(scene({"model.preset=accurate"}), "a.h5");
  ASSERT_TRUE(result.furrow);
  EXPECT_NEAR(result.furrow->asked_depth, 0.004, 1e-5);
  EXPECT_GT(result.furrow->depth, 0.002);
  EXPECT_LT(result.furrow->depth, 0.004);
  const RunFile file(folder_ / "a.h5");
  // Across the middle of the line the lowest cell is that deep, to the change of a slope within a cell.
  const double lowest = -file.final().col(75).minCoeff();
  EXPECT_NEAR(result.furrow->depth, lowest, 0.5 * 0.002 * std::tan(std::numbers::pi / 6));
  const Hdf5Reader plain(folder_ / "a.h5");
  EXPECT_EQ(plain.number_attribute("/surface/final", "furrow_depth"), result.furrow->depth);
  EXPECT_EQ(plain.number_attribute("/surface/final", "asked_depth"), result.furrow->asked_depth);
}

}  // namespace
}  // namespace sandstroke
