#include "sim/sand_sources.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "core/error.h"
#include "sand/ground.h"

namespace sandstroke {
namespace {

constexpr double density = 1500.0, tick = 1e-3;

SourceSettings source_at(const Eigen::Vector3d& at, double rate, double stop) {
  SourceSettings source;
  source.at = at;
  source.rate = rate;
  source.stop = stop;
  return source;
}

HeightField flat_bed(BedShape shape = BedShape::rectangle) { return {80, 80, 0.001, shape}; }

/// The sum of a ledger's rows.
SourceLedger sum_of(const SandSources& sources) {
  SourceLedger sum;
  for (const SourceLedger& one : sources.ledgers()) {
    sum.poured += one.poured;
    sum.landed += one.landed;
    sum.in_air += one.in_air;
    sum.asked += one.asked;
    sum.taken += one.taken;
  }
  return sum;
}

double area_under(const std::vector<CellUnder>& cells) {
  double parts = 0.0;
  for (const CellUnder& cell : cells) parts += cell.part;
  return parts;
}

TEST(NozzleCells, CoverTheAreaOfItsDisc) {
  const HeightField bed = flat_bed();
  for (const double radius : {0.0005, 0.002, 0.0071}) {
    const double parts = area_under(cells_under_nozzle(bed, 0.0031, -0.0102, radius));
    const double exact = std::numbers::pi * radius * radius / bed.cell_area();
    EXPECT_NEAR(parts, exact, 0.004 * exact) << radius;
  }
}

TEST(NozzleCells, OfAPointHaveItInTheirMiddle) {
  const HeightField bed = flat_bed();
  const Eigen::Vector2d point(0.00317, -0.01042);
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  const std::vector<CellUnder> cells = cells_under_nozzle(bed, point.x(), point.y(), 0.0);
  for (const CellUnder& cell : cells)
    middle += cell.part * Eigen::Vector2d(bed.x_of(cell.col), bed.y_of(cell.row));
  EXPECT_EQ(cells.size(), 4U);
  EXPECT_NEAR(area_under(cells), 1.0, 1e-14);
  EXPECT_LT((middle - point).norm(), 1e-15);
}

TEST(NozzleCells, AreNeverBeyondTheEdge) {
  for (const BedShape shape : {BedShape::rectangle, BedShape::round}) {
    const HeightField bed = flat_bed(shape);
    for (const Eigen::Vector2d& at : {Eigen::Vector2d(0.0399, 0.0), Eigen::Vector2d(0.0283, 0.0283),
                                      Eigen::Vector2d(-0.0399, 0.0399), Eigen::Vector2d(1e9, -1e300)})
      for (const double radius : {0.0, 0.003}) {
        const std::vector<CellUnder> cells = cells_under_nozzle(bed, at.x(), at.y(), radius);
        EXPECT_FALSE(cells.empty());
        for (const CellUnder& cell : cells) EXPECT_TRUE(bed.has_sand(cell.row, cell.col));
      }
  }
}

TEST(SandSources, LandWhatTheyPourAfterItsFall) {
  HeightField bed = flat_bed();
  SandSources sources({source_at({0.003, 0.001, 0.1}, 1e-6, 1.0)}, density);
  const double fall = std::sqrt(2.0 * 0.1 / 9.81);
  for (int k = 1; k <= 130; ++k) sources.act(bed, k * tick);
  EXPECT_EQ(sum_of(sources).landed, 0.0);
  EXPECT_EQ(bed.allocated_tiles(), 0);
  double until = 0.13;
  while (sum_of(sources).landed == 0.0) sources.act(bed, until += tick);
  EXPECT_NEAR(until, fall, 2.0 * tick);
  while (!sources.ended()) sources.act(bed, until += tick);
  EXPECT_NEAR(until, 1.0 + fall, 2.0 * tick);
  EXPECT_NEAR(sum_of(sources).landed, 1e-6, 1e-20);
}

TEST(SandSources, LoseNothingAtAnyTime) {
  // Two sources and a sink that takes of what they pour, on a bed far from z = 0 and with so little sand in a
  // tick that it is below a height's last bit.
  for (const double level : {0.0, 60.0}) {
    HeightField bed(HeightGrid::Constant(80, 80, level), 0.001);
    SourceSettings wide = source_at({-0.01, 0.002, level + 0.3}, 2e-3, 0.7);
    wide.radius = 0.004;
    wide.start = 0.1003;
    SandSources sources(
        {source_at({0.0111, 0.0, level + 0.05}, 3e-9, 0.5), wide, source_at({-0.01, 0.0, level}, -1e-3, 0.9)},
        density);
    for (int k = 1; k <= 1200; ++k) {
      sources.act(bed, k * tick);
      const SourceLedger sum = sum_of(sources);
      ASSERT_NEAR(sum.landed + sum.in_air, sum.poured, 1e-14 * sum.poured) << k;
      if (k % 100 != 0) continue;
      const double gained = (bed.grid() - level).sum() * bed.cell_area();
      ASSERT_NEAR(gained, (sum.landed - sum.taken) / density, 1e-14 * (1e-6 + 1e-3 * level)) << k;
    }
    const std::vector<SourceLedger> ledgers = sources.ledgers();
    EXPECT_NEAR(ledgers[0].poured, 3e-9 * 0.5, 1e-24);
    EXPECT_NEAR(ledgers[1].poured, 2e-3 * (0.7 - 0.1003), 1e-17);
    EXPECT_EQ(ledgers[1].in_air, 0.0);
    EXPECT_GT(ledgers[2].taken, 0.0);
    EXPECT_LE(ledgers[2].taken, ledgers[2].asked);
  }
}

TEST(SandSources, TakeOnlyWhatStandsAboveTheMouthAndTheFloor) {
  for (const double mouth : {-1.0, -0.002}) {
    HeightField bed = flat_bed();
    bed.lie_on(std::make_shared<const Ground>(bed, -0.005, 0.5));
    SourceSettings sink = source_at({0.0, 0.0, mouth}, -1.0, 5.0);
    sink.radius = 0.003;
    SandSources sources({sink}, density);
    for (int k = 1; k <= 5000; ++k) sources.act(bed, k * tick);
    const double low = std::max(mouth, -0.005);
    EXPECT_EQ(bed(40, 40), low);  // all that was under the middle
    EXPECT_EQ(bed.grid().minCoeff(), low);
    const SourceLedger sum = sum_of(sources);
    EXPECT_NEAR(sum.asked, 5.0, 1e-13);
    EXPECT_NEAR(sum.taken, -bed.grid().sum() * bed.cell_area() * density, 1e-15);
    EXPECT_LT(sum.taken, 0.01);
  }
}

TEST(SandSources, TakeWhatTheyAskForWhereThereIsEnough) {
  HeightField bed = flat_bed();
  SandSources sources({source_at({0.0002, 0.0, -0.01}, -1e-5, 1.0)}, density);
  for (int k = 1; k <= 1000; ++k) sources.act(bed, k * tick);
  EXPECT_NEAR(sum_of(sources).taken, 1e-5, 1e-17);
  EXPECT_NEAR(bed.volume(), -1e-5 / density, 1e-20);
}

TEST(SandSources, MeasureFromTheFloorWhatIsTooHigh) {
  // 1250 lengths of the bed over z = 0, on a floor there: it is the floor that is so high.
  HeightField bed = flat_bed();
  bed.lie_on(std::make_shared<Ground>(bed, 100.0, 0.6));
  SandSources sources({source_at({0.0, 0.0, 100.01}, 0.01, 0.1)}, density);
  EXPECT_NO_THROW(sources.act(bed, 1.0));
  EXPECT_NEAR(sources.ledgers()[0].landed, 0.001, 1e-15);
  SandSources far_more({source_at({0.0, 0.0, 100.01}, 1e4, 0.1)}, density);
  EXPECT_THROW(far_more.act(bed, 1.0), Error);
}

TEST(SandSources, FollowAPathAndAreClosedWhereItIsLifted) {
  Stroke path;
  path.time = {3.0, 3.5, 4.0, 4.5};
  path.gap_threshold = 1.0;
  path.position = {{-0.02, 0.0, 0.0}, {-0.01, 0.0, 0.0}, {0.01, 0.0, 0.0}, {0.02, 0.0, 0.0}};
  path.contact = {pen_down, pen_lifts, pen_down, pen_down};
  SourceSettings source = source_at({0.0, 0.005, 0.02}, 1e-3, std::numeric_limits<double>::infinity());
  source.start = 0.25;
  source.stroke = std::make_shared<const Stroke>(path);
  SandSources sources({source}, density);
  EXPECT_EQ(sources.last_stop(), 0.25 + 1.5);
  HeightField bed = flat_bed();
  for (int k = 1; k <= 2000; ++k) sources.act(bed, k * tick);
  EXPECT_TRUE(sources.ended());
  EXPECT_NEAR(sum_of(sources).landed, 1e-3, 2e-6);  // half a second, closed, and half a second: to a tick
  for (int col = 0; col < bed.cols(); ++col) {
    const double x = bed.x_of(col), along = bed(44, col) + bed(45, col);
    if (std::abs(std::abs(x) - 0.015) < 0.004) {
      EXPECT_NEAR(along, 1e-3 / 0.02 / density / bed.cell_size(), 2e-6) << x;
    } else if (std::abs(x) < 0.009 || std::abs(x) > 0.021) {
      EXPECT_EQ(along, 0.0) << x;
    }
  }
}

TEST(SandSources, GoOnFromAStateInMidAir) {
  const auto make = [] {
    return SandSources({source_at({0.003, 0.001, 0.1}, 1e-3, 0.5), source_at({0.003, 0.0, 0.0}, -1e-4, 0.6)},
                       density);
  };
  HeightField whole = flat_bed(), half = flat_bed();
  SandSources one = make(), other = make();
  for (int k = 1; k <= 800; ++k) one.act(whole, k * tick);
  for (int k = 1; k <= 300; ++k) other.act(half, k * tick);
  ASSERT_GT(sum_of(other).in_air, 0.0);
  StateKeeper keeper;
  other.visit_state(keeper);
  SandSources restored = make();
  const std::string kept = std::move(keeper).kept();
  StateRestorer restorer(kept);
  restored.visit_state(restorer);
  restorer.end();
  for (int k = 301; k <= 800; ++k) restored.act(half, k * tick);
  EXPECT_EQ((whole.grid() - half.grid()).abs().maxCoeff(), 0.0);
  EXPECT_EQ(sum_of(restored).landed, sum_of(one).landed);
  EXPECT_EQ(sum_of(restored).taken, sum_of(one).taken);
}

}  // namespace
}  // namespace sandstroke
