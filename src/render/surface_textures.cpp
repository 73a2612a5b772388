#include "render/surface_textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/machine.h"
#include "core/parallel.h"
#include "sand/cell_ranges.h"

namespace sandstroke {
namespace {

constexpr int side = HeightField::tile_side;
using Texel = std::array<Eigen::half, 4>;  // slope along x and y, parts of sun and sky seen

GlObject texture_of(GLint internal_format, int cols, int rows, GLenum format, GLenum type) {
  GlObject texture = make_texture();
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexImage2D(GL_TEXTURE_2D, 0, internal_format, cols, rows, 0, format, type, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  check_gl("making a surface texture");
  return texture;
}

void bind_texture(const GlObject& texture, int unit) {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D, texture);
}

/// Central differences, smoothed across (Sobel); at the border, of the cells that there are.
Eigen::Vector2f slope_at(const DrawnHeights& heights, double cell_size, int row, int col) {
  const int west = std::max(col - 1, 0), east = std::min(col + 1, static_cast<int>(heights.cols()) - 1);
  const int south = std::max(row - 1, 0), north = std::min(row + 1, static_cast<int>(heights.rows()) - 1);
  const auto smooth = [](float before, float at, float after) {
    return 0.25f * (before + 2.0f * at + after);
  };
  const auto size = static_cast<float>(cell_size);
  const auto& h = heights;
  return {(smooth(h(south, east), h(row, east), h(north, east)) -
           smooth(h(south, west), h(row, west), h(north, west))) /
              (static_cast<float>(east - west) * size),
          (smooth(h(north, west), h(north, col), h(north, east)) -
           smooth(h(south, west), h(south, col), h(south, east))) /
              (static_cast<float>(north - south) * size)};
}

/// Mean over a cell and its neighbours, so that a shadow's edge shows no steps when it is magnified.
float softened(const DrawnHeights& seen, int row, int col) {
  float sum = 0.0f, weights = 0.0f;
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, static_cast<int>(seen.rows()) - 1); ++r) {
    for (int c = std::max(col - 1, 0); c <= std::min(col + 1, static_cast<int>(seen.cols()) - 1); ++c) {
      const float weight = static_cast<float>((r == row ? 2 : 1) * (c == col ? 2 : 1));
      sum += weight * seen(r, c);
      weights += weight;
    }
  }
  return sum / weights;
}

}  // namespace

void SurfaceTextures::check_size(int rows, int cols) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (std::max(rows, cols) > largest || std::min(rows, cols) < 2)
    throw_input_error("a bed of {} x {} cells cannot be drawn; a picture can show 2 to {} cells per side",
                      cols, rows, largest);
  constexpr double bytes_per_cell = 64.0;  // measured: heights, textures, and what is drawn as doubles
  check_memory(bytes_per_cell * rows * cols, fmt::format("drawing a bed of {} x {} cells", cols, rows),
               "use fewer cells");
}

SurfaceTextures::SurfaceTextures(const BedGeometry& bed) : bed_(bed) {
  check_size(bed.rows(), bed.cols());  // before any memory is taken for it
  for (DrawnHeights* values : {&heights_, &sun_, &sky_}) values->resize(bed.rows(), bed.cols());
  height_texture_ = texture_of(GL_R32F, bed.cols(), bed.rows(), GL_RED, GL_FLOAT);
  shading_texture_ = texture_of(GL_RGBA16F, bed.cols(), bed.rows(), GL_RGBA, GL_HALF_FLOAT);
}

CellRange SurfaceTextures::patch(int tile) const {
  CellRange cells = bed_.tile_cells(tile);
  cells.row_end = std::min(cells.row_end + 1, bed_.rows());
  cells.col_end = std::min(cells.col_end + 1, bed_.cols());
  return cells;
}

void SurfaceTextures::begin_level(float height) {
  heights_.setConstant(height);
  sun_.setOnes();
  sky_.setOnes();
  level_ = lowest_ = highest_ = static_cast<double>(height);
  details_.assign(bed_.tile_count(), TileDetail{.lowest = level_, .highest = level_});
  shading_outdated_.assign(details_.size(), 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  bind_texture(height_texture_, 0);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, bed_.cols(), bed_.rows(), GL_RED, GL_FLOAT, heights_.data());
  bind_texture(shading_texture_, 0);
  const std::vector<Texel> row(static_cast<std::size_t>(bed_.cols()),
                               Texel{Eigen::half(0), Eigen::half(0), Eigen::half(1), Eigen::half(1)});
  for (int i = 0; i < bed_.rows(); ++i)
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, i, bed_.cols(), 1, GL_RGBA, GL_HALF_FLOAT, row.data());
  check_gl("uploading a level surface");
  filtered_ = shading_filtered_ = false;
}

