#include "view/live_bed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "sand/ground.h"

namespace sandstroke {
namespace {

constexpr double most_cells_seen = 4096.0 * 4096.0;

void copy_inside(const double* from, const CellRange& cells, float* to) {
  for (int row = 0; row < cells.rows(); ++row)
    for (int col = 0; col < cells.cols(); ++col) {
      const int at = row * BedGeometry::tile_side + col;
      to[at] = static_cast<float>(from[at]);
    }
}

}  // namespace

LiveBed::LiveBed(const HeightField& bed) : BedGeometry(bed), untouched_(bed.untouched_bed()) {
  if (static_cast<double>(bed.rows()) * bed.cols() > most_cells_seen)
    throw_input_error(
        "bed.cells = [{}, {}]: --view shows up to 4096 x 4096 cells; use fewer, or leave out --view",
        bed.cols(), bed.rows());
  const auto tiles = static_cast<std::size_t>(tile_count());
  published_.resize(tiles, HeightField::new_tile_revision);
  versions_.resize(tiles, 1);
  heights_.resize(tiles);
  if (has_floor(bed)) {
    ground_ = bed.shared_ground();
    for (int tile = 0; tile < tile_count(); ++tile)
      versions_.push_back(std::isfinite(ground_->level()) || ground_->floor.slot_of(tile) >= 0);
  }
  publish(bed);
}

void LiveBed::publish(const HeightField& bed) {
  for (int slot = 0; slot < bed.allocated_tiles(); ++slot) {
    const int tile = bed.tile_of(slot);
    const std::uint64_t revision = bed.tile_revision(tile);
    if (revision == published_[tile]) continue;
    published_[tile] = revision;
    const std::lock_guard lock(mutex_);
    if (!heights_[tile]) heights_[tile] = std::make_unique<float[]>(tile_area);
    copy_inside(bed.tile_heights(slot), tile_cells(tile), heights_[tile].get());
    ++versions_[tile];
  }
}

void LiveBed::copy_tile(int tile, float* out) {
  std::array<double, tile_area> rule;
  untouched_.read_tile(tile, rule.data());
  copy_inside(rule.data(), tile_cells(tile), out);
}

void LiveBed::copy_floor(int tile, float* out) const {
  std::array<double, tile_area> floor;
  ground_->floor.read_tile(tile, floor.data());
  for (double& height : floor)
    if (!std::isfinite(height)) height = static_cast<double>(no_floor);
  copy_inside(floor.data(), tile_cells(tile), out);
}

void LiveBed::take_newer(Reader& reader, Tiles& tiles) {
  tiles.index.clear();
  tiles.heights.clear();
  const auto all = static_cast<int>(versions_.size());
  reader.versions.resize(versions_.size(), 0);
  const int first = reader.next;
  for (int step = 0; step < all && tiles.index.size() < most_tiles; ++step) {
    const int tile = (first + step) % all;
    std::unique_lock lock(mutex_);
    if (reader.versions[tile] == versions_[tile]) continue;
    reader.versions[tile] = versions_[tile];
    const std::size_t begin = tiles.heights.size();
    tiles.index.push_back(tile);
    tiles.heights.resize(begin + tile_area);
    if (tile >= tile_count()) {
      lock.unlock();
      copy_floor(tile - tile_count(), &tiles.heights[begin]);
    } else if (heights_[tile]) {
      std::copy_n(heights_[tile].get(), tile_area, &tiles.heights[begin]);
    } else {
      lock.unlock();
      copy_tile(tile, &tiles.heights[begin]);
    }
    reader.next = (tile + 1) % all;
  }
}

HeightRange height_range(const HeightField& bed) {
  HeightRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  std::array<double, BedGeometry::tile_area> heights;
  for (int tile = 0; tile < bed.tile_count(); ++tile) {
    bed.read_tile(tile, heights.data());
    const CellRange cells = bed.tile_cells(tile);
    for (int row = 0; row < cells.rows(); ++row) {
      const double* begin = heights.data() + row * BedGeometry::tile_side;
      const auto [low, high] = std::minmax_element(begin, begin + cells.cols());
      range = {std::min(range.low, *low), std::max(range.high, *high)};
    }
  }
  return range;
}

std::optional<double> level_bottom(const HeightField& bed) {
  if (!bed.ground() || !std::isfinite(bed.ground()->level())) return std::nullopt;
  return bed.ground()->level();
}

}  // namespace sandstroke
