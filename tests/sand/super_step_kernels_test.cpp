#include "sand/super_step_kernels.h"
#include "sand/all_laws.h"

#include <gtest/gtest.h>

#include <hwy/targets.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "sand/all_laws.h"

namespace sandstroke {
namespace {

TEST(SuperStage, MovesWithMomentumAndCanBeTakenBack) {
  const auto flow = std::make_unique<TileFlow>();
  const auto tile = std::make_unique<SuperStepTile>();
  const auto patch = std::make_unique<TilePatch>();
  for (int row = 0; row < TilePatch::side; ++row) std::fill_n(patch->heights(row), TilePatch::side, 1.0);
  CellFlags active{}, changed{};
  active[5] = 0xff00;
  flow->rows = {5, 6};
  flow->moved[5] = 0x0300;
  flow->gain[5 * TilePatch::side + 8] = 0.5;
  flow->gain[5 * TilePatch::side + 9] = -0.5;

  HeightRange range = super_stage(*flow, active, 0.0, 0.25, *patch, *tile, changed);
  EXPECT_EQ(patch->heights(5)[8], 1.125);
  EXPECT_EQ(patch->heights(5)[9], 0.875);
  EXPECT_EQ(changed[5], 0x0300u);
  EXPECT_EQ(range.low, 0.875);
  EXPECT_EQ(range.high, 1.125);

  flow->rows = {5, 7};
  active[6] = 0xff;  // joins: it has no momentum, whatever was kept of it
  for (int row : {5, 6}) std::fill_n(tile->before->row(row), TilePatch::side, -7.0);
  tile->before->row(5)[8] = tile->before->row(5)[9] = 1.0;
  for (int c = 10; c < 16; ++c) tile->before->row(5)[c] = 1.0;
  range = super_stage(*flow, active, 0.5, 0.0, *patch, *tile, changed);
  EXPECT_EQ(patch->heights(5)[8], 1.1875);
  EXPECT_EQ(patch->heights(5)[9], 0.8125);
  EXPECT_EQ(patch->heights(6)[0], 1.0);
  EXPECT_EQ(changed[5], 0x0300u);
  EXPECT_EQ(changed[6], 0u);
  EXPECT_EQ(range.low, 0.8125);

  take_back_stage(*tile, *patch);
  EXPECT_EQ(patch->heights(5)[8], 1.125);
  EXPECT_EQ(patch->heights(5)[9], 0.875);
  EXPECT_EQ(patch->heights(6)[0], 1.0);
  EXPECT_EQ(patch->heights(7)[0], 1.0);
}

/// A tile of a bed with walls in it, in the midst of a super-step.
struct TileInStep {
  static constexpr int side = TilePatch::side;
  HeightField bed{rough_heights(), 1.0};
  TilePatch patch;
  SuperStepTile kept;
  TileFlow flow;
  FlowScratch scratch;
  CellFlags active{}, changed{};
  RowSpan rows{3, 50};
  HeightRange range{};

