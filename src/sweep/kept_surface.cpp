#include "sweep/kept_surface.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "core/hash.h"
#include "hdf5/hdf5_file.h"

namespace sandstroke {
namespace {

const std::string surface = "/surface";

/// Calls visit(row, col, heights) for each part of the surface that is not all at `level`, row by row.
template <class Visit>
void visit_parts(const Hdf5Reader& file, double level, const Visit& visit) {
  file.visit_written(surface, [&](Eigen::Index row, Eigen::Index col, const HeightGrid& heights) {
    if (!(heights == level).all()) visit(row, col, heights);
  });
}

BedGeometry geometry(const Hdf5Reader& file) { return file.bed_geometry(surface, file.cell_size(surface)); }

}  // namespace

KeptSurface inspect_surface(const std::filesystem::path& point_file) {
  const Hdf5Reader file(point_file);
  KeptSurface kept{geometry(file), 0.0, "", point_file};
  const double level = file.fill_value(surface), cell_size = kept.bed.cell_size();
  if (std::isfinite(level)) kept.highest = std::abs(level);
  ContentHash hash;
  hash.add(fmt::format("{} {} ", kept.bed.rows(), kept.bed.cols()));
  hash.add(&cell_size, sizeof cell_size);
  hash.add(&level, sizeof level);
  visit_parts(file, level, [&](Eigen::Index row, Eigen::Index col, const HeightGrid& heights) {
    kept.highest = std::max(kept.highest, heights.isFinite().select(heights.abs(), 0.0).maxCoeff());
    hash.add(fmt::format("{} {} ", row, col));
    hash.add(heights.data(), static_cast<std::size_t>(heights.size()) * sizeof(double));
  });
  kept.hash = hash.text();
  return kept;
}

HeightGrid coarse_surface(const std::filesystem::path& point_file, int most) {
  const Hdf5Reader file(point_file);
  const BedGeometry bed = geometry(file);
  const Eigen::Index side = (std::max(bed.rows(), bed.cols()) + most - 1) / most;
  const double level = file.fill_value(surface);
  HeightGrid coarse =
      HeightGrid::Constant((bed.rows() + side - 1) / side, (bed.cols() + side - 1) / side, level);
  visit_parts(file, level, [&](Eigen::Index first_row, Eigen::Index first_col, const HeightGrid& heights) {
    for (Eigen::Index row = 0; row < heights.rows(); ++row)
      for (Eigen::Index col = 0; col < heights.cols(); ++col) {
        double& kept = coarse((first_row + row) / side, (first_col + col) / side);
        if (std::abs(heights(row, col) - level) > std::abs(kept - level)) kept = heights(row, col);
      }
  });
  return coarse;
}

}  // namespace sandstroke
