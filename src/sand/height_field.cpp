#include "sand/height_field.h"

#include <cmath>
#include <limits>
#include <new>

#include "core/compensated_sum.h"
#include "core/error.h"
#include "core/hash.h"
#include "sand/cell_ranges.h"
#include "sand/ground.h"

namespace sandstroke {
namespace {

std::uint32_t* zeros(int count) {
  void* memory = std::calloc(static_cast<std::size_t>(count), sizeof(std::uint32_t));
  if (!memory) throw std::bad_alloc();
  return static_cast<std::uint32_t*>(memory);
}

}  // namespace

HeightField::HeightField(int rows, int cols, double cell_size, BedShape shape)
    : HeightField(rows, cols, cell_size, std::make_shared<LevelRule>(0.0), shape) {}

HeightField::HeightField(int rows, int cols, double cell_size, std::shared_ptr<const SurfaceRule> untouched,
                         BedShape shape)
    : BedGeometry(rows, cols, cell_size, shape),
      untouched_(std::move(untouched)),
      slots_(zeros(tile_count())) {}

HeightField::HeightField(const HeightGrid& heights, double cell_size, BedShape shape)
    : HeightField(static_cast<int>(heights.rows()), static_cast<int>(heights.cols()), cell_size, shape) {
  for (int tile = 0; tile < tile_count(); ++tile) {
    const int slot = make_tile(tile);
    mark_changed(slot);
    double* out = tile_heights(slot);
    const CellRange cells = tile_cells(tile);
    for (int row = cells.row_begin; row < cells.row_end; ++row, out += tile_side)
      std::copy_n(&heights(row, cells.col_begin), cells.cols(), out);
  }
}

HeightField::HeightField(const HeightField& other)
    : BedGeometry(other),
      untouched_(other.untouched_),
      slots_(zeros(tile_count())),
      tiles_(other.tiles_),
      disturbed_(other.disturbed_),
      tool_walls_(other.tool_walls_),
      ground_(other.ground_) {
  const auto all = static_cast<std::size_t>(tile_count());
  if (tiles_.size() > all / 8) {
    std::copy_n(other.slots_.get(), all, slots_.get());
    return;
  }
  for (std::size_t slot = 0; slot < tiles_.size(); ++slot)  // leaves the pages of untouched tiles alone
    slots_.get()[tiles_[slot]->index] = static_cast<std::uint32_t>(slot) + 1;
}

HeightField& HeightField::operator=(const HeightField& other) { return *this = HeightField(other); }

std::uint64_t HeightField::beyond_wall(int tile, int row_in_tile) const {
  if (shape() == BedShape::rectangle) return 0;
  const CellRange cells = tile_cells(tile);
  const ColumnRange sand = sand_cols(cells.row_begin + row_in_tile);
  const auto first_cells = [&](int end) {  // the row's, up to a column of the bed
    const int count = std::clamp(end - cells.col_begin, 0, tile_side);
    return count == tile_side ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
  };
  return ~(first_cells(sand.end) & ~first_cells(sand.begin));
}

HeightField HeightField::untouched_bed() const {
  return HeightField(rows(), cols(), cell_size(), untouched_, shape());
}

void HeightField::lie_on(std::shared_ptr<const Ground> ground) {
  ground_ = std::move(ground);
  if (!ground_) return;
  std::array<double, tile_area> floor, heights;
  const double level = ground_->level();
  for (int tile = 0; tile < tile_count(); ++tile) {
    if (ground_->floor.slot_of(tile) < 0) {  // most tiles of a huge bed need no look at their cells
      if (level == -std::numeric_limits<double>::infinity()) continue;
      const std::optional<double> sand =
          slot_of(tile) < 0 ? untouched_->level(*this, tile_cells(tile)) : std::nullopt;
      if (sand && *sand >= level) continue;
    }
    ground_->floor.read_tile(tile, floor.data());
    read_tile(tile, heights.data());
    const CellRange cells = tile_cells(tile);
    int slot = slot_of(tile);
    for (int row = 0; row < cells.rows(); ++row)
      for (int col = 0; col < cells.cols(); ++col) {
        const int at = row * tile_side + col;
        if (heights[at] >= floor[at]) continue;
        if (slot < 0) slot = allocate(tile);
        tile_heights(slot)[at] = floor[at];
        mark_disturbed(slot, row, std::uint64_t{1} << col);
      }
  }
}

double HeightField::floor(int row, int col) const {
  return ground_ ? ground_->floor(row, col) : -std::numeric_limits<double>::infinity();
}

int HeightField::make_tile(int tile) {
  Tile& made = tiles_.emplace_back().write();  // zeros, outside the bed too
  made.index = tile;
  made.revision = new_tile_revision;
  untouched_->fill(*this, tile_cells(tile), made.heights.data(), tile_side);
  for (int row = 0; row < tile_side; ++row) made.walls[row] = beyond_wall(tile, row);
  slots_.get()[tile] = static_cast<std::uint32_t>(tiles_.size());
  return allocated_tiles() - 1;
}

void HeightField::allocate_around(int tile) {
  for (int row_step = -1; row_step <= 1; ++row_step)
    for (int col_step = -1; col_step <= 1; ++col_step)
      if (const int beside = tile_beside(tile, row_step, col_step); beside >= 0) allocate(beside);
}

double HeightField::height_at(double x, double y) const {
  const double row = std::round(row_at(y)), col = std::round(col_at(x));
  const bool inside = row >= 0.0 && row < rows() && col >= 0.0 && col < cols();
  return inside ? (*this)(static_cast<int>(row), static_cast<int>(col))
                : std::numeric_limits<double>::quiet_NaN();
}

void HeightField::clear_disturbed() {
  for (const int slot : disturbed_) {
    Tile& tile = tiles_[slot].write();
    tile.disturbed = {};
    tile.listed = false;
  }
  disturbed_.clear();
}

void HeightField::set_tool_walls(const std::vector<RowCells>& cells) {
  // Marks the cells of `rows` that are no walls as disturbed: the new walls before the change, the old ones
  // after it.
  const auto disturb_free = [this](const std::vector<RowCells>& rows) {
    for (const RowCells& row : rows)
      if (const std::uint64_t free = row.cells & ~tiles_[row.slot]->walls[row.row_in_tile])
        mark_disturbed(row.slot, row.row_in_tile, free);
  };
  disturb_free(cells);
  for (const RowCells& row : tool_walls_)
    tiles_[row.slot].write().walls[row.row_in_tile] = beyond_wall(tile_of(row.slot), row.row_in_tile);
  for (const RowCells& row : cells) tiles_[row.slot].write().walls[row.row_in_tile] |= row.cells;
  disturb_free(tool_walls_);
  tool_walls_ = cells;
}

void HeightField::read_cells(const CellRange& cells, double* out, std::ptrdiff_t stride) const {
  for (int i = cells.row_begin / tile_side; i * tile_side < cells.row_end; ++i)
    for (int j = cells.col_begin / tile_side; j * tile_side < cells.col_end; ++j) {
      const int tile = tile_index(i, j), slot = slot_of(tile);
      const CellRange part = common(tile_cells(tile), cells);
      double* to = out + (part.row_begin - cells.row_begin) * stride + (part.col_begin - cells.col_begin);
      if (slot < 0) {
        untouched_->fill(*this, part, to, stride);
        continue;
      }
      for (int row = part.row_begin; row < part.row_end; ++row, to += stride)
        std::copy_n(tile_heights(slot) + in_tile(row, part.col_begin), part.cols(), to);
    }
}

HeightGrid HeightField::grid() const {
  HeightGrid heights(rows(), cols());
  for (int tile = 0; tile < tile_count(); ++tile) {
    const CellRange cells = tile_cells(tile);
    read_tile(tile, &heights(cells.row_begin, cells.col_begin), cols());
  }
  return heights;
}

double HeightField::volume() const {
  CompensatedSum sum;
  std::array<double, tile_area> block;
  const auto add_block = [&](const CellRange& cells, double sign) {
    for (int row = 0; row < cells.rows(); ++row)
      for (int col = 0; col < cells.cols(); ++col) sum.add(sign * block[row * tile_side + col]);
  };
  // First the volume that the rule gives ...
  visit_quarters({0, tile_rows(), 0, tile_cols()}, [&](const CellRange& tiles) {
    const CellRange cells = cells_of_tiles(tiles);
    if (const std::optional<double> height = untouched_->level(*this, cells)) {
      sum.add(*height * (static_cast<double>(cells.rows()) * cells.cols()));
      return false;
    }
    if (tiles.rows() == 1 && tiles.cols() == 1) {
      untouched_->fill(*this, cells, block.data(), tile_side);
      add_block(cells, 1.0);
    }
    return true;
  });
  // ... then the difference that the allocated tiles make.
  for (int slot = 0; slot < allocated_tiles(); ++slot) {
    const CellRange cells = tile_cells(tile_of(slot));
    untouched_->fill(*this, cells, block.data(), tile_side);
    add_block(cells, -1.0);
    read_tile(tile_of(slot), block.data());
    add_block(cells, 1.0);
  }
  return sum.value() * cell_area();
}

double HeightField::highest() const {
  double highest =
      allocated_tiles() < tile_count() ? untouched_->highest() : -std::numeric_limits<double>::infinity();
  for (int slot = 0; slot < allocated_tiles(); ++slot) {
    const CellRange cells = tile_cells(tile_of(slot));
    for (int row = 0; row < cells.rows(); ++row)
      for (int col = 0; col < cells.cols(); ++col)
        highest = std::max(highest, tile_heights(slot)[row * tile_side + col]);
  }
  return highest;
}

std::vector<double> HeightField::some_untouched() const {
  constexpr int places = 16;  // along an axis
  std::vector<double> heights;
  for (int i = 0; i < places; ++i)
    for (int j = 0; j < places; ++j)
      heights.push_back(
          untouched_->height(*this, (rows() - 1) * i / (places - 1), (cols() - 1) * j / (places - 1)));
  return heights;
}

void HeightField::visit_state(StateVisitor& state) {
  state.same("bed.rows", rows());
  state.same("bed.cols", cols());
  std::uint64_t tiles = tiles_.size();
  state.value("bed.tiles", tiles);
  if (tiles < static_cast<std::uint64_t>(tile_count())) state.same("bed.surface", some_untouched());
  if (state.restores()) {
    std::fill_n(slots_.get(), tile_count(), 0);
    tiles_.clear();
  }
  for (std::uint64_t slot = 0; slot < tiles; ++slot) {
    if (!state.restores()) {
      Tile tile = *tiles_[slot];
      state.value("bed.tile", tile);
      continue;
    }
    Tile& tile = tiles_.emplace_back().write();
    state.value("bed.tile", tile);
    if (tile.index < 0 || tile.index >= tile_count() || slot_of(tile.index) >= 0)
      throw_input_error("the state is of another bed: it has a tile {}", tile.index);
    slots_.get()[tile.index] = static_cast<std::uint32_t>(slot) + 1;
  }
  if (ground_) state.same("bed.ground", content_hash(*ground_));
  state.list("bed.disturbed", disturbed_);
  state.list("bed.tool_walls", tool_walls_);
}

std::string content_hash(const HeightField& bed) {
  ContentHash hash;
  const std::vector<double> untouched = bed.some_untouched();
  hash.add(untouched.data(), untouched.size() * sizeof(double));
  for (int slot = 0; slot < bed.allocated_tiles(); ++slot) {
    const int tile = bed.tile_of(slot);
    hash.add(&tile, sizeof tile);
    hash.add(bed.tile_heights(slot), HeightField::tile_area * sizeof(double));
  }
  if (bed.ground()) hash.add(content_hash(*bed.ground()));
  return hash.text();
}

bool same_where_untouched(const HeightField& one, const HeightField& other) {
  if (&one.untouched() == &other.untouched()) return true;
  const std::optional<double> level = one.untouched().level(one, one.cells());
  return level && level == other.untouched().level(other, other.cells());
}

}  // namespace sandstroke