std::vector<SurfaceTextures::ChangedTile> SurfaceTextures::take_heights(const HeightField& surface) {
  std::vector<ChangedTile> changed;
  bool finite = true;
  std::vector<double> block(BedGeometry::tile_area);
  for (int tile = 0; tile < bed_.tile_count(); ++tile) {
    const CellRange cells = bed_.tile_cells(tile);
    if (surface.slot_of(tile) < 0) {
      const std::optional<double> level = surface.untouched().level(surface, cells);
      if (level && is_level(tile, static_cast<double>(static_cast<float>(*level)))) continue;
    }
    bool differs = false;
    surface.read_tile(tile, block.data());
    const auto row_of = [&](int row) { return block.data() + side * (row - cells.row_begin); };
    for (int row = cells.row_begin; row < cells.row_end; ++row) {
      const double* heights = row_of(row);
      const float* drawn = heights_.row(row).data() + cells.col_begin;
      for (int col = 0; col < cells.cols(); ++col) {
        const auto height = static_cast<float>(heights[col]);
        differs |= height != drawn[col];
        finite &= std::isfinite(height);
      }
    }
    if (!differs) continue;
    const auto height_at = [&](int row, int col) {
      return static_cast<float>(row_of(row)[col - cells.col_begin]);
    };
    const CellRange part =
        changed_part(cells, [&](int row, int col) { return height_at(row, col) != heights_(row, col); });
    for (int row = part.row_begin; row < part.row_end; ++row)
      for (int col = part.col_begin; col < part.col_end; ++col) heights_(row, col) = height_at(row, col);
    changed.push_back({tile, part});
  }
  if (!finite) {
    filled_ = false;  // the kept heights are of no use any more
    throw_input_error(
        "a surface with heights that are not finite cannot be drawn; check the run it comes from");
  }
  return changed;
}

int SurfaceTextures::update(const HeightField& surface) {
  changes_.clear();
  if (!filled_) begin_level(static_cast<float>(surface(0, 0)));
  filled_ = true;
  const std::vector<ChangedTile> changed = take_heights(surface);
  if (changed.empty()) return 0;

  std::vector<CellRange> changed_of(details_.size());
  for (const auto& [tile, cells] : changed) {  // a tile's patch reaches into the tiles after it
    for (const int row_step : {-1, 0})
      for (const int col_step : {-1, 0})
        if (const int before = bed_.tile_beside(tile, row_step, col_step); before >= 0)
          changed_of[before] = around(changed_of[before], common(cells, patch(before)));
  }
  for (int tile = 0; tile < static_cast<int>(details_.size()); ++tile)
    if (!changed_of[tile].empty()) changes_.push_back({tile, changed_of[tile], details_[tile]});
  parallel_for(changes_.size(), [&](std::size_t i) {
    details_[changes_[i].tile] = tile_detail(heights_, patch(changes_[i].tile));
  });

  const double highest_before = highest_;
  lowest_ = 1e300;
  highest_ = -1e300;
  for (const TileDetail& detail : details_) {
    lowest_ = std::min(lowest_, detail.lowest);
    highest_ = std::max(highest_, detail.highest);
  }
  const double relief = std::max(highest_before, highest_) - lowest_;

  bind_texture(height_texture_, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, bed_.cols());
  for (const auto& [tile, cells] : changed) {
    glTexSubImage2D(GL_TEXTURE_2D, 0, cells.col_begin, cells.row_begin, cells.cols(), cells.rows(), GL_RED,
                    GL_FLOAT, &heights_(cells.row_begin, cells.col_begin));
    mark_shading(cells, relief);
  }
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);  // coarser levels are made when they are asked for
  check_gl("uploading heights");
  filtered_ = false;
  return static_cast<int>(changed.size());
}