  TileInStep() {
    const int slot = bed.slot_of(bed.tile_index(0, 0));
    std::mt19937_64 random(7);
    for (int row = rows.begin; row < rows.end; ++row)
      active[row] = random() & random() & random() & columns_between(0, 60);
    for (FlowScratch::Row& row : scratch.givers) row = {~std::uint64_t{0}, true, true};
    patch.begin(slot);
    patch.load_rows(bed, {0, side});
    patch.load_rim(bed, {-2, side + 2}, true, true, [](int) { return nullptr; });
    kept.first.gain.fill(0.001);
    kept.first.moved.fill(0x5a);
    kept.first.rows = {3, 40};
    for (int row = 0; row < side; ++row)
      for (int c = 0; c < side; ++c) kept.before->row(row)[c] = patch.heights(row)[c] - 0.01 * c;
    kept.stepped.fill(0x3c);
  }
  static HeightGrid rough_heights() {
    std::mt19937 random(3);
    HeightGrid heights(70, 60);  // the tile's last columns lie outside
    for (double& height : heights.reshaped())
      height = std::uniform_real_distribution<double>(0.0, 3.0)(random);
    return heights;
  }
  void compute(const TalusLaw& law, std::optional<StageAhead> ahead) {
    compute_flow(law, patch, active, rows, {&kept.first, ahead}, scratch, flow);
  }
};

TEST(SuperStage, TakenWithTheFlowIsTheSameBits) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    for (const RelaxationLaw law : all_laws) {
      SCOPED_TRACE(hwy::TargetName(target));
      hwy::SetSupportedTargetsForTest(target);
      RelaxationSettings settings;
      settings.law = law;
      const TalusLaw talus = talus_law(settings, 1.0);
      const auto apart = std::make_unique<TileInStep>(), together = std::make_unique<TileInStep>();
      apart->compute(talus, {});
      apart->range =
          super_stage(apart->flow, apart->active, 0.4, 0.2, apart->patch, apart->kept, apart->changed);
      together->compute(talus, StageAhead{0.4, 0.2, together->kept, together->changed, together->range});
      EXPECT_EQ(together->patch.heights(20)[5],
                TileInStep().patch.heights(20)[5]);  // until they are exchanged
      together->patch.exchange(together->kept.before);
      hwy::SetSupportedTargetsForTest(0);

      const auto equal = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
      int moved = 0;
      for (int row = 0; row < TileInStep::side; ++row) {
        EXPECT_EQ(together->kept.stepped[row], apart->kept.stepped[row]);
        for (int c = 0; c < TileInStep::side; ++c) {
          ASSERT_TRUE(equal(together->patch.heights(row)[c], apart->patch.heights(row)[c]))
              << row << ", " << c;
          const bool stage = groups_of(row >= 3 && row < 50 ? apart->active[row] : 0) >> (c / 8) & 1;
          if (stage) {
            ASSERT_TRUE(equal(together->kept.before->row(row)[c], apart->kept.before->row(row)[c]));
            ++moved;
          }
        }
        if (row >= 3 && row < 50) {
          EXPECT_EQ(together->changed[row], apart->changed[row]);
        }
      }
      EXPECT_GT(moved, 500);
      EXPECT_EQ(together->kept.rows.begin, apart->kept.rows.begin);
      EXPECT_EQ(together->kept.rows.end, apart->kept.rows.end);
      EXPECT_EQ(together->range.low, apart->range.low);
      EXPECT_EQ(together->range.high, apart->range.high);
      EXPECT_EQ(together->flow.given, apart->flow.given);
      EXPECT_EQ(together->flow.change, apart->flow.change);
      EXPECT_EQ(together->flow.product, apart->flow.product);
      EXPECT_EQ(together->flow.axis_drop, apart->flow.axis_drop);
    }
}

TEST(SuperStage, DoesNotTakeAWallForAChange) {
  const auto flow = std::make_unique<TileFlow>();
  const auto tile = std::make_unique<SuperStepTile>();
  const auto patch = std::make_unique<TilePatch>();  // all wall
  patch->heights(0)[1] = 2.0;
  CellFlags active{}, changed{};
  flow->rows = {0, 1};
  active[0] = 0b10;
  const HeightRange range = super_stage(*flow, active, 0.0, 0.25, *patch, *tile, changed);
  EXPECT_EQ(changed[0], 0u);
  EXPECT_EQ(range.low, 2.0);
  EXPECT_EQ(range.high, 2.0);
}

TEST(RangeOf, ReadsHeightsWhereverTheyLieInMemory) {  // a vector's begin at multiples of 16 bytes only
  std::vector<double> heights(BedGeometry::tile_area + 8, 0.25);
  for (int offset = 0; offset < 8; ++offset) {
    const HeightRange range = range_of(heights.data() + offset, 64, 64);
    EXPECT_EQ(range.low, 0.25) << offset;
    EXPECT_EQ(range.high, 0.25) << offset;
  }
}

TEST(RangeOf, LeavesOutWhatLiesOutsideTheBed) {
  alignas(64) static std::array<double, BedGeometry::tile_area> heights;
  heights.fill(-99.0);
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 13; ++col) heights[row * BedGeometry::tile_side + col] = row + 0.01 * col;
  const HeightRange range = range_of(heights.data(), 3, 13);
  EXPECT_EQ(range.low, 0.0);
  EXPECT_EQ(range.high, 2.12);
}

}  // namespace
}  // namespace sandstroke
