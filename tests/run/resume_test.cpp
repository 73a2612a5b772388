#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "io/run_file.h"
#include "io/run_writer.h"
#include "measure/force_agreement.h"
#include "measure/furrow.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

template <class T>
T one_of(std::mt19937& random, std::initializer_list<T> values) {
  return values.begin()[random() % values.size()];
}

/// A scene with any of what a tick may depend on.
Scene random_scene(std::mt19937& random) {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.2;
  scene.bed.cols = scene.bed.rows = 80;
  scene.stroke.emplace();
  scene.preset = one_of(random, {ModelPreset::paper, ModelPreset::accurate});
  apply_model_preset(scene);
  scene.force.law = one_of(random, {ForceLaw::paper, ForceLaw::rft, ForceLaw::archimedes});
  scene.bed.surface.kind = one_of(random, {SurfaceKind::flat, SurfaceKind::cylinder});
  scene.bed.surface.radius = 0.03;
  scene.bed.surface.height = 0.01;
  scene.output.frames = one_of(random, {0.0, 40.0, 300.0});
  scene.output.trace = random() % 8 != 0;
  if (scene.preset == ModelPreset::accurate && random() % 2 == 0) {
    scene.tool.shape = ToolShape::plate;
    scene.tool.width = 0.04;
    scene.tool.thickness = 0.012;
    scene.tool.solid = random() % 2 == 0;
  }
  if (random() % 2 == 0) {
    scene.device.model = DeviceModel::dynamic;
    scene.device.delay = one_of(random, {0, 1, 3});
    scene.device.dropped_ticks = one_of(random, {0.0, 0.1});
    scene.device.velocity = one_of(random, {ReadVelocity::exact, ReadVelocity::encoders});
    scene.device.drag = one_of(random, {DragVelocity::sampled, DragVelocity::implicit});
  }
  return scene;
}

/// In and out of the sand, lifted for a while, perhaps with gaps, on the sand, turning, with recorded forces.
Stroke random_stroke(std::mt19937& random) {
  Stroke stroke;
  const bool turns = random() % 2 == 0, recorded = random() % 3 == 0, lifts = random() % 2 == 0;
  stroke.follows_sand = random() % 4 == 0;
  for (int k = 0; k < 300; ++k) {
    const double t = 1.3e-3 * k + (lifts && k > 200 ? 0.4 : 0.0);
    stroke.time.push_back(t);
    stroke.position.push_back(
        {0.04 * std::cos(3.0 * t), 0.04 * std::sin(5.0 * t), -0.003 + 0.003 * std::sin(29.0 * t)});
    if (turns)
      stroke.orientation.push_back(
          Eigen::Quaterniond(Eigen::AngleAxisd(2.0 * t, Eigen::Vector3d::UnitZ())).coeffs());
    if (recorded) stroke.force.push_back({0.1 * std::sin(t), 0.0, 0.3});
    if (lifts) stroke.contact.push_back(k > 100 && k < 130 ? pen_up : k == 100 ? pen_lifts : pen_down);
  }
  return stroke;
}

/// A run with all that is told of it.
struct WrittenRun {
  WrittenRun(const Scene& scene, const Stroke& stroke, const fs::path& path, Hdf5Writer::Begins begins)
      : start(starting_bed(scene.bed)),
        simulation(scene, start, stroke),
        writer(path, simulation, {}, "hash", "", begins),
        path_of_tip(scene) {}
  void to_end(const Checkpoints& checkpoints) {
    result = simulation.run({&path_of_tip, &writer, &forces}, checkpoints);
    result.furrow = path_of_tip.furrow(start, simulation.bed());
    result.recorded_force = force_agreement(forces.values);
    writer.end(result, simulation.bed());
    writer.finish();
  }
  HeightField start;
  Simulation simulation;
  RunWriter writer;
  TipPathGatherer path_of_tip;
  Kept<ForcePair> forces{forces_of};
  RunResult result;
};

template <class Field>
bool same_bits(const Field& one, const Field& other) {
  return std::memcmp(&one, &other, sizeof one) == 0;
}

