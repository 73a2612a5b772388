#include "io/run_writer.h"

#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include <array>
#include <filesystem>
#include <map>
#include <numeric>

#include "core/hash.h"
#include "core/input_file.h"
#include "core/output_file.h"
#include "hdf5/hdf5_handle.h"
#include "io/run_file.h"
#include "io/scene_toml.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// 100 x 150 cells of 2 mm: 2 x 3 tiles.
const std::string narrow_bed = "[bed]\nsize = [0.3, 0.2]\ncells = [150, 100]\n";
Scene narrow_scene() { return scene_from_text(narrow_bed + "[stroke]\nfile = 'line.toml'\n", "scene.toml"); }
Scene scene_without_stroke() { return scene_from_text(narrow_bed, "scene.toml"); }

/// No two numbers of any two ticks are the same.
TickRecord made_tick(int k) {
  double number = 32.0 * k;
  const auto next = [&] { return number += 0.5; };
  const auto vector = [&] {
    const double x = next(), y = next();
    return Eigen::Vector3d(x, y, next());
  };
  TickRecord tick;
  tick.time = next();
  tick.hand.position = vector();
  tick.hand.velocity = vector();
  tick.next.position = vector();
  tick.device_position = vector();
  tick.device_force = vector();
  tick.repulse_force = vector();
  tick.drag_force = vector();
  tick.level = next();
  tick.depth = next();
  tick.displaced_volume = next();
  tick.passivity_margin = next();
  tick.contact = k % 2 == 1;
  tick.saturated = k % 3 == 1;
  return tick;
}

RelaxationRecord made_relaxation(int k) {
  const double number = 64.0 * k;
  return {number + 0.25,
          {.passes = 64 * k + 1,
           .super_steps = 64 * k + 2,
           .rejected_stages = 64 * k + 3,
           .residual = number + 4.25,
           .moved_volume = number + 5.25,
           .cells_visited = 64 * k + 6,
           .tiles_active_max = 64 * k + 7,
           .wake_ups = 64 * k + 8}};
}

class RunWriterTest : public testing::Test {
 protected:
  void begin(const Scene& scene, const std::string& stroke_hash = "abc", const std::string& scene_file = "") {
    simulation_.emplace(scene, starting_bed(scene.bed), std::nullopt);
    writer_.emplace(path_, *simulation_, ViewSettings{}, stroke_hash, scene_file);
  }
  Hdf5Reader finished(const RunResult& result = {}) {
    writer_->end(result, simulation_->bed());
    writer_->finish();
    writer_.reset();
    return Hdf5Reader(path_);
  }

  TestFolder folder_;
  const fs::path path_ = folder_ / "run.h5";
  std::optional<Simulation> simulation_;
  std::optional<RunWriter> writer_;
};

TEST_F(RunWriterTest, EachColumnOfTheTraceHoldsItsOwnField) {
  begin(narrow_scene());
  constexpr int count = 51'001;  // more than are kept in memory
  for (int k = 0; k < count; ++k) writer_->on_tick(made_tick(k));
  const Hdf5Reader file = finished();

  using Vector = Eigen::Vector3d;
  using Tick = const TickRecord&;
  const std::map<std::string, std::pair<std::string, std::function<double(Tick)>>> numbers = {
      {"time", {"s", [](Tick t) { return t.time; }}},
      {"level", {"m", [](Tick t) { return t.level; }}},
      {"depth", {"m", [](Tick t) { return t.depth; }}},
      {"displaced_volume", {"m^3", [](Tick t) { return t.displaced_volume; }}},
      {"passivity_margin", {"N s/m", [](Tick t) { return t.passivity_margin; }}}};
  const std::map<std::string, std::pair<std::string, std::function<Vector(Tick)>>> vectors = {
      {"hand_position", {"m", [](Tick t) { return t.hand.position; }}},
      {"device_position", {"m", [](Tick t) { return t.device_position; }}},
      {"device_force", {"N", [](Tick t) { return t.device_force; }}},
      {"repulse_force", {"N", [](Tick t) { return t.repulse_force; }}},
      {"drag_force", {"N", [](Tick t) { return t.drag_force; }}}};
  const std::map<std::string, std::function<bool(Tick)>> facts = {
      {"contact", [](Tick t) { return t.contact; }}, {"saturated", [](Tick t) { return t.saturated; }}};
  EXPECT_EQ(file.members("/trace").size(), 1 + numbers.size() + vectors.size() + facts.size()) << "and axis";

  for (const auto& [name, column] : numbers) {
    const std::vector<double> values = file.doubles("/trace/" + name);
    ASSERT_EQ(values.size(), count) << name;
    for (int k = 0; k < count; ++k) ASSERT_EQ(values[k], column.second(made_tick(k))) << name << ' ' << k;
    EXPECT_EQ(file.text_attribute("/trace/" + name, "units"), column.first) << name;
  }
  for (const auto& [name, column] : vectors) {
    const std::vector<Vector> values = file.vectors("/trace/" + name);
    ASSERT_EQ(values.size(), count) << name;
    for (int k = 0; k < count; ++k) ASSERT_EQ(values[k], column.second(made_tick(k))) << name << ' ' << k;
    EXPECT_EQ(file.text_attribute("/trace/" + name, "units"), column.first) << name;
  }
  for (const auto& [name, fact] : facts) {
    const std::vector<std::uint32_t> values = file.integers("/trace/" + name);
    ASSERT_EQ(values.size(), count) << name;
    for (int k = 0; k < count; ++k) ASSERT_EQ(values[k], fact(made_tick(k)) ? 1u : 0u) << name << ' ' << k;
    EXPECT_FALSE(file.has_attribute("/trace/" + name, "units")) << name;
  }
}

