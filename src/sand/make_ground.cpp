#include "sand/make_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "rules/talus.h"
#include "sand/map_means.h"
#include "sand/sand_region.h"
#include "sand/stone_surface.h"

namespace sandstroke {
namespace {

constexpr int tile_side = BedGeometry::tile_side;
using TileValues = std::array<double, BedGeometry::tile_area>;

/// Tile rows and columns that meet a box [m].
CellRange tiles_in(const BedGeometry& bed, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  // A box ends between cells or beyond the bed; clamped before it becomes whole.
  const auto clamped = [](double cell, int cells) {
    return static_cast<int>(std::clamp(cell, -1.0, static_cast<double>(cells)));
  };
  const int first_row = clamped(std::ceil(bed.row_at(low.y()) - 0.5), bed.rows()),
            last_row = clamped(std::floor(bed.row_at(high.y()) + 0.5), bed.rows()),
            first_col = clamped(std::ceil(bed.col_at(low.x()) - 0.5), bed.cols()),
            last_col = clamped(std::floor(bed.col_at(high.x()) + 0.5), bed.cols());
  if (last_row < 0 || last_col < 0 || first_row >= bed.rows() || first_col >= bed.cols()) return {};
  const auto tile_of = [](int cell, int cells) { return std::clamp(cell, 0, cells - 1) / tile_side; };
  return {tile_of(first_row, bed.rows()), tile_of(last_row, bed.rows()) + 1, tile_of(first_col, bed.cols()),
          tile_of(last_col, bed.cols()) + 1};
}

double tiles_of(const CellRange& tiles) { return static_cast<double>(tiles.rows()) * tiles.cols(); }

bool holds(const CellRange& tiles, int row, int col) {
  return row >= tiles.row_begin && row < tiles.row_end && col >= tiles.col_begin && col < tiles.col_end;
}

struct PlacedRegion {
  RegionArea area;
  double slope;
  CellRange tiles;
};

struct PlacedStone {
  StoneSurface surface;
  std::optional<double> slope;
  CellRange tiles;
};

/// The ground of one tile.
struct TileOfGround {
  int tile;
  bool has_floor = false, has_slopes = false;
  TileValues floor, slopes;
};

class GroundMaker {
 public:
  GroundMaker(const BedGeometry& bed, const GroundSettings& settings, double talus_slope)
      : bed_(bed),
        level_(settings.floor.value_or(-std::numeric_limits<double>::infinity())),
        talus_slope_(talus_slope) {
    if (settings.map) {
      if (!settings.map->slopes)
        throw_input_error("{}: the map of talus angles was not read; run the scene from its file",
                          settings.map->file);
      map_ = running_means(*settings.map->slopes, bed.rows(), bed.cols());
    }
    for (const SandRegion& region : settings.regions) {
      if (!region.talus_angle) continue;
      const RegionArea area(region);
      const Eigen::AlignedBox2d box = area.bounds();
      regions_.push_back(
          {area, sandstroke::talus_slope(*region.talus_angle), tiles_in(bed, box.min(), box.max())});
    }
    for (const StoneSettings& stone : settings.stones) {
      if (stone.shape == StoneShape::mesh && !stone.mesh)
        throw_input_error("{}: the mesh of a stone was not read; run the scene from its file", stone.file);
      const StoneSurface surface(stone);
      const Eigen::AlignedBox3d box = surface.bounds();
      std::optional<double> slope;
      if (stone.talus_angle > 0.0) slope = sandstroke::talus_slope(stone.talus_angle);
      stones_.push_back({surface, slope, tiles_in(bed, box.min().head<2>(), box.max().head<2>())});
    }
  }

  std::shared_ptr<const Ground> make() const {
    auto ground = std::make_shared<Ground>(bed_, level_, talus_slope_);
    const std::vector<int> tiles = touched_tiles();
    constexpr std::size_t at_once = 256;  // their values are kept until they are put down in order
    for (std::size_t first = 0; first < tiles.size() && !interrupted(); first += at_once) {
      std::vector<TileOfGround> made(std::min(at_once, tiles.size() - first));
      parallel_for(made.size(), [&](std::size_t i) {
        made[i].tile = tiles[first + i];
        fill(made[i]);
      });
      for (const TileOfGround& tile : made) {
        if (tile.has_floor) put(ground->floor, tile.tile, tile.floor);
        if (tile.has_slopes) put(ground->talus_slopes, tile.tile, tile.slopes);
      }
    }
    return ground;
  }

 private:
  std::vector<int> touched_tiles() const {
    std::vector<int> tiles;
    const auto add = [&](const CellRange& range) {
      for (int row = range.row_begin; row < range.row_end; ++row)
        for (int col = range.col_begin; col < range.col_end; ++col)
          tiles.push_back(bed_.tile_index(row, col));
    };
    if (map_.size() > 0) add({0, bed_.tile_rows(), 0, bed_.tile_cols()});
    for (const PlacedRegion& region : regions_) add(region.tiles);
    for (const PlacedStone& stone : stones_) add(stone.tiles);
    std::sort(tiles.begin(), tiles.end());
    tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
    return tiles;
  }

  void fill(TileOfGround& tile) const {
    tile.floor.fill(level_);
    tile.slopes.fill(talus_slope_);
    const int row = tile.tile / bed_.tile_cols(), col = tile.tile % bed_.tile_cols();
    if (map_.size() > 0) lay_map(tile);
    lay_regions(tile, row, col);
    lay_stones(tile, row, col);
  }

