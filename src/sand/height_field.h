#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "core/shared_until_written.h"
#include "core/state_visitor.h"
#include "rules/talus.h"
#include "sand/bed_geometry.h"
#include "sand/cell_flags.h"
#include "sand/surface_rule.h"

namespace sandstroke {

struct Ground;

/// Some cells of a row of a tile: bit c is column c.
struct RowCells {
  int slot, row_in_tile;
  std::uint64_t cells;

  template <class State>
  void visit_state(State& state) {
    state.value("slot", slot);
    state.value("row_in_tile", row_in_tile);
    state.value("cells", cells);
  }
};

/// Mean cell heights [m] of a bed. A tile of cells is allocated when something touches it; until then a rule
/// gives its initial surface. So memory grows with the sand that is touched, not with the bed. Allocated
/// tiles are numbered by `slot`, in order of allocation. Each has a revision that changes when one of its
/// cells does.
class HeightField : public BedGeometry {
 public:
  /// A flat bed at z = 0. cell_size [m] > 0. Cells beyond the shape's wall neither give nor take sand.
  HeightField(int rows, int cols, double cell_size, BedShape shape = BedShape::rectangle);
  /// A bed that follows a rule.
  HeightField(int rows, int cols, double cell_size, std::shared_ptr<const SurfaceRule> untouched,
              BedShape shape = BedShape::rectangle);
  /// A bed with these heights. All tiles are allocated.
  HeightField(const HeightGrid& heights, double cell_size, BedShape shape = BedShape::rectangle);
  /// Copies share tiles until one of them writes there.
  HeightField(const HeightField& other);
  HeightField& operator=(const HeightField& other);
  HeightField(HeightField&&) = default;
  HeightField& operator=(HeightField&&) = default;

  double operator()(int row, int col) const {
    const int slot = slot_of(tile_index(row / tile_side, col / tile_side));
    return slot < 0 ? untouched_->height(*this, row, col) : tiles_[slot]->heights[in_tile(row, col)];
  }
  /// Height of the cell at a position [m]; NaN outside the bed.
  double height_at(double x, double y) const;
  /// Sets one cell. The next relaxation looks there.
  void set(int row, int col, double height) {
    const int slot = allocate(tile_index(row / tile_side, col / tile_side));
    tiles_[slot].write().heights[in_tile(row, col)] = height;
    mark_disturbed(slot, row % tile_side, std::uint64_t{1} << (col % tile_side));
  }

  /// Sets a rectangle of cells that begins at this row and column.
  void set_block(int first_row, int first_col, const HeightGrid& heights) {
    for (int row = 0; row < heights.rows(); ++row)
      for (int col = 0; col < heights.cols(); ++col) set(first_row + row, first_col + col, heights(row, col));
  }

  /// Sets the cells whose height differs: those it does not change stay undisturbed.
  void set_changed(const HeightGrid& heights) {
    for (int row = 0; row < rows(); ++row)
      for (int col = 0; col < cols(); ++col)
        if ((*this)(row, col) != heights(row, col)) set(row, col, heights(row, col));
  }

  const SurfaceRule& untouched() const { return *untouched_; }

  /// Lays the bed on a ground (sand/ground.h) of the same cells. Sand below its floor is lifted onto it, so
  /// that these cells are bare.
  void lie_on(std::shared_ptr<const Ground> ground);
  /// Swaps the ground for one whose floor is nowhere above the sand.
  void exchange_ground(std::shared_ptr<const Ground>& other) { ground_.swap(other); }
  /// Null: none, the sand is as deep as may be, and of one kind.
  const Ground* ground() const { return ground_.get(); }
  const std::shared_ptr<const Ground>& shared_ground() const { return ground_; }
  /// The floor under a cell [m]; -infinity where there is none.
  double floor(int row, int col) const;
  /// The same bed with no tile allocated: the rule gives all heights.
  HeightField untouched_bed() const;

  // --- allocated tiles ---
  int allocated_tiles() const { return static_cast<int>(tiles_.size()); }
  /// The slot of a tile (by its index); -1 while it is not allocated.
  int slot_of(int tile) const { return static_cast<int>(slots_.get()[tile]) - 1; }
  int tile_of(int slot) const { return tiles_[slot]->index; }
  /// Allocates a tile, with the rule's heights, unless it is allocated already. Returns its slot.
  int allocate(int tile) {
    const int slot = slot_of(tile);
    return slot >= 0 ? slot : make_tile(tile);
  }
  /// Allocates a tile and those beside it.
  void allocate_around(int tile);
  /// tile_side x tile_side heights, row-major, on a 64-byte boundary; those outside the bed are unused.
  const double* tile_heights(int slot) const { return tiles_[slot]->heights.data(); }
  /// The same, for writing. Then call mark_changed, or mark_disturbed if the next relaxation must look there.
  double* tile_heights(int slot) { return tiles_[slot].write().heights.data(); }
  void mark_changed(int slot) { ++tiles_[slot].write().revision; }
  void mark_disturbed(int slot, int row_in_tile, std::uint64_t cells) {
    Tile& tile = tiles_[slot].write();
    ++tile.revision;
    tile.disturbed[row_in_tile] |= cells;
    if (tile.listed) return;
    tile.listed = true;
    disturbed_.push_back(slot);
  }