TEST_F(RunWriterTest, WhatIsReadBackIsEachFieldThatWasWritten) {
  begin(narrow_scene());
  for (int k = 0; k < 7; ++k) writer_->on_tick(made_tick(k));
  finished();
  const std::vector<TickRecord> ticks = RunFile(path_).trace();
  ASSERT_EQ(ticks.size(), 7u);
  for (int k = 0; k < 7; ++k) {
    const TickRecord &read = ticks[k], made = made_tick(k);
    EXPECT_EQ(read.time, made.time);
    EXPECT_EQ(read.hand.position, made.hand.position);
    EXPECT_EQ(read.device_position, made.device_position);
    EXPECT_EQ(read.device_force, made.device_force);
    EXPECT_EQ(read.repulse_force, made.repulse_force);
    EXPECT_EQ(read.drag_force, made.drag_force);
    EXPECT_EQ(read.level, made.level);
    EXPECT_EQ(read.depth, made.depth);
    EXPECT_EQ(read.displaced_volume, made.displaced_volume);
    EXPECT_EQ(read.passivity_margin, made.passivity_margin);
    EXPECT_EQ(read.contact, made.contact);
    EXPECT_EQ(read.saturated, made.saturated);
  }
}

TEST_F(RunWriterTest, EachColumnOfTheRelaxationsHoldsItsOwnField) {
  begin(scene_without_stroke());
  for (int k = 0; k < 1500; ++k) writer_->on_relaxation(made_relaxation(k));
  writer_->on_tick(made_tick(0));
  const Hdf5Reader file = finished();
  EXPECT_FALSE(file.has("/trace")) << "no stroke, no ticks";
  using Record = const RelaxationRecord&;
  const std::map<std::string, std::pair<std::string, std::function<double(Record)>>> columns = {
      {"time", {"s", [](Record r) { return r.time; }}},
      {"passes", {"1", [](Record r) { return static_cast<double>(r.outcome.passes); }}},
      {"residual", {"1", [](Record r) { return r.outcome.residual; }}},
      {"moved_volume", {"m^3", [](Record r) { return r.outcome.moved_volume; }}}};
  EXPECT_EQ(file.members("/relaxation").size(), columns.size());
  for (const auto& [name, column] : columns) {
    const std::vector<double> values = file.doubles("/relaxation/" + name);
    ASSERT_EQ(values.size(), 1500u) << name;
    for (int k = 0; k < 1500; ++k) ASSERT_EQ(values[k], column.second(made_relaxation(k))) << name;
    EXPECT_EQ(file.text_attribute("/relaxation/" + name, "units"), column.first) << name;
  }
}

TEST_F(RunWriterTest, KeepsTheRelaxationsWithoutATrace) {
  Scene scene = narrow_scene();
  scene.output.trace = false;
  begin(scene);
  writer_->on_tick(made_tick(0));
  writer_->on_relaxation(made_relaxation(3));
  const Hdf5Reader file = finished();
  EXPECT_FALSE(file.has("/trace"));
  EXPECT_EQ(file.doubles("/relaxation/passes"), std::vector<double>{193.0});
  EXPECT_FALSE(RunFile(path_).has_trace());
}