  void lay_map(TileOfGround& tile) const {
    const CellRange cells = bed_.tile_cells(tile.tile);
    for (int row = 0; row < cells.rows(); ++row)
      for (int col = 0; col < cells.cols(); ++col) {
        const double slope = map_(cells.row_begin + row, cells.col_begin + col);
        tile.slopes[static_cast<std::size_t>(row * tile_side + col)] = slope;
        tile.has_slopes = tile.has_slopes || slope != talus_slope_;
      }
  }

  void lay_regions(TileOfGround& tile, int tile_row, int tile_col) const {
    const CellRange cells = bed_.tile_cells(tile.tile);
    const double side = bed_.cell_size();
    const Eigen::Vector2d middle(bed_.x_of(cells.col_begin) + 0.5 * (tile_side - 1) * side,
                                 bed_.y_of(cells.row_begin) + 0.5 * (tile_side - 1) * side);
    std::vector<const PlacedRegion*> here;
    for (const PlacedRegion& region : regions_) {
      if (!holds(region.tiles, tile_row, tile_col)) continue;
      const double share = region.area.whole_share(middle, tile_side * side);
      if (share == 0.0) continue;
      tile.has_slopes = true;
      if (share < 1.0) {
        here.push_back(&region);
        continue;
      }
      here.clear();
      tile.slopes.fill(region.slope);
    }
    if (here.empty()) return;
    for (int row = 0; row < cells.rows(); ++row)
      for (int col = 0; col < cells.cols(); ++col) {
        double& slope = tile.slopes[static_cast<std::size_t>(row * tile_side + col)];
        slope = mean_slope(here, {bed_.x_of(cells.col_begin + col), bed_.y_of(cells.row_begin + row)}, slope);
      }
  }

  /// Of a cell, where sand with the slope `below` lies outside the regions.
  double mean_slope(const std::vector<const PlacedRegion*>& regions, const Eigen::Vector2d& centre,
                    double below) const {
    const double side = bed_.cell_size();
    double slope = below;
    int edges = 0;  // that cross the cell
    for (const PlacedRegion* region : regions) {
      const double share = region->area.mean_share(centre, side);
      if (share == 1.0) edges = 0;
      edges += share > 0.0 && share < 1.0;
      slope = std::lerp(slope, region->slope, share);
    }
    if (edges < 2) return slope;
    constexpr int samples = 8;
    double sum = 0.0;  // of what differs, so that equal sand stays equal to the bit
    visit_samples(centre, side, samples, [&](const Eigen::Vector2d& at) {
      double here = below;
      for (const PlacedRegion* region : regions)
        here = std::lerp(here, region->slope, region->area.share(at));
      sum += here - below;
    });
    return below + sum / (samples * samples);
  }

  void lay_stones(TileOfGround& tile, int tile_row, int tile_col) const {
    const CellRange cells = bed_.tile_cells(tile.tile);
    TileValues heights;
    for (const PlacedStone& stone : stones_) {
      if (!holds(stone.tiles, tile_row, tile_col)) continue;
      stone.surface.fill(bed_, cells, heights.data(), tile_side);
      for (int row = 0; row < cells.rows(); ++row)
        for (int col = 0; col < cells.cols(); ++col) {
          const auto at = static_cast<std::size_t>(row * tile_side + col);
          if (!(heights[at] > tile.floor[at])) continue;
          tile.floor[at] = heights[at];
          tile.has_floor = true;
          if (!stone.slope) continue;
          tile.slopes[at] = *stone.slope;
          tile.has_slopes = true;
        }
    }
  }

  static void put(HeightField& field, int tile, const TileValues& values) {
    const int slot = field.allocate(tile);
    const CellRange cells = field.tile_cells(tile);
    double* out = field.tile_heights(slot);
    for (int row = 0; row < cells.rows(); ++row)
      std::copy_n(values.begin() + row * tile_side, cells.cols(), out + row * tile_side);
    field.mark_changed(slot);
  }

  BedGeometry bed_;
  double level_, talus_slope_;
  HeightGrid map_;  // slopes; empty: there is none
  std::vector<PlacedRegion> regions_;
  std::vector<PlacedStone> stones_;
};

}  // namespace

std::shared_ptr<const Ground> make_ground(const BedGeometry& bed, const GroundSettings& settings,
                                          double talus_slope) {
  if (!settings.is_solid() && !settings.has_slopes()) return nullptr;
  return GroundMaker(bed, settings, talus_slope).make();
}

GroundTiles most_tiles(const BedGeometry& bed, const GroundSettings& settings) {
  GroundTiles most;
  if (settings.map) most.slopes = static_cast<double>(bed.tile_count());
  for (const SandRegion& region : settings.regions) {
    if (!region.talus_angle) continue;
    const Eigen::AlignedBox2d box = RegionArea(region).bounds();
    most.slopes += tiles_of(tiles_in(bed, box.min(), box.max()));
  }
  for (const StoneSettings& stone : settings.stones) {
    if (stone.shape == StoneShape::mesh && !stone.mesh) continue;
    const Eigen::AlignedBox3d box = StoneSurface(stone).bounds();
    const double tiles = tiles_of(tiles_in(bed, box.min().head<2>(), box.max().head<2>()));
    most.floor += tiles;
    if (stone.talus_angle > 0.0) most.slopes += tiles;
  }
  const auto all = static_cast<double>(bed.tile_count());
  return {std::min(most.floor, all), std::min(most.slopes, all)};
}

}  // namespace sandstroke
