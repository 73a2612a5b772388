#include "sand/make_ground.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "rules/talus.h"

namespace sandstroke {
namespace {

using std::numbers::pi;
constexpr double none = -std::numeric_limits<double>::infinity();

StoneSettings sphere(double x, double y, double z, double radius) {
  StoneSettings stone;
  stone.centre = {x, y, z};
  stone.radius = radius;
  return stone;
}

StoneSettings sized(StoneShape shape, const Eigen::Vector3d& centre, const Eigen::Vector3d& size,
                    double turn) {
  StoneSettings stone;
  stone.shape = shape;
  stone.centre = centre;
  stone.size = size;
  stone.turn = turn;
  return stone;
}

/// A box as a mesh, its origin in its middle.
TriangleMesh box_mesh(const Eigen::Vector3d& size) {
  TriangleMesh mesh;
  for (const double z : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double x : {-0.5, 0.5}) mesh.vertices.push_back(size.cwiseProduct(Eigen::Vector3d(x, y, z)));
  mesh.triangles = {{4, 5, 7}, {4, 7, 6}, {0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

std::shared_ptr<const Ground> ground_of(const std::vector<StoneSettings>& stones, int cells,
                                        std::optional<double> floor = std::nullopt) {
  GroundSettings settings;
  settings.floor = floor;
  settings.stones = stones;
  return make_ground(BedGeometry(cells, cells, 1.0 / cells), settings, 0.5);
}

/// The volume of the floor above a level [m^3].
double volume_above(const Ground& ground, double level) {
  double sum = 0.0;
  for (int row = 0; row < ground.floor.rows(); ++row)
    for (int col = 0; col < ground.floor.cols(); ++col) sum += std::max(0.0, ground.floor(row, col) - level);
  return sum * ground.floor.cell_area();
}

/// The mean error of the volume, over places of the stone within a cell.
double mean_error(StoneSettings stone, int cells, double volume) {
  const Eigen::Vector3d centre = stone.centre;
  constexpr int places = 5;
  double sum = 0.0;
  for (int i = 0; i < places; ++i)
    for (int j = 0; j < places; ++j) {
      stone.centre = centre + Eigen::Vector3d(i, j, 0.0) / (places * cells);
      sum += std::abs(volume_above(*ground_of({stone}, cells), 0.0) - volume);
    }
  return sum / (places * places) / volume;
}

TEST(MakeGround, NothingMakesNone) { EXPECT_EQ(ground_of({}, 10), nullptr); }

TEST(MakeGround, AFloorAloneAllocatesNothing) {
  const auto ground = ground_of({}, 100, -0.02);
  EXPECT_EQ(ground->floor(3, 50), -0.02);
  EXPECT_EQ(ground->level(), -0.02);
  EXPECT_EQ(ground->floor.allocated_tiles(), 0);
  EXPECT_EQ(ground->talus_slopes(3, 50), 0.5);
}

TEST(MakeGround, ACapHasItsVolumeToSecondOrder) {
  const double radius = 0.25, height = 0.1, volume = pi * height * height * (3.0 * radius - height) / 3.0;
  const StoneSettings stone = sphere(0.03, 0.02, height - radius, radius);
  const double coarse = mean_error(stone, 40, volume), fine = mean_error(stone, 160, volume);
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, coarse / std::pow(4.0, 1.7));
}

TEST(MakeGround, ABodyWithASteepBorderHasItsVolumeToMoreThanFirstOrder) {
  const StoneSettings ellipsoid = sized(StoneShape::ellipsoid, {0.03, 0.02, 0.0}, {0.6, 0.4, 0.2}, 30.0),
                      box = sized(StoneShape::box, {0.03, 0.02, 0.0}, {0.5, 0.3, 0.2}, 30.0);
  const double of_ellipsoid = 2.0 / 3.0 * pi * 0.3 * 0.2 * 0.1, of_box = 0.5 * 0.3 * 0.1;
  for (const auto& [stone, volume] : {std::pair(ellipsoid, of_ellipsoid), {box, of_box}}) {
    const double coarse = mean_error(stone, 40, volume), fine = mean_error(stone, 160, volume);
    EXPECT_LT(fine, 3e-3);
    EXPECT_LT(fine, coarse / std::pow(4.0, 1.2));
  }
}

TEST(MakeGround, ABoxAlongTheCellsIsExact) {
  const auto ground = ground_of({sized(StoneShape::box, {0.1, 0.0, 0.0}, {0.2, 0.4, 0.1}, 0.0)}, 100);
  EXPECT_NEAR(volume_above(*ground, 0.0), 0.2 * 0.4 * 0.05, 1e-15);
  EXPECT_EQ(ground->floor(50, 60), 0.05);
  EXPECT_EQ(ground->floor(50, 40), none);
}

TEST(MakeGround, AnEllipsoidOfEqualSizesIsASphere) {
  const auto one = ground_of({sphere(0.01, 0.02, 0.0, 0.2)}, 100),
             other = ground_of({sized(StoneShape::ellipsoid, {0.01, 0.02, 0.0}, {0.4, 0.4, 0.4}, 0.0)}, 100);
  for (int row = 0; row < 100; ++row)
    for (int col = 0; col < 100; ++col) ASSERT_EQ(one->floor(row, col), other->floor(row, col));
}

TEST(MakeGround, AMeshIsAsTheBoxThatItShows) {
  const Eigen::Vector3d size(0.31, 0.17, 0.1), centre(0.011, 0.023, 0.0);
  const StoneSettings box = sized(StoneShape::box, centre, size, 33.0);
  StoneSettings mesh = sized(StoneShape::mesh, centre, size, 33.0);
  mesh.mesh = std::make_shared<TriangleMesh>(box_mesh(size));
  const auto one = ground_of({box}, 100), other = ground_of({mesh}, 100);
  for (int row = 0; row < 100; ++row)
    for (int col = 0; col < 100; ++col)
      if (one->floor(row, col) == none)
        ASSERT_EQ(other->floor(row, col), none);
      else
        ASSERT_NEAR(other->floor(row, col), one->floor(row, col), 1e-15);
}

TEST(MakeGround, AMeshOfASlopeHasItsMeans) {
  TriangleMesh wedge = box_mesh({0.4, 0.4, 0.2});
  for (Eigen::Vector3d& vertex : wedge.vertices)
    if (vertex.z() > 0.0) vertex.z() += 0.5 * vertex.x();
  StoneSettings stone = sized(StoneShape::mesh, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, 0.0);
  stone.mesh = std::make_shared<TriangleMesh>(wedge);
  const auto ground = ground_of({stone}, 100);
  const BedGeometry& cells = ground->floor;
  for (int col = 31; col < 69; ++col) EXPECT_NEAR(ground->floor(50, col), 0.1 + 0.5 * cells.x_of(col), 1e-15);
}

TEST(MakeGround, TheHighestStoneCounts) {
  const auto ground = ground_of({sphere(0.0, 0.0, 0.0, 0.1), sphere(0.05, 0.0, -0.05, 0.2)}, 101, -0.02);
  EXPECT_NEAR(ground->floor(50, 50), std::sqrt(0.04 - 0.0025) - 0.05, 2e-4);
  EXPECT_EQ(ground->floor(0, 0), -0.02);
  for (int col = 0; col < 101; ++col) EXPECT_GE(ground->floor(50, col), -0.02);
}

TEST(MakeGround, SandOnAStoneHasItsTalus) {
  StoneSettings rough = sphere(0.2, 0.0, -0.05, 0.1), smooth = sphere(-0.2, 0.0, -0.05, 0.1);
  rough.talus_angle = 45.0;
  const auto ground = ground_of({rough, smooth}, 100, 0.0);
  const BedGeometry& cells = ground->floor;
  for (int row = 0; row < 100; ++row)
    for (int col = 0; col < 100; ++col) {
      const bool on_rough = ground->floor(row, col) > 0.0 && cells.x_of(col) > 0.0;
      ASSERT_EQ(ground->talus_slopes(row, col), on_rough ? talus_slope(45.0) : 0.5);
    }
}

TEST(MakeGround, AllocatesOnlyTheTilesThatAStoneRaises) {
  GroundSettings settings;
  settings.floor = -0.1;
  settings.stones = {sphere(3.0, 3.0, 0.0, 0.05), sphere(-3.0, 3.0, -0.3, 0.05), sphere(99.0, 0.0, 0.0, 0.1)};
  const BedGeometry huge(65536, 65536, 0.001);
  const auto ground = make_ground(huge, settings, 0.5);
  EXPECT_GE(ground->floor.allocated_tiles(), 1);
  EXPECT_LE(ground->floor.allocated_tiles(), 9);
  EXPECT_LE(ground->floor.allocated_tiles(), most_tiles(huge, settings).floor);
  EXPECT_EQ(ground->talus_slopes.allocated_tiles(), 0);
  EXPECT_TRUE(ground->floor.disturbed_tiles().empty());
}

TEST(MakeGround, AnyNumberOfThreadsMakesTheSame) {
  std::vector<StoneSettings> stones = {sphere(0.0, 0.0, 0.0, 0.4),
                                       sized(StoneShape::box, {0.3, 0.1, 0.1}, {0.2, 0.3, 0.4}, 20.0)};
  stones[0].talus_angle = 40.0;
  const auto many = ground_of(stones, 300);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto single = ground_of(stones, 300);
  EXPECT_EQ(content_hash(many->floor), content_hash(single->floor));
  EXPECT_EQ(content_hash(many->talus_slopes), content_hash(single->talus_slopes));
}

}  // namespace
}  // namespace sandstroke
