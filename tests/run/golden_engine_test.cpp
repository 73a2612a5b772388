// Every relaxation of every scene in strokes/ by the engine, with every instruction set of the machine, and
// on 1, 2, 3 and 8 threads; every third of them against the plain reference, bit for bit (every pair of the
// two on random beds is in sand/engine_equality_test). The reference works on a window around what was
// disturbed: what sand does depends on its neighbourhood only, so this says as much as the whole field as
// long as nothing near the window's border moves, which is checked.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <hwy/targets.h>
#include <algorithm>
#include <bit>
#include <cstring>
#include <deque>
#include <filesystem>

#include "core/error.h"
#include "haptics/stroke_placement.h"
#include "io/scene_toml.h"
#include "io/stroke_file.h"
#include "io/surface_file.h"
#include "sand/active_sand.h"
#include "sanitized.h"
#include "sim/simulation.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

const fs::path strokes = fs::path(SANDSTROKE_SOURCE) / "strokes";

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(strokes))
    if (fs::exists(entry.path() / "scene.toml")) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

/// The engine with one instruction set and number of threads, on a bed of its own that follows another one.
class Variant {
 public:
  Variant(const RelaxationSettings& settings, const HeightField& bed, std::int64_t target, int threads)
      : bed_(bed), relaxer_(make_relaxer(settings, bed.cell_size())), target_(target), arena_(threads) {}

  /// Sets what was set in `bed` since the last relaxation, and relaxes.
  std::int64_t follow(const HeightField& bed) {
    for (const int slot : bed.disturbed_tiles()) {
      const CellRange tile = bed.tile_cells(bed.tile_of(slot));
      for (int row = 0; row < tile.rows(); ++row)
        for (std::uint64_t cells = bed.disturbed_cells(slot)[row]; cells; cells &= cells - 1) {
          const int r = tile.row_begin + row, c = tile.col_begin + std::countr_zero(cells);
          bed_.set(r, c, bed(r, c));
        }
    }
    std::vector<RowCells> walls = bed.tool_walls();
    for (RowCells& row : walls) row.slot = bed_.allocate(bed.tile_of(row.slot));
    bed_.set_tool_walls(walls);
    std::int64_t passes = 0;
    hwy::SetSupportedTargetsForTest(target_);
    arena_.execute([&] { passes = relaxer_->relax(bed_).passes; });
    hwy::SetSupportedTargetsForTest(0);
    return passes;
  }
  /// The same bits in these tiles (slots of `bed`).
  bool equals(const HeightField& bed, const std::vector<int>& slots) const {
    return std::all_of(slots.begin(), slots.end(), [&](int slot) {
      std::array<double, BedGeometry::tile_area> own{}, other{};
      bed_.read_tile(bed.tile_of(slot), own.data());
      bed.read_tile(bed.tile_of(slot), other.data());
      return std::memcmp(own.data(), other.data(), sizeof own) == 0;
    });
  }
  std::string name() const { return hwy::TargetName(target_); }

 private:
  HeightField bed_;
  std::unique_ptr<Relaxer> relaxer_;
  std::int64_t target_;
  tbb::task_arena arena_;
};

/// Relaxes with the engine, its variants follow, and the window around the disturbed cells with the
/// reference.
class CheckedRelaxer : public Relaxer {
 public:
  CheckedRelaxer(const RelaxationSettings& settings, double cell_size)
      : settings_(settings), engine_(make_relaxer(settings, cell_size)) {}

  RelaxationOutcome relax(HeightField& bed, const PassWatcher& after_pass) override {
    if (sanitized && relaxations == 3) throw Enough{};
    CellRange window = first_ ? bed.cells() : disturbed(bed);
    first_ = false;
    const HeightField before = window_of(bed, window), whole_before = bed;
    std::int64_t variant_passes = -1;
    for (Variant& variant : variants(bed)) {
      const std::int64_t passes = variant.follow(bed);
      if (variant_passes < 0) variant_passes = passes;
      EXPECT_EQ(passes, variant_passes) << variant.name();
    }
    const RelaxationOutcome outcome = engine_->relax(bed, after_pass);
    EXPECT_EQ(variant_passes, outcome.passes);
    std::vector<int> changed;  // tiles
    revisions_.resize(bed.allocated_tiles(), 0);
    for (int slot = 0; slot < bed.allocated_tiles(); ++slot)
      if (std::exchange(revisions_[slot], bed.tile_revision(bed.tile_of(slot))) !=
          bed.tile_revision(bed.tile_of(slot)))
        changed.push_back(slot);
    for (const Variant& variant : variants_)
      EXPECT_TRUE(variant.equals(bed, changed)) << variant.name() << ", relaxation " << relaxations;
    const bool compares = relaxations++ % 3 == 0;
    // A window's border is a wall, at which the law of faces takes other slopes: sand/engine_equality_test
    // has it on whole beds.
    if (settings_.law == RelaxationLaw::faces) return outcome;
    for (const int slot : changed) EXPECT_TRUE(same_outside(window, bed, whole_before, slot));
    if (!compares) return outcome;
    HeightField after = before;
    const RelaxationOutcome plain = make_plain_relaxer(settings_, bed.cell_size())->relax(after);
    EXPECT_EQ(outcome.passes, plain.passes);
    const HeightGrid expected = after.grid(), start = before.grid();
    EXPECT_TRUE((window_of(bed, window).grid() == expected).all()) << "relaxation " << relaxations;
    for (int row = 0; row < window.rows(); ++row)
      for (int col = 0; col < window.cols(); ++col) {
        if (expected(row, col) == start(row, col)) continue;
        const bool inside = (row >= 3 || window.row_begin == 0) && (col >= 3 || window.col_begin == 0) &&
                            (row < window.rows() - 3 || window.row_end == bed.rows()) &&
                            (col < window.cols() - 3 || window.col_end == bed.cols());
        EXPECT_TRUE(inside) << "the window is too small";
      }
    return outcome;
  }