void expect_same_file(const RunFile& run, const RunFile& whole) {
  const auto same_rows = [](const auto& rows, const auto& others, const auto& visit_fields) {
    ASSERT_EQ(rows.size(), others.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      visit_fields([&](const FieldText& field, const auto& of) {
        ASSERT_TRUE(same_bits(of(rows[i]), of(others[i]))) << field.name << " in row " << i;
      });
  };
  if (whole.has_trace())
    same_rows(run.trace(), whole.trace(), [](const auto& visit) { visit_tick_fields(visit); });
  same_rows(run.relaxations(), whole.relaxations(),
            [](const auto& visit) { visit_relaxation_fields(visit); });
  ASSERT_EQ(run.frame_times(), whole.frame_times());
  RunFrames frames(run), others(whole);
  for (std::size_t k = 0; k < whole.frame_times().size(); ++k)
    ASSERT_TRUE(
        (frames.surface(static_cast<int>(k)).grid() == others.surface(static_cast<int>(k)).grid()).all())
        << "frame " << k;
  EXPECT_EQ(frames.tiles_read(), others.tiles_read());
  EXPECT_TRUE((run.final() == whole.final()).all());
  EXPECT_EQ(run.provenance(), whole.provenance());
}

std::string bytes_of(RunResult result) {
  StateKeeper keeper;
  result.visit_state(keeper);
  result.device.visit_state(keeper);
  return std::move(keeper).kept();
}

/// A run is killed after a state was kept, and more of it was written. From the state it goes on to the same
/// file and summary, whatever the scene.
TEST(Resume, ARunGoesOnWithTheSameBits) {
  struct Killed {};
  std::mt19937 random(46);
  const TestFolder folder;
  for (int scenes = 0; scenes < 16; ++scenes) {
    const Scene scene = random_scene(random);
    const Stroke stroke = random_stroke(random);
    SCOPED_TRACE(scenes);
    WrittenRun whole(scene, stroke, folder / "whole.h5", Hdf5Writer::Begins::anew);
    std::int64_t ticks = 0;
    whole.to_end({"", [&] { return ++ticks, false; }, {}});

    const std::int64_t at = 1 + static_cast<std::int64_t>(random()) % (ticks - 1),
                       killed_at = std::min(at + 30, ticks);
    std::string state;
    {
      WrittenRun killed(scene, stroke, folder / "run.h5", Hdf5Writer::Begins::anew);
      ticks = 0;
      EXPECT_THROW(killed.to_end({"", [&] { return ++ticks == at || ticks == killed_at; },
                                  [&](std::string kept) {
                                    if (!state.empty()) throw Killed();
                                    state = std::move(kept);
                                  }}),
                   Killed);
    }
    {  // and is killed again, before its first flush
      WrittenRun killed(scene, stroke, folder / "run.h5", Hdf5Writer::Begins::from_part);
      ticks = at;
      EXPECT_THROW(
          killed.to_end({state, [&] { return ++ticks == killed_at; }, [](const auto&) { throw Killed(); }}),
          Killed);
    }
    WrittenRun on(scene, stroke, folder / "run.h5", Hdf5Writer::Begins::from_part);
    on.to_end({state});
    expect_same_file(RunFile(folder / "run.h5"), RunFile(folder / "whole.h5"));
    EXPECT_TRUE(bytes_of(on.result) == bytes_of(whole.result));
    EXPECT_EQ(on.result.ticks, whole.result.ticks);
    EXPECT_EQ(on.result.volume_final, whole.result.volume_final);
    if (whole.result.furrow) {
      EXPECT_TRUE(same_bits(*on.result.furrow, *whole.result.furrow));
    }
    EXPECT_EQ(on.result.recorded_force.has_value(), whole.result.recorded_force.has_value());
    if (whole.result.recorded_force && on.result.recorded_force) {
      EXPECT_EQ(on.result.recorded_force->rms, whole.result.recorded_force->rms);
    }
  }
}

}  // namespace
}  // namespace sandstroke