  /// Slots of the tiles, and their cells, that were set since clear_disturbed().
  const std::vector<int>& disturbed_tiles() const { return disturbed_; }
  const CellFlags& disturbed_cells(int slot) const { return tiles_[slot]->disturbed; }
  void clear_disturbed();

  /// Marks the cells under a solid tool as walls, until the next call. The bed's own wall stays. The next
  /// relaxation looks at the cells that became walls or ceased to be walls.
  void set_tool_walls(const std::vector<RowCells>& cells);
  /// The cells of the last set_tool_walls().
  const std::vector<RowCells>& tool_walls() const { return tool_walls_; }
  /// All walls in a tile.
  const CellFlags& walls(int slot) const { return tiles_[slot]->walls; }
  bool is_wall(int row, int col) const {
    const int slot = slot_of(tile_index(row / tile_side, col / tile_side));
    return slot < 0 ? !has_sand(row, col) : (walls(slot)[row % tile_side] >> (col % tile_side) & 1) != 0;
  }

  /// The revision of a tile (by index): it changes whenever a cell of the tile may have changed. It is 0
  /// while the tile is not allocated, and new_tile_revision while it still has the rule's heights.
  static constexpr std::uint64_t new_tile_revision = 1;
  std::uint64_t tile_revision(int tile) const {
    const int slot = slot_of(tile);
    return slot < 0 ? 0 : tiles_[slot]->revision;
  }
  /// Copies a tile (by index), allocated or not, to `out`, rows `stride` apart. Leaves out cells outside the
  /// bed.
  void read_tile(int tile, double* out, std::ptrdiff_t stride = tile_side) const {
    read_cells(tile_cells(tile), out, stride);
  }
  /// The same of a rectangle of cells inside the bed.
  void read_cells(const CellRange& cells, double* out, std::ptrdiff_t stride) const;

  /// All that later changes depend on, but for the rule. Error: input, of another bed's state, and if the
  /// rule is another one.
  void visit_state(StateVisitor& state);

  /// Heights [m] of some cells by the rule, which tell it from other ones.
  std::vector<double> some_untouched() const;
  HeightGrid grid() const;
  /// sum(h) dx^2 [m^3], compensated. Tiles that are not allocated cost nothing where they are level.
  double volume() const;
  /// Upper bound of all heights [m]: exact for allocated tiles, the rule's bound for others.
  double highest() const;

  /// Heap memory of the allocated tiles [bytes].
  std::size_t bytes() const { return tiles_.size() * sizeof(Tile); }
  static constexpr std::size_t bytes_per_tile() { return sizeof(Tile); }

 private:
  struct alignas(64) Tile {
    std::array<double, tile_area> heights;
    CellFlags disturbed;
    CellFlags walls;
    std::uint64_t revision;
    int index;
    bool listed;  // in disturbed_

    template <class State>
    void visit_state(State& state) {
      state.value("heights", heights);
      state.value("disturbed", disturbed);
      state.value("walls", walls);
      state.value("revision", revision);
      state.value("index", index);
      state.value("listed", listed);
    }
  };
  struct Free {
    void operator()(std::uint32_t* memory) const { std::free(memory); }
  };

  static std::size_t in_tile(int row, int col) {
    const auto r = static_cast<unsigned>(row), c = static_cast<unsigned>(col);
    return (r % tile_side) * tile_side + c % tile_side;
  }
  int make_tile(int tile);
  /// The cells of a tile's row that lie beyond the bed's wall.
  std::uint64_t beyond_wall(int tile, int row_in_tile) const;

  std::shared_ptr<const SurfaceRule> untouched_;
  // Per tile of the bed: slot + 1, or 0. From calloc, so that untouched pages of a huge bed take no memory.
  std::unique_ptr<std::uint32_t, Free> slots_;
  std::vector<SharedUntilWritten<Tile>> tiles_;
  std::vector<int> disturbed_;
  std::vector<RowCells> tool_walls_;
  std::shared_ptr<const Ground> ground_;
};

/// The hash of all heights: of allocated tiles, and of some cells that the rule gives.
std::string content_hash(const HeightField& bed);

/// Whether two beds of one shape are known to have the same heights where neither has an allocated tile.
bool same_where_untouched(const HeightField& one, const HeightField& other);

/// Calls visit(row, col, height in one, height in other) [m] for every cell of every tile in which two beds
/// of one shape may differ.
template <class Visit>
void visit_cells_of_both(const HeightField& one, const HeightField& other, const Visit& visit) {
  const bool skip_untouched = same_where_untouched(one, other);
  std::vector<double> a(HeightField::tile_area), b(HeightField::tile_area);
  for (int tile = 0; tile < one.tile_count(); ++tile) {
    if (skip_untouched && one.slot_of(tile) < 0 && other.slot_of(tile) < 0) continue;
    one.read_tile(tile, a.data());
    other.read_tile(tile, b.data());
    const CellRange cells = one.tile_cells(tile);
    for (int row = 0; row < cells.rows(); ++row)
      for (int col = 0; col < cells.cols(); ++col) {
        const int at = row * HeightField::tile_side + col;
        visit(cells.row_begin + row, cells.col_begin + col, a[at], b[at]);
      }
  }
}

}  // namespace sandstroke