/// Marks the tiles whose shading these cells can change: tiles that their shadow may reach, and their
/// neighbourhood.
void SurfaceTextures::mark_shading(const CellRange& cells, double relief) {
  const int reach = shadow_reach(sun_used_, relief, bed_.cell_size()) + 1;
  const Eigen::Vector2d towards = sun_used_.direction().head<2>().normalized();
  const auto shift = [&](double part) {
    return static_cast<int>(std::lround(std::min(1e6, reach * std::abs(part))));
  };
  const int col_low = cells.col_begin - sky_reach - (towards.x() > 0.0 ? shift(towards.x()) : 0);
  const int col_high = cells.col_end + sky_reach + (towards.x() < 0.0 ? shift(towards.x()) : 0);
  const int row_low = cells.row_begin - sky_reach - (towards.y() > 0.0 ? shift(towards.y()) : 0);
  const int row_high = cells.row_end + sky_reach + (towards.y() < 0.0 ? shift(towards.y()) : 0);
  for (int r = std::max(0, row_low) / side; r <= std::min(row_high, bed_.rows() - 1) / side; ++r)
    for (int c = std::max(0, col_low) / side; c <= std::min(col_high, bed_.cols() - 1) / side; ++c)
      shading_outdated_[bed_.tile_index(r, c)] = 1;
}

bool SurfaceTextures::is_level(int tile, double height) const {
  return details_[tile].lowest == height && details_[tile].highest == height;
}

void SurfaceTextures::mark_uneven() {
  for (int tile = 0; tile < bed_.tile_count(); ++tile)
    if (!is_level(tile, level_)) mark_shading(patch(tile), highest_ - lowest_);
}

void SurfaceTextures::update_shading(const Sun& sun) {
  shaded_ = {};
  if (!(sun == sun_used_)) {
    mark_uneven();  // old shadows
    sun_used_ = sun;
    mark_uneven();  // new ones
  }
  std::vector<int> outdated;
  for (int tile = 0; tile < static_cast<int>(shading_outdated_.size()); ++tile)
    if (shading_outdated_[tile]) outdated.push_back(tile);
  if (outdated.empty() && shading_filtered_) return;
  std::vector<CellRange> changed(outdated.size());
  parallel_for(outdated.size(), [&](std::size_t i) {
    const CellRange cells = bed_.tile_cells(outdated[i]);
    const auto here = [&](const DrawnHeights& values) {
      return values.block(cells.row_begin, cells.col_begin, cells.rows(), cells.cols());
    };
    const DrawnHeights sun_before = here(sun_), sky_before = here(sky_);
    sun_visibility(heights_, bed_.cell_size(), sun, highest_, cells, sun_);
    sky_visibility(heights_, bed_.cell_size(), cells, sky_);
    changed[i] = changed_part(cells, [&](int row, int col) {
      const int r = row - cells.row_begin, c = col - cells.col_begin;
      return sun_(row, col) != sun_before(r, c) || sky_(row, col) != sky_before(r, c);
    });
  });
  upload_shading(outdated);
  for (const CellRange& cells : changed) shaded_ = around(shaded_, cells);
  for (const Change& change : changes_) shaded_ = around(shaded_, change.cells);
  if (!shaded_.empty()) shaded_ = common(grown(shaded_, 1), bed_.cells());  // slopes and softened()
}

void SurfaceTextures::upload_shading(const std::vector<int>& tiles) {
  bind_texture(shading_texture_, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  std::vector<Texel> texels(static_cast<std::size_t>(side) * side);
  for (const int tile : tiles) {
    const CellRange cells = bed_.tile_cells(tile);
    std::size_t i = 0;
    for (int row = cells.row_begin; row < cells.row_end; ++row) {
      for (int col = cells.col_begin; col < cells.col_end; ++col) {
        const Eigen::Vector2f slope = slope_at(heights_, bed_.cell_size(), row, col);
        texels[i++] = {Eigen::half(slope.x()), Eigen::half(slope.y()), Eigen::half(softened(sun_, row, col)),
                       Eigen::half(softened(sky_, row, col))};
      }
    }
    glTexSubImage2D(GL_TEXTURE_2D, 0, cells.col_begin, cells.row_begin, cells.cols(), cells.rows(), GL_RGBA,
                    GL_HALF_FLOAT, texels.data());
    shading_outdated_[tile] = 0;
  }
  glGenerateMipmap(GL_TEXTURE_2D);
  shading_filtered_ = true;
  check_gl("uploading shading");
}

void SurfaceTextures::bind_heights(int unit) const { bind_texture(height_texture_, unit); }

void SurfaceTextures::bind_filtered_heights(int unit) {
  bind_texture(height_texture_, unit);
  if (filtered_) return;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 1000);
  glGenerateMipmap(GL_TEXTURE_2D);
  filtered_ = true;
}

void SurfaceTextures::bind_shading(int unit) const { bind_texture(shading_texture_, unit); }

}  // namespace sandstroke
