#include "sand/steep_tiles.h"

#include <gtest/gtest.h>

#include "sand/initial_surface.h"
#include "sand/relaxation.h"

namespace sandstroke {
namespace {

TEST(SteepTiles, TheFirstRelaxationLooksAtThemAndWhatIsBesideThem) {
  using enum SurfaceKind;
  for (const auto kind : {flat, cylinder, cone, cliff, noise, ripples}) {
    SurfaceSettings surface;
    surface.kind = kind;
    surface.radius = 0.3;
    surface.height = 0.25;
    HeightField bed = make_surface(surface, 1000, 900, 0.002);
    RelaxationSettings settings;
    settings.max_passes = 0;
    const std::int64_t counted = tiles_to_relax(bed, settings);
    const int tiles_active = make_relaxer(settings, bed.cell_size())->relax(bed).tiles_active_max;
    EXPECT_GE(tiles_active, counted) << static_cast<int>(kind);
    EXPECT_LE(tiles_active, 3 * counted) << static_cast<int>(kind);
  }
}

TEST(SteepTiles, CountOnceWhereTheyExist) {
  SurfaceSettings cliff;
  cliff.kind = SurfaceKind::cliff;
  HeightField bed = make_surface(cliff, 60, 1000, 0.002);
  const std::int64_t counted = tiles_to_relax(bed, {});
  EXPECT_GT(counted, 0);
  for (int col = 400; col < 600; ++col) bed.set(30, col, bed(30, col));
  EXPECT_EQ(tiles_to_relax(bed, {}), bed.allocated_tiles());
  EXPECT_GT(bed.allocated_tiles(), counted);
}

TEST(SteepTiles, TilesThatExistCount) {
  HeightField bed(1000, 1000, 0.002);
  EXPECT_EQ(tiles_to_relax(bed, {}), 0);
  bed.set(500, 500, 0.1);
  EXPECT_EQ(tiles_to_relax(bed, {}), 1);
}

}  // namespace
}  // namespace sandstroke
