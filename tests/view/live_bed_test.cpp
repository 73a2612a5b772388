#include "view/live_bed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <thread>

#include "bed_on_stones.h"
#include "core/error.h"

namespace sandstroke {
namespace {

HeightField waves(int rows, int cols) {
  HeightGrid heights(rows, cols);
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < cols; ++col) heights(row, col) = std::sin(0.1 * row) + 0.3 * col;
  return {heights, 0.01};
}

/// All that a reader gets until it has everything; by tile.
std::map<int, std::vector<float>> read_all(LiveBed& live, LiveBed::Reader& reader) {
  std::map<int, std::vector<float>> all;
  LiveBed::Tiles tiles;
  for (live.take_newer(reader, tiles); !tiles.index.empty(); live.take_newer(reader, tiles)) {
    EXPECT_LE(tiles.index.size(), LiveBed::most_tiles);
    EXPECT_EQ(tiles.heights.size(), tiles.index.size() * BedGeometry::tile_area);
    for (std::size_t i = 0; i < tiles.index.size(); ++i)
      all[tiles.index[i]].assign(&tiles.heights[i * BedGeometry::tile_area],
                                 &tiles.heights[i * BedGeometry::tile_area] + BedGeometry::tile_area);
  }
  return all;
}

void expect_is(const std::vector<float>& tile, const HeightField& bed, int index) {
  const CellRange cells = bed.tile_cells(index);
  for (int row = 0; row < BedGeometry::tile_side; ++row)
    for (int col = 0; col < BedGeometry::tile_side; ++col) {
      const bool inside = row < cells.rows() && col < cells.cols();
      const double height = inside ? bed(cells.row_begin + row, cells.col_begin + col) : 0.0;
      ASSERT_EQ(tile[row * BedGeometry::tile_side + col], static_cast<float>(height));
    }
}

TEST(LiveBed, GivesEveryTileOnceAndThenWhatChanged) {
  HeightField bed = waves(700, 650);  // 11 x 11 tiles, the last ones cut
  LiveBed live(bed);
  LiveBed::Reader one, other;
  const auto first = read_all(live, one);
  ASSERT_EQ(first.size(), 121u);
  for (const auto& [index, tile] : first) expect_is(tile, bed, index);

  bed.set(699, 649, 7.0);
  live.publish(bed);
  live.publish(bed);  // where nothing has changed
  const auto changed = read_all(live, one);
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed.begin()->first, 120);
  expect_is(changed.begin()->second, bed, 120);
  EXPECT_EQ(read_all(live, other).size(), 121u);  // each reader has its own
}

TEST(LiveBed, GivesTheFloorUnderTheSandOnceWhereThereIsOne) {
  constexpr double none = -std::numeric_limits<double>::infinity();
  for (const double bottom : {none, -0.05}) {
    HeightField bed =
        sand_with_a_stone(200, 300, 0.002, 0.03, 0.0, bottom);  // the stone is in one of 4 x 5 tiles
    LiveBed live(bed);
    LiveBed::Reader reader;
    auto all = read_all(live, reader);
    EXPECT_EQ(all.size(), bottom == none ? 21u : 40u);
    for (int tile = 0; tile < bed.tile_count(); ++tile) {
      if (!all.count(20 + tile)) continue;
      HeightField floor = bed.ground()->floor;
      const CellRange cells = floor.tile_cells(tile);
      for (int row = cells.row_begin; row < cells.row_end; ++row)
        for (int col = cells.col_begin; col < cells.col_end; ++col)
          if (floor(row, col) == none) floor.set(row, col, static_cast<double>(LiveBed::no_floor));
      expect_is(all[20 + tile], floor, tile);
    }
    bed.set(100, 150, 0.5);
    live.publish(bed);
    EXPECT_EQ(read_all(live, reader).size(), 1u);
  }
}

TEST(LiveBed, FollowsACopyOfItsBed) {
  const HeightField start = waves(100, 100);
  LiveBed live(start);
  LiveBed::Reader reader;
  read_all(live, reader);
  HeightField replica = start;
  replica.set(3, 70, -1.0);
  live.publish(replica);
  const auto changed = read_all(live, reader);
  ASSERT_EQ(changed.size(), 1u);
  expect_is(changed.at(1), replica, 1);
}

TEST(LiveBed, TilesThatAreAsTheirRuleSaysAreShownToo) {
  HeightField bed(200, 200, 0.01, std::make_shared<LevelRule>(0.25));
  LiveBed live(bed);
  LiveBed::Reader reader;
  for (const auto& [index, tile] : read_all(live, reader)) expect_is(tile, bed, index);
  bed.allocate(5);  // as the rule says: nothing to tell
  live.publish(bed);
  EXPECT_TRUE(read_all(live, reader).empty());
  bed.set(70, 70, 0.5);
  live.publish(bed);
  const auto changed = read_all(live, reader);
  ASSERT_EQ(changed.size(), 1u);
  expect_is(changed.at(5), bed, 5);
}

TEST(LiveBed, NoTileWaitsForEverWhereMoreChangeThanAReaderGets) {
  HeightField bed = waves(640, 640);  // 100 tiles
  LiveBed live(bed);
  LiveBed::Reader reader;
  LiveBed::Tiles tiles;
  std::set<int> seen;
  for (int turn = 0; turn < 2; ++turn) {
    for (int row = 0; row < 640; row += 64)
      for (int col = 0; col < 640; col += 64) bed.set(row, col, turn + 0.5);
    live.publish(bed);
    live.take_newer(reader, tiles);
    EXPECT_EQ(tiles.index.size(), LiveBed::most_tiles);
    seen.insert(tiles.index.begin(), tiles.index.end());
  }
  EXPECT_EQ(seen.size(), 100u);
}

TEST(LiveBed, RefusesABedThatNoPageCouldShow) {
  EXPECT_NO_THROW(LiveBed(HeightField(4096, 4096, 0.01)));
  EXPECT_THROW(LiveBed(HeightField(4096, 4097, 0.01)), Error);
}

TEST(LiveBed, IsReadWhileItIsPublished) {
  // All cells of a tile are set to one height at a time: no reader ever sees a tile of two heights.
  HeightField bed(64, 128, 0.01);
  bed.allocate(0);
  bed.allocate(1);
  LiveBed live(bed);
  std::jthread publisher([&](const std::stop_token& stop) {
    for (double height = 1.0; !stop.stop_requested(); height += 1.0) {
      for (int slot = 0; slot < 2; ++slot) {
        std::fill_n(bed.tile_heights(slot), BedGeometry::tile_area, height);
        bed.mark_changed(slot);
      }
      live.publish(bed);
    }
  });
  LiveBed::Reader reader;
  LiveBed::Tiles tiles;
  for (float last = 0; last < 50;) {
    live.take_newer(reader, tiles);
    for (std::size_t i = 0; i < tiles.index.size(); ++i) {
      const float* tile = &tiles.heights[i * BedGeometry::tile_area];
      ASSERT_EQ(std::count(tile, tile + BedGeometry::tile_area, *tile), BedGeometry::tile_area);
      last = *tile;
    }
  }
}

}  // namespace
}  // namespace sandstroke