TEST_F(RunWriterTest, AFrameHoldsTheTilesThatChangedSinceTheOneBefore) {
  Scene scene = narrow_scene();
  scene.stroke.reset();
  HeightField touched = starting_bed(scene.bed);
  touched.set(99, 0, 0.125);  // before the run begins: tile 3
  simulation_.emplace(scene, touched, std::nullopt);
  writer_.emplace(path_, *simulation_, ViewSettings{}, "");
  HeightField bed = simulation_->bed();
  std::vector<HeightGrid> surfaces;
  const auto keep = [&](double time) {
    writer_->on_frame(time, bed);
    surfaces.push_back(bed.grid());
  };
  keep(0.0);
  bed.set(1, 149, -0.25);  // tile 2, of which 22 columns are on the bed
  bed.set(64, 64, 0.5);    // tile 4
  keep(0.25);
  bed.set(98, 1, 1.0);  // tile 3
  keep(0.375);
  bed.allocate(5);  // as its rule says
  keep(1.5);
  const Hdf5Reader file = finished();

  EXPECT_EQ(file.members("/surface/frame"),
            (std::vector<std::string>{"000000", "000001", "000002", "000003"}));
  using Part = std::array<Eigen::Index, 4>;  // first row and column, rows, columns
  const std::vector<std::vector<Part>> changed = {
      {}, {{0, 128, 64, 22}, {64, 64, 36, 64}}, {{64, 0, 36, 64}}, {}};
  const std::vector<double> times = {0.0, 0.25, 0.375, 1.5};
  EXPECT_EQ(file.doubles("/surface/time"), times);
  for (int k = 0; k < 4; ++k) {
    std::vector<Part> parts;
    file.visit_written(fmt::format("/surface/frame/{:06}/changed", k), [&](Eigen::Index row, Eigen::Index col,
                                                                           const HeightGrid& heights) {
      parts.push_back({row, col, heights.rows(), heights.cols()});
      EXPECT_TRUE((heights == surfaces[k].block(row, col, heights.rows(), heights.cols())).all())
          << "the whole tile, not only what changed in it";
    });
    EXPECT_EQ(parts, changed[k]) << k;
  }

  const auto seen_by_others = [&](const std::string& dataset, const std::vector<hsize_t>& shape) {
    const Hdf5Handle opened(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, without_locks()), H5Fclose);
    const Hdf5Handle heights(H5Dopen2(opened, dataset.c_str(), H5P_DEFAULT), H5Dclose);
    std::vector<double> values(std::accumulate(shape.begin(), shape.end(), hsize_t{1}, std::multiplies<>()));
    EXPECT_EQ(H5Sget_simple_extent_npoints(Hdf5Handle(H5Dget_space(heights), H5Sclose)),
              static_cast<hssize_t>(values.size()));
    EXPECT_GE(H5Dread(heights, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
    return values;
  };
  std::vector<double> all;
  for (int k = 0; k < 4; ++k) {
    const std::vector<double> expected(surfaces[k].data(), surfaces[k].data() + surfaces[k].size());
    EXPECT_EQ(seen_by_others(fmt::format("/surface/frame/{:06}/height", k), {100, 150}), expected) << k;
    all.insert(all.end(), expected.begin(), expected.end());
  }
  EXPECT_EQ(seen_by_others("/surface/frames", {4, 100, 150}), all);

  const RunFile run(path_);
  EXPECT_EQ(run.frame_times(), times);
  RunFrames frames(run);
  for (const int k : {3, 0, 2, 1}) EXPECT_TRUE((frames.surface(k).grid() == surfaces[k]).all()) << k;
}

TEST_F(RunWriterTest, SaysWhatItIsOfAndInWhichUnit) {
  Scene scene = narrow_scene();
  scene.force.k_f = 7.5;
  begin(scene, "0123456789abcdef", "scenes/dune.toml");
  RunResult result;
  result.threads = 3;
  result.furrow.emplace();
  result.furrow->depth = 0.004;
  result.furrow->asked_depth = 0.005;
  result.furrow->width = 0.006;
  result.furrow->rampart = 0.007;
  result.furrow->length = 0.008;
  const Hdf5Reader file = finished(result);
  EXPECT_FALSE(fs::exists(part_path(path_)));

  EXPECT_EQ(file.text_attribute("/", "format"), "sandstroke.run");
  EXPECT_EQ(file.number_attribute("/", "format_version"), 2.0);
  EXPECT_EQ(file.number_attribute("/", "complete"), 1.0);
  EXPECT_EQ(file.number_attribute("/surface", "cell_size"), 0.002);
  EXPECT_EQ(file.text_attribute("/surface/final", "units"), "m");
  EXPECT_EQ(file.shape("/surface/initial"), (std::vector<hsize_t>{100, 150}));
  EXPECT_EQ(file.shape("/surface/final"), (std::vector<hsize_t>{100, 150}));
  EXPECT_EQ(file.number_attribute("/surface/final", "furrow_depth"), 0.004);
  EXPECT_EQ(file.number_attribute("/surface/final", "asked_depth"), 0.005);
  EXPECT_FALSE(file.has("/surface/frame"));

  const std::string scene_in_file = file.text("/scene");
  EXPECT_EQ(scene_from_text(scene_in_file, "stored").force.k_f, 7.5);
  std::map<std::string, std::string> provenance;
  for (const auto& [name, value] : RunFile(path_).provenance()) provenance[name] = value;
  EXPECT_EQ(provenance["scene_hash"], content_hash(scene_in_file));
  EXPECT_EQ(provenance["stroke_hash"], "0123456789abcdef");
  EXPECT_EQ(provenance["scene_file"], "scenes/dune.toml");
  EXPECT_EQ(provenance["threads"], "3");
  for (const char* name : {"version", "commit", "compiler", "instruction_set"})
    EXPECT_FALSE(provenance[name].empty()) << name;
  EXPECT_EQ(provenance.size(), 8u);
}

TEST_F(RunWriterTest, SaysOfEveryDatasetWhatItIs) {
  Scene scene = narrow_scene();
  begin(scene);
  writer_->on_frame(0.0, starting_bed(scene.bed));
  finished();
  const Hdf5Handle file(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, without_locks()), H5Fclose);
  std::vector<std::string> names;
  const auto keep = [](hid_t, const char* name, const auto* info, void* all) -> herr_t {
    if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(all)->emplace_back(name);
    return 0;
  };
  ASSERT_GE(H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_NATIVE, keep, &names, H5O_INFO_BASIC), 0);
  ASSERT_GT(names.size(), 18U);
  const Hdf5Reader reader(path_);
  for (const std::string& name : names) {
    if (name == "scene" || name.ends_with("axis")) continue;  // text
    if (name.starts_with("surface/frame/")) continue;         // parts of /surface/frames, which says it
    ASSERT_TRUE(reader.has_attribute("/" + name, "long_name")) << name;
    EXPECT_FALSE(reader.text_attribute("/" + name, "long_name").empty()) << name;
    const bool is_flag = name.ends_with("contact") || name.ends_with("saturated");
    EXPECT_EQ(reader.has_attribute("/" + name, "units"), !is_flag) << name;
  }
}

TEST_F(RunWriterTest, SaysNothingOfAFurrowAndASceneFileThatAreNotThere) {
  begin(narrow_scene());
  const Hdf5Reader file = finished();
  EXPECT_FALSE(file.has_attribute("/surface/final", "furrow_depth"));
  EXPECT_FALSE(file.has_attribute("/surface/final", "asked_depth"));
  EXPECT_FALSE(file.has_attribute("/provenance", "scene_file"));
}

TEST_F(RunWriterTest, AnInterruptedRunStaysAPartWithoutAFinalSurface) {
  begin(narrow_scene());
  for (int k = 0; k < 5; ++k) writer_->on_tick(made_tick(k));
  RunResult result;
  result.interrupted = true;
  writer_->end(result, simulation_->bed());
  writer_.reset();
  EXPECT_FALSE(fs::exists(path_));
  EXPECT_FALSE(fs::exists(folder_ / "run.xdmf"));
  const RunFile part(part_path(path_));
  EXPECT_FALSE(part.complete());
  EXPECT_FALSE(part.has_final());
  EXPECT_EQ(part.trace().size(), 5u);
}

}  // namespace
}  // namespace sandstroke
