// The ground under a map of talus slopes.
#include <gtest/gtest.h>

#include "core/error.h"
#include "rules/talus.h"
#include "sand/make_ground.h"
#include "sand/relaxation.h"
#include "sand/sand_region.h"

namespace sandstroke {
namespace {

const BedGeometry cells_under_map(70, 130, 0.01);  // more than a tile, and parts of tiles
const double slope25 = talus_slope(25.0), slope30 = talus_slope(30.0), slope35 = talus_slope(35.0);

SandMap map_with(HeightGrid slopes) {
  SandMap map;
  map.file = "talus.png";
  map.slopes = std::make_shared<HeightGrid>(std::move(slopes));
  return map;
}

/// 25 deg in the columns before this one, and 35 deg from it on.
HeightGrid seam_at(int rows, int cols, int col) {
  HeightGrid slopes = HeightGrid::Constant(rows, cols, slope25);
  slopes.rightCols(cols - col).setConstant(slope35);
  return slopes;
}

/// A region of all that is beyond x, to the bed's ends.
SandRegion sand_beyond(double x, double talus) {
  SandRegion region;
  region.centre = {x + 5.0, 0.0};
  region.size = {10.0, 10.0};
  region.talus_angle = talus;
  return region;
}

TEST(SandMap, IsLaidCellByCell) {
  GroundSettings settings;
  HeightGrid slopes = HeightGrid::NullaryExpr(
      70, 130, [](auto row, auto col) { return 0.3 + 1e-3 * static_cast<double>(131 * row + col); });
  settings.map = map_with(slopes);
  const auto ground = make_ground(cells_under_map, settings, slope30);
  EXPECT_TRUE((ground->talus_slopes.grid() == slopes).all());
  EXPECT_EQ(ground->flattest(), 0.3);
  EXPECT_EQ(ground->floor.allocated_tiles(), 0);
  EXPECT_LE(ground->talus_slopes.allocated_tiles(), most_tiles(cells_under_map, settings).slopes);
}

TEST(SandMap, OfOtherCellsGivesTheMeansOfItsSlopes) {
  GroundSettings settings;
  settings.map = map_with(seam_at(140, 260, 131));  // inside a cell of the bed
  const auto ground = make_ground(cells_under_map, settings, slope30);
  for (const int row : {0, 35, 69}) {
    EXPECT_EQ(ground->talus_slopes(row, 64), slope25);
    EXPECT_NEAR(ground->talus_slopes(row, 65), 0.5 * (slope25 + slope35), 1e-15);
    EXPECT_EQ(ground->talus_slopes(row, 66), slope35);
  }
}

TEST(SandMap, ASeamOnFacesIsThatOfARegion) {
  const BedGeometry exact(70, 130, 0x1p-7);  // in which the region's edge is exactly there
  GroundSettings by_map, by_region;
  by_map.map = map_with(seam_at(70, 130, 65));
  by_region.regions = {sand_beyond(0.0, 35.0)};
  const auto one = make_ground(exact, by_map, slope25), other = make_ground(exact, by_region, slope25);
  EXPECT_TRUE((one->talus_slopes.grid() == other->talus_slopes.grid()).all());
}

TEST(SandMap, RegionsAndStonesLieOverIt) {
  GroundSettings settings;
  settings.map = map_with(seam_at(70, 130, 65));
  SandRegion circle;
  circle.shape = RegionShape::circle;
  circle.radius = 0.2;
  circle.talus_angle = 30.0;
  settings.regions = {circle};
  settings.stones.resize(1);
  settings.stones[0].radius = 0.05;
  settings.stones[0].talus_angle = 20.0;
  const auto ground = make_ground(cells_under_map, settings, slope30);
  EXPECT_EQ(ground->talus_slopes(35, 65), talus_slope(20.0));
  for (const int side : {-1, 1}) {
    EXPECT_EQ(ground->talus_slopes(35, 65 + 10 * side), slope30);
    EXPECT_EQ(ground->talus_slopes(35, 65 + 30 * side), side < 0 ? slope25 : slope35);
  }
  // Through a cell of the region's edge.
  const double share =
      1.0 - RegionArea(circle).mean_share({cells_under_map.x_of(65), cells_under_map.y_of(55)},
                                          cells_under_map.cell_size());
  EXPECT_NEAR(ground->talus_slopes(55, 65), slope30 + share * (slope35 - slope30), 1e-15);
}

TEST(SandMap, OfTheSandThatIsThereChangesNoBit) {
  GroundSettings settings;
  settings.map = map_with(HeightGrid::Constant(60, 70, slope30));
  const auto ground = make_ground(cells_under_map, settings, slope30);
  EXPECT_EQ(ground->talus_slopes.allocated_tiles(), 0);
  // The same sand, but in tiles of its own.
  settings.map = map_with(HeightGrid::Constant(60, 70, slope25));
  settings.regions = {sand_beyond(-5.0, 30.0)};
  const auto over = make_ground(cells_under_map, settings, slope30);
  EXPECT_GT(over->talus_slopes.allocated_tiles(), 0);
  for (const RelaxationLaw law : {RelaxationLaw::paper, RelaxationLaw::isotropic, RelaxationLaw::faces}) {
    RelaxationSettings relaxation;
    relaxation.law = law;
    HeightField plain(70, 130, 0.01, std::make_shared<LevelRule>(0.0));
    for (int row = 30; row < 40; ++row)
      for (int col = 60; col < 72; ++col) plain.set(row, col, 0.1);
    HeightField mapped = plain, covered = plain;
    mapped.lie_on(ground);
    covered.lie_on(over);
    for (HeightField* one : {&plain, &mapped, &covered})
      make_relaxer(relaxation, one->cell_size())->relax(*one);
    EXPECT_TRUE((mapped.grid() == plain.grid()).all());
    EXPECT_TRUE((covered.grid() == plain.grid()).all());
  }
}

TEST(SandMap, ThatWasNotReadIsRefused) {
  GroundSettings settings;
  settings.map.emplace().file = "talus.png";
  EXPECT_FALSE(settings.empty());
  try {
    make_ground(cells_under_map, settings, slope30);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "talus.png: the map of talus angles was not read; run the scene from its file");
  }
}

}  // namespace
}  // namespace sandstroke
