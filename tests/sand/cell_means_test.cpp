#include "sand/cell_means.h"

#include <gtest/gtest.h>

#include <functional>

namespace sandstroke {
namespace {

HeightField sampled(int rows, int cols, double cell_size,
                    const std::function<double(double, double)>& height) {
  HeightField bed(rows, cols, cell_size);
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < cols; ++col) bed.set(row, col, height(bed.x_of(col), bed.y_of(row)));
  return bed;
}

TEST(Coarsened, HoldsTheMeansOfItsCells) {
  HeightGrid fine(4, 6);
  for (int i = 0; i < fine.size(); ++i) fine.data()[i] = i;
  const HeightField coarse = coarsened(HeightField(fine, 0.5), 2);
  ASSERT_EQ(coarse.rows(), 2);
  ASSERT_EQ(coarse.cols(), 3);
  EXPECT_EQ(coarse.cell_size(), 1.0);
  EXPECT_EQ(coarse(0, 0), (0 + 1 + 6 + 7) / 4.0);
  EXPECT_EQ(coarse(1, 2), (16 + 17 + 22 + 23) / 4.0);
}

TEST(Coarsened, APlaneStaysAndAParabolaRisesByItsMeanWithinACell) {
  // Over tiles and their borders: 3 does not divide 64. The mean of x^2 over n cells d apart is that of their
  // middle + d^2 (n^2 - 1) / 12.
  constexpr double d = 0.01;
  for (const int n : {2, 3, 5}) {
    const HeightField fine =
        sampled(150, 210, d, [](double x, double y) { return 0.3 * x - 0.2 * y + 4.0 * x * x; });
    const HeightField coarse = coarsened(fine, n);
    EXPECT_NEAR(coarse.volume(), fine.volume(), 1e-14);
    for (int row = 0; row < coarse.rows(); ++row)
      for (int col = 0; col < coarse.cols(); ++col) {
        const double x = coarse.x_of(col), y = coarse.y_of(row);
        ASSERT_NEAR(coarse(row, col), 0.3 * x - 0.2 * y + 4.0 * (x * x + d * d * (n * n - 1) / 12.0), 1e-14);
      }
  }
}

TEST(Coarsened, AHugeLevelBedStaysOneAndKeepsWhatWasTouched) {
  HeightField fine(3 * 20000, 3 * 20000, 1e-3, std::make_shared<LevelRule>(0.25));
  fine.set(63, 64, 0.25 + 9e-3);
  const HeightField coarse = coarsened(fine, 3);
  EXPECT_LE(coarse.allocated_tiles(), 4);
  EXPECT_NEAR(coarse(21, 21), 0.25 + 1e-3, 1e-15);
  EXPECT_NEAR(coarse(21, 22), 0.25, 1e-15);
  EXPECT_EQ(coarse(19999, 0), 0.25);
}

/// A bed as high as it is far along x.
class Ramp : public SurfaceRule {
  void fill(const BedGeometry& bed, const CellRange& cells, double* out,
            std::ptrdiff_t stride) const override {
    for (int row = 0; row < cells.rows(); ++row, out += stride)
      for (int col = 0; col < cells.cols(); ++col) out[col] = bed.x_of(cells.col_begin + col);
  }
  double steepest(const BedGeometry&, const CellRange&) const override { return 1.0; }
  double highest() const override { return 1.0; }
};

TEST(Coarsened, ABedThatIsNotLevelIsTakenAsAWhole) {
  const HeightField coarse = coarsened(HeightField(100, 200, 0.01, std::make_shared<Ramp>()), 2);
  for (int col = 0; col < coarse.cols(); ++col) EXPECT_NEAR(coarse(7, col), coarse.x_of(col), 1e-15);
}

TEST(CellMeans, CellsThatAreCutCountByTheirFraction) {
  const HeightField bed(HeightGrid{{1.0, 2.0, 4.0}, {1.0, 2.0, 4.0}}, 1.0);
  const CellMeans means(bed, 1, 2);
  EXPECT_NEAR(means(0, 0), (1.0 + 0.5 * 2.0) / 1.5, 1e-15);
  EXPECT_NEAR(means(0, 1), (0.5 * 2.0 + 4.0) / 1.5, 1e-15);
}

TEST(CellCovers, EachCellOfTheOtherGridIsCoveredOnce) {
  for (const auto& [here, there] : {std::pair{3, 7}, {7, 3}, {5, 5}, {1, 65536}, {65536, 65535}, {1000, 1}}) {
    std::vector<double> covered(static_cast<std::size_t>(there));
    for (const CellCover& cover : cell_covers(here, there)) {
      double whole = 0.0;
      for (std::size_t k = 0; k < cover.fraction.size(); ++k) {
        EXPECT_GT(cover.fraction[k], 0.0);
        whole += cover.fraction[k];
        covered[static_cast<std::size_t>(cover.begin) + k] += cover.fraction[k] * there / here;
      }
      ASSERT_NEAR(whole, 1.0, 1e-12) << here << ", " << there;
    }
    for (const double part : covered) ASSERT_NEAR(part, 1.0, 1e-12) << here << ", " << there;
  }
}

TEST(Coarsened, IsTheBedItselfAtNoCostByAFactorOfOne) {
  HeightField bed(100, 200, 0.01, std::make_shared<Ramp>());
  EXPECT_EQ(coarsened(bed, 1).allocated_tiles(), 0);
  bed.set(70, 3, 0.5);
  EXPECT_EQ(coarsened(bed, 1).allocated_tiles(), 1);
  EXPECT_TRUE((coarsened(bed, 1).grid() == bed.grid()).all());
}

}  // namespace
}  // namespace sandstroke