  std::int64_t relaxations = 0;
  struct Enough {};

 private:
  /// No cell of a tile outside the window has changed.
  static bool same_outside(const CellRange& window, const HeightField& bed, const HeightField& before,
                           int slot) {
    const CellRange tile = bed.tile_cells(bed.tile_of(slot));
    for (int row = tile.row_begin; row < tile.row_end; ++row)
      for (int col = tile.col_begin; col < tile.col_end; ++col) {
        const bool inside = row >= window.row_begin && row < window.row_end && col >= window.col_begin &&
                            col < window.col_end;
        if (!inside && bed(row, col) != before(row, col)) return false;
      }
    return true;
  }

  static CellRange disturbed(const HeightField& bed) {
    CellRange range{bed.rows(), 0, bed.cols(), 0};
    for (const int slot : bed.disturbed_tiles()) {
      const CellRange tile = bed.tile_cells(bed.tile_of(slot));
      for (int row = 0; row < tile.rows(); ++row)
        for (int col = 0; col < tile.cols(); ++col) {
          if (!(bed.disturbed_cells(slot)[row] >> col & 1)) continue;
          range.row_begin = std::min(range.row_begin, tile.row_begin + row);
          range.row_end = std::max(range.row_end, tile.row_begin + row + 1);
          range.col_begin = std::min(range.col_begin, tile.col_begin + col);
          range.col_end = std::max(range.col_end, tile.col_begin + col + 1);
        }
    }
    if (range.empty()) return {0, 1, 0, 1};
    constexpr int margin = 24;  // cells
    return {std::max(range.row_begin - margin, 0), std::min(range.row_end + margin, bed.rows()),
            std::max(range.col_begin - margin, 0), std::min(range.col_end + margin, bed.cols())};
  }

  static HeightField window_of(const HeightField& bed, const CellRange& window) {
    HeightGrid heights(window.rows(), window.cols());
    for (int row = 0; row < window.rows(); ++row)
      for (int col = 0; col < window.cols(); ++col)
        heights(row, col) = bed(window.row_begin + row, window.col_begin + col);
    HeightField field(heights, bed.cell_size());
    std::vector<RowCells> walls;
    for (int row = 0; row < window.rows(); ++row)
      for (int col = 0; col < window.cols(); ++col)
        if (bed.is_wall(window.row_begin + row, window.col_begin + col))
          walls.push_back(
              {field.slot_of(field.tile_index(row / BedGeometry::tile_side, col / BedGeometry::tile_side)),
               row % BedGeometry::tile_side, std::uint64_t{1} << col % BedGeometry::tile_side});
    field.set_tool_walls(walls);
    return field;
  }

  std::deque<Variant>& variants(const HeightField& bed) {
    if (variants_.empty()) {
      const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
      for (const int threads : {1, 2, 3, 8}) variants_.emplace_back(settings_, bed, targets.front(), threads);
      for (std::size_t i = 1; i < targets.size(); ++i) variants_.emplace_back(settings_, bed, targets[i], 2);
    }
    return variants_;
  }

  tbb::global_control threads_{tbb::global_control::max_allowed_parallelism, 8};
  RelaxationSettings settings_;
  std::unique_ptr<Relaxer> engine_;
  std::deque<Variant> variants_;
  std::vector<std::uint64_t> revisions_;  // per slot, when the variants were last compared
  bool first_ = true;
};

class GoldenScene : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, GoldenScene, testing::ValuesIn(scene_names()), [](const auto& scene) {
  std::string name = scene.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST_P(GoldenScene, EngineEqualsItsVariantsAndTheReference) {
  const fs::path folder = strokes / GetParam();
  Scene scene = load_scene(folder / "scene.toml", {});
  if (scene.bed.surface.kind == SurfaceKind::file) GTEST_SKIP() << "continues from another scene's run file";
  if (!scene.ground.empty() || !scene.sources.empty() || scene.moisture)
    GTEST_SKIP() << "sand moves further than a window; sand/engine_equality_test has random grounds";
  if (scene.tool.shape != ToolShape::sphere)
    GTEST_SKIP() << "what a large tool lets go flows farther than the windows that are compared here";
  scene.relaxation.method = RelaxationMethod::passes;
  scene.relaxation.way_at_rim = 0.0;  // as often as in shallow sand is enough for bits
  std::optional<Stroke> stroke;
  if (scene.stroke) {
    const fs::path path = folder / scene.stroke->file;
    stroke = place_on_bed(load_stroke(path, scene.force, scene.stroke->table.value_or(TableSettings{})),
                          scene, path.string());
  }
  auto relaxer = std::make_unique<CheckedRelaxer>(scene.relaxation, scene.bed.cell_size());
  const CheckedRelaxer& checked = *relaxer;
  Simulation simulation(scene, load_surface(scene.bed, folder), std::move(stroke), std::move(relaxer));
  try {
    const RunResult result = simulation.run();
    EXPECT_EQ(result.relaxations, checked.relaxations);
    EXPECT_GT(result.moved_volume, 0.0);
  } catch (CheckedRelaxer::Enough) {
    GTEST_SKIP() << "the first relaxations only";
  }
}

}  // namespace
}  // namespace sandstroke
