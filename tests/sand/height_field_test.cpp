#include "sand/height_field.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sandstroke {
namespace {

TEST(HeightField, IsCentredOnTheOrigin) {
  const HeightField odd(5, 3, 0.1), even(4, 4, 0.1);
  EXPECT_EQ(odd.x_of(1), 0.0);
  EXPECT_EQ(odd.y_of(2), 0.0);
  EXPECT_DOUBLE_EQ(even.x_of(0), -0.15);
  EXPECT_DOUBLE_EQ(even.x_of(3), 0.15);
  EXPECT_DOUBLE_EQ(even.col_at(even.x_of(3)), 3.0);
}

TEST(HeightField, KeepsEveryCellInItsTile) {
  HeightGrid heights(70, 130);  // neither side a whole number of tiles
  for (int row = 0; row < 70; ++row)
    for (int col = 0; col < 130; ++col) heights(row, col) = 1000.0 * row + col;
  const HeightField bed(heights, 0.01);
  EXPECT_EQ(bed.tile_rows(), 2);
  EXPECT_EQ(bed.tile_cols(), 3);
  EXPECT_TRUE((bed.grid() == heights).all());
  std::vector<double> block(BedGeometry::tile_area);
  for (int tile = 0; tile < bed.tile_count(); ++tile) {
    const CellRange cells = bed.tile_cells(tile);
    bed.read_tile(tile, block.data());
    for (int row = cells.row_begin; row < cells.row_end; ++row)
      for (int col = cells.col_begin; col < cells.col_end; ++col) {
        const int in_tile = (row - cells.row_begin) * BedGeometry::tile_side + col - cells.col_begin;
        EXPECT_EQ(block[in_tile], heights(row, col));
        EXPECT_EQ(bed.tile_heights(bed.slot_of(tile))[in_tile], heights(row, col));
      }
  }
}

/// A rule with a slope of 0.1 along x, level in the bed's left half.
class Bend : public SurfaceRule {
 public:
  static double at(double x) { return 0.3 + 0.1 * std::max(0.0, x); }
  void fill(const BedGeometry& bed, const CellRange& cells, double* out,
            std::ptrdiff_t stride) const override {
    for (int row = 0; row < cells.rows(); ++row)
      for (int col = 0; col < cells.cols(); ++col)
        out[row * stride + col] = at(bed.x_of(cells.col_begin + col));
  }
  double steepest(const BedGeometry& bed, const CellRange& cells) const override {
    return bed.x_of(cells.col_end - 1) <= 0.0 ? 0.0 : 0.1;
  }
  double highest() const override { return 1e9; }
};

TEST(HeightField, UntouchedTilesFollowTheirRuleAndDoNotExist) {
  HeightField bed(150, 300, 0.01, std::make_shared<Bend>());
  EXPECT_EQ(bed.allocated_tiles(), 0);
  EXPECT_EQ(bed.tile_revision(3), 0u);
  const HeightGrid before = bed.grid();
  for (const int col : {0, 63, 64, 150, 299}) {
    EXPECT_EQ(bed(149, col), Bend::at(bed.x_of(col)));
    EXPECT_EQ(before(17, col), Bend::at(bed.x_of(col)));
  }
  EXPECT_EQ(bed.allocated_tiles(), 0);  // reading touches nothing
  EXPECT_EQ(bed.bytes(), 0u);

  bed.set(70, 200, 5.0);
  EXPECT_EQ(bed.allocated_tiles(), 1);
  EXPECT_EQ(bed.tile_of(0), bed.tile_index(1, 3));
  EXPECT_EQ(bed.bytes(), HeightField::bytes_per_tile());
  HeightGrid expected = before;
  expected(70, 200) = 5.0;
  EXPECT_TRUE((bed.grid() == expected).all());
}

TEST(HeightField, VolumeIsTheSumOfTheCellsWhetherTheirTilesExistOrNot) {
  HeightField bed(150, 300, 0.01, std::make_shared<Bend>());
  EXPECT_NEAR(bed.volume(), bed.grid().sum() * 1e-4, 1e-12);
  bed.set(70, 200, 5.0);
  bed.set(3, 3, -2.0);
  EXPECT_NEAR(bed.volume(), bed.grid().sum() * 1e-4, 1e-12);
}

TEST(HeightField, ACopyIsItsOwn) {
  HeightField bed(100, 100, 0.01);
  bed.set(1, 2, 3.0);
  HeightField copy = bed;
  bed.set(1, 2, 4.0);
  bed.set(80, 80, 1.0);
  EXPECT_EQ(copy(1, 2), 3.0);
  EXPECT_EQ(copy(80, 80), 0.0);
  EXPECT_EQ(copy.allocated_tiles(), 1);
  copy = bed;
  EXPECT_TRUE((copy.grid() == bed.grid()).all());
}

TEST(HeightField, KnowsWhatWasSetUntilItIsSettled) {
  HeightField bed(130, 130, 0.01);
  bed.set(64, 63, 1.0);
  bed.set(64, 3, 1.0);
  ASSERT_EQ(bed.disturbed_tiles(), (std::vector<int>{0}));
  EXPECT_EQ(bed.disturbed_cells(0)[0], std::uint64_t{1} << 63 | std::uint64_t{1} << 3);
  bed.clear_disturbed();
  EXPECT_TRUE(bed.disturbed_tiles().empty());
  EXPECT_EQ(bed.disturbed_cells(0)[0], 0u);
}

TEST(HeightField, AHugeBedCostsWhatIsTouched) {
  HeightField bed(65536, 65536, 0.002);
  bed.set(40000, 30000, 0.25);
  bed.set(65535, 65535, 0.5);
  EXPECT_EQ(bed(40000, 30000), 0.25);
  EXPECT_EQ(bed(65535, 65534), 0.0);
  EXPECT_EQ(bed.bytes(), 2 * HeightField::bytes_per_tile());
  EXPECT_NEAR(bed.volume(), 0.75 * 4e-6, 1e-20);
  EXPECT_EQ(bed.highest(), 0.5);
}

TEST(HeightField, OnlyTheTileOfAChangedCellChangesRevision) {
  HeightField bed(130, 130, 0.01);
  std::vector<std::uint64_t> before;
  for (int tile = 0; tile < bed.tile_count(); ++tile) before.push_back(bed.tile_revision(tile));
  bed.set(64, 63, 1.0);  // second row of tiles, first column
  for (int tile = 0; tile < bed.tile_count(); ++tile)
    EXPECT_EQ(bed.tile_revision(tile) != before[tile], tile == bed.tile_index(1, 0)) << tile;
}

TEST(HeightField, HighestIsThatOfCellsAndOfWhatIsUntouched) {
  HeightField bed(100, 200, 0.01, std::make_shared<LevelRule>(0.5));
  EXPECT_EQ(bed.highest(), 0.5);
  bed.set(3, 3, -2.0);
  EXPECT_EQ(bed.highest(), 0.5);
  bed.set(99, 199, 0.75);
  EXPECT_EQ(bed.highest(), 0.75);
  HeightField bent(100, 200, 0.01, std::make_shared<Bend>());
  bent.set(3, 3, -2.0);
  EXPECT_EQ(bent.highest(), 1e9);  // as its rule says of what is untouched
  EXPECT_EQ(HeightField(HeightGrid::Constant(5, 5, -3.0), 0.01).highest(), -3.0);  // no cell is untouched
}

TEST(HeightField, HeightAtAPointIsThatOfItsCell) {
  HeightField bed(4, 3, 0.5);
  for (int row = 0; row < 4; ++row)
    for (int col = 0; col < 3; ++col) bed.set(row, col, 10.0 * row + col);
  for (int row = 0; row < 4; ++row)
    for (int col = 0; col < 3; ++col)
      for (const double dx : {-0.24, 0.0, 0.24})
        for (const double dy : {-0.24, 0.24})
          EXPECT_EQ(bed.height_at(bed.x_of(col) + dx, bed.y_of(row) + dy), 10.0 * row + col);
  for (const double beyond : {0.26, 0.49, 3.0}) {
    EXPECT_TRUE(std::isnan(bed.height_at(0.5 + beyond, 0.0)));
    EXPECT_TRUE(std::isnan(bed.height_at(-0.5 - beyond, 0.0)));
    EXPECT_TRUE(std::isnan(bed.height_at(0.0, 0.75 + beyond)));
    EXPECT_TRUE(std::isnan(bed.height_at(0.0, -0.75 - beyond)));
  }
}

TEST(HeightField, VisitsEveryCellInWhichTwoBedsMayDiffer) {
  const auto level = [](double height) {
    return HeightField(100, 200, 0.01, std::make_shared<LevelRule>(height));
  };
  const auto differing = [](const HeightField& one, const HeightField& other) {
    int cells = 0;
    visit_cells_of_both(one, other, [&](int row, int col, double a, double b) {
      EXPECT_EQ(a, one(row, col));
      EXPECT_EQ(b, other(row, col));
      cells += a != b;
    });
    return cells;
  };
  HeightField bed = level(0.5);
  EXPECT_TRUE(same_where_untouched(bed, level(0.5)));
  EXPECT_FALSE(same_where_untouched(bed, level(0.6)));
  EXPECT_EQ(differing(bed, level(0.6)), 100 * 200);
  const HeightField bent(150, 300, 0.01, std::make_shared<Bend>());
  EXPECT_FALSE(same_where_untouched(bent, HeightField(150, 300, 0.01, std::make_shared<Bend>())));
  EXPECT_TRUE(same_where_untouched(bent, HeightField(bent)));
  EXPECT_EQ(differing(bed, level(0.5)), 0);
  bed.set(70, 130, 1.0);
  EXPECT_EQ(differing(bed, level(0.5)), 1);
  EXPECT_EQ(differing(level(0.5), bed), 1);
}

TEST(HeightField, VolumeIsHeightTimesArea) {
  const HeightField bed(HeightGrid::Constant(300, 200, 0.25), 0.01);
  EXPECT_NEAR(bed.volume(), 300 * 200 * 0.25 * 1e-4, 1e-15);
}

}  // namespace
}  // namespace sandstroke
