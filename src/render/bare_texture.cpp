#include "render/bare_texture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "sand/cell_ranges.h"

namespace sandstroke {
namespace {

constexpr float thin_sand = 0.01f;  // cells: thinner sand lets the floor shine through

GlObject texture_of_nothing(const BedGeometry& bed) {
  const std::vector<std::uint8_t> nothing(std::size_t{2} * bed.rows() * bed.cols());
  GlObject texture = make_texture();
  glBindTexture(GL_TEXTURE_2D, texture);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RG8, bed.cols(), bed.rows(), 0, GL_RG, GL_UNSIGNED_BYTE, nothing.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  check_gl("making a texture of the floor");
  return texture;
}

}  // namespace

void BareTexture::update(const HeightField& surface, const SurfaceTextures& textures, bool anew) {
  const BedGeometry& bed = textures.bed();
  if (anew || looked_at_ != surface.shared_ground()) {
    looked_at_ = surface.shared_ground();
    ground_ = has_floor(surface) ? looked_at_ : nullptr;
    texture_ = ground_ ? texture_of_nothing(bed) : GlObject();
    anew = true;
  }
  if (!ground_) return;
  const auto may_be_bare = [&](int tile) {
    return std::isfinite(ground_->level()) || ground_->has_floor_around(tile);
  };
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture_);
  if (anew) {
    for (int tile = 0; tile < bed.tile_count(); ++tile)
      if (may_be_bare(tile)) upload(bed.tile_cells(tile), textures);
    filtered_ = false;
  }
  for (const SurfaceTextures::Change& change : textures.changes()) {
    if (anew || !may_be_bare(change.tile)) continue;
    upload(common(grown(change.cells, 1), bed.cells()), textures);
    filtered_ = false;
  }
  if (!filtered_) glGenerateMipmap(GL_TEXTURE_2D);
  filtered_ = true;
  check_gl("uploading the floor");
}

void BareTexture::upload(const CellRange& cells, const SurfaceTextures& textures) {
  const BedGeometry& bed = textures.bed();
  using Parts = Eigen::Array2f;  // of stone, of the level bottom
  const CellRange near = common(grown(cells, 1), bed.cells());
  const auto level = ground_->level();
  std::vector<Parts> bare;
  bare.reserve(static_cast<std::size_t>(near.rows()) * near.cols());
  for (int row = near.row_begin; row < near.row_end; ++row)
    for (int col = near.col_begin; col < near.col_end; ++col) {
      const double floor = ground_->floor(row, col);
      const float sand = textures.heights()(row, col) - static_cast<float>(floor),
                  thick = sand / (thin_sand * static_cast<float>(bed.cell_size())),
                  part = std::clamp(1.0f - thick, 0.0f, 1.0f);
      bare.push_back(floor == level ? Parts(0.0f, part) : Parts(part, 0.0f));
    }
  std::vector<std::uint8_t> texels;
  texels.reserve(std::size_t{2} * cells.rows() * cells.cols());
  for (int row = cells.row_begin; row < cells.row_end; ++row)
    for (int col = cells.col_begin; col < cells.col_end; ++col) {
      Parts sum(0.0f, 0.0f);
      float weights = 0.0f;
      for (int r = std::max(row - 1, 0); r <= std::min(row + 1, bed.rows() - 1); ++r)
        for (int c = std::max(col - 1, 0); c <= std::min(col + 1, bed.cols() - 1); ++c) {
          const float weight = static_cast<float>((r == row ? 2 : 1) * (c == col ? 2 : 1));
          sum += weight *
                 bare[static_cast<std::size_t>(r - near.row_begin) * near.cols() + (c - near.col_begin)];
          weights += weight;
        }
      for (const float part : sum)
        texels.push_back(static_cast<std::uint8_t>(std::lround(255.0f * part / weights)));
    }
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage2D(GL_TEXTURE_2D, 0, cells.col_begin, cells.row_begin, cells.cols(), cells.rows(), GL_RG,
                  GL_UNSIGNED_BYTE, texels.data());
}

void BareTexture::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D, texture_);
}

}  // namespace sandstroke
