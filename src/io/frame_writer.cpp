#include "io/frame_writer.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>

namespace sandstroke {
namespace {

constexpr int tile_side = BedGeometry::tile_side;
constexpr const char *time_name = "/surface/time", *initial = "/surface/initial",
                     *all_frames = "/surface/frames";

/// Tiles, in order, as rectangles of cells: tiles in a row are joined, then equal joins below each other.
std::vector<CellRange> rectangles(const BedGeometry& bed, const std::vector<int>& tiles) {
  std::vector<CellRange> runs;  // of tiles
  for (const int tile : tiles) {
    const int row = tile / bed.tile_cols(), col = tile % bed.tile_cols();
    if (!runs.empty() && runs.back().row_begin == row && runs.back().col_end == col)
      ++runs.back().col_end;
    else
      runs.push_back({row, row + 1, col, col + 1});
  }
  std::vector<CellRange> joined;
  for (const CellRange& run : runs) {
    const auto above = std::find_if(joined.begin(), joined.end(), [&](const CellRange& other) {
      return other.row_end == run.row_begin && other.col_begin == run.col_begin &&
             other.col_end == run.col_end;
    });
    if (above != joined.end())
      ++above->row_end;
    else
      joined.push_back(run);
  }
  for (CellRange& tile_range : joined) tile_range = bed.cells_of_tiles(tile_range);
  return joined;
}

std::string frame(int k) { return fmt::format("/surface/frame/{:06}", k); }

}  // namespace

std::string FrameWriter::changed(int k) { return frame(k) + "/changed"; }
std::string FrameWriter::height(int k) { return frame(k) + "/height"; }

FrameWriter::FrameWriter(Hdf5GridWriter& file, const HeightField& bed) : file_(file), bed_(bed) {
  for (int slot = 0; slot < bed.allocated_tiles(); ++slot)
    revisions_.push_back(bed.tile_revision(bed.tile_of(slot)));
}

std::vector<int> FrameWriter::take_changed(const HeightField& surface) {
  revisions_.resize(surface.allocated_tiles(), HeightField::new_tile_revision);
  std::vector<int> tiles;
  for (int slot = 0; slot < surface.allocated_tiles(); ++slot) {
    const int tile = surface.tile_of(slot);
    if (surface.tile_revision(tile) == revisions_[slot]) continue;
    revisions_[slot] = surface.tile_revision(tile);
    tiles.push_back(tile);
  }
  std::sort(tiles.begin(), tiles.end());
  return tiles;
}

std::vector<Hdf5GridWriter::Patch> FrameWriter::patches() const {
  std::map<int, std::vector<int>> tiles_of;  // by the frame of their last change
  for (const auto& [tile, frame] : last_change_) tiles_of[frame].push_back(tile);
  std::vector<Hdf5GridWriter::Patch> patches;
  for (const auto& [frame, tiles] : tiles_of) patches.push_back({changed(frame), rectangles(bed_, tiles)});
  return patches;
}

void FrameWriter::add(double time, const HeightField& surface) {
  if (times_.empty()) {
    time_ = file_.column(time_name);
    file_.describe(time_name, "s", "time of a frame");
    file_.make_scale(time_name);
  }
  const auto k = static_cast<int>(times_.size());
  Hdf5Chunks chunks = file_.chunks(changed(k), {bed_.rows(), bed_.cols()}, {tile_side, tile_side},
                                   std::numeric_limits<double>::quiet_NaN());
  std::vector<double> chunk(chunks.size());
  const std::vector<int> tiles = take_changed(surface);
  for (const int tile : tiles) {
    surface.read_tile(tile, chunk.data(), static_cast<std::ptrdiff_t>(chunks.cols()));
    const CellRange cells = bed_.tile_cells(tile);
    chunks.write(cells.row_begin, cells.col_begin, chunk.data());
    last_change_[tile] = k;
  }
  file_.write_patched(height(k), static_cast<std::size_t>(bed_.rows()), static_cast<std::size_t>(bed_.cols()),
                      tiles.empty() ? shown_ : initial,
                      tiles.empty() ? std::vector<Hdf5GridWriter::Patch>{} : patches());
  if (!tiles.empty()) shown_ = height(k);
  time_.append(&time, 1);
  times_.push_back(time);
}

void FrameWriter::finish() {
  if (times_.empty()) return;
  std::vector<Hdf5GridWriter::Block> blocks;
  for (std::size_t k = 0; k < times_.size(); ++k) blocks.push_back({k, ".", height(static_cast<int>(k))});
  file_.write_virtual(all_frames, {blocks.size()}, static_cast<std::size_t>(bed_.rows()),
                      static_cast<std::size_t>(bed_.cols()), blocks);
  file_.attach_scales(all_frames, {time_name, "/surface/y", "/surface/x"});
  file_.describe(all_frames, "m", "height of the sand over time");
}

void FrameWriter::visit_state(StateVisitor& state) {
  std::vector<int> tiles, frames;  // of last_change_
  for (const auto& [tile, k] : last_change_) {
    tiles.push_back(tile);
    frames.push_back(k);
  }
  state.list("frames.revisions", revisions_);
  state.list("frames.changed_tiles", tiles);
  state.list("frames.last_changes", frames);
  state.list("frames.times", times_);
  state.value("frames.shown", shown_);
  if (!state.restores()) return;
  last_change_.clear();
  for (std::size_t i = 0; i < tiles.size(); ++i) last_change_[tiles[i]] = frames.at(i);
  file_.remove(all_frames, {time_name, "/surface/y", "/surface/x"});
  for (auto k = static_cast<int>(times_.size()); file_.has(frame(k)); ++k) file_.remove(frame(k));
  if (times_.empty())
    file_.remove(time_name);
  else
    time_ = file_.shortened(time_name, times_.size());
}

std::vector<XdmfStep> FrameWriter::steps(double end) const {
  std::vector<XdmfStep> steps = {{0.0, initial}};
  for (std::size_t k = 0; k < times_.size(); ++k)  // a frame at time 0 is the initial surface
    if (times_[k] > 0.0) steps.push_back({times_[k], height(static_cast<int>(k))});
  constexpr double after = 1.0;  // s; without a stroke the end is at time 0, too, but must be another step
  steps.push_back({end > steps.back().time ? end : steps.back().time + after, "/surface/final"});
  return steps;
}

}  // namespace sandstroke
