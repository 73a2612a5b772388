#include "pages/difference_map.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "render/colour_map.h"

namespace sandstroke {
namespace {

bool worse(double value, double kept) {
  if (!std::isfinite(kept)) return false;
  return !std::isfinite(value) || std::abs(value) > std::abs(kept);
}

}  // namespace

Spots spots_of(const HeightGrid& values, int most) {
  Spots spots;
  spots.side = (std::max(values.rows(), values.cols()) + most - 1) / most;
  spots.rows = (values.rows() + spots.side - 1) / spots.side;
  spots.cols = (values.cols() + spots.side - 1) / spots.side;
  for (Eigen::Index row = 0; row < spots.rows; ++row)
    for (Eigen::Index col = 0; col < spots.cols; ++col)
      spots.cell.push_back(row * spots.side * values.cols() + col * spots.side);
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    for (Eigen::Index col = 0; col < values.cols(); ++col) {
      Eigen::Index& kept = spots.cell[row / spots.side * spots.cols + col / spots.side];
      if (worse(values(row, col), values.data()[kept])) kept = row * values.cols() + col;
    }
  }
  return spots;
}

HeightGrid at_spots(const HeightGrid& values, const Spots& spots) {
  HeightGrid reduced(spots.rows, spots.cols);
  for (Eigen::Index i = 0; i < reduced.size(); ++i) reduced.data()[i] = values.data()[spots.cell[i]];
  return reduced;
}

double finite_magnitude(const HeightGrid& values) {
  return values.isFinite().select(values.abs(), 0.0).maxCoeff();
}

Image picture_difference_map(const Image& golden, const Image& run, int span) {
  Image map(golden.width, golden.height);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      int most = 0;
      for (int channel = 0; channel < 3; ++channel) {
        const int difference = run.pixel(x, y)[channel] - golden.pixel(x, y)[channel];
        if (std::abs(difference) > std::abs(most)) most = difference;
      }
      const Rgb rgb = as_bytes(diverging_colour(static_cast<double>(most) / span));
      std::copy(rgb.begin(), rgb.end(), map.pixel(x, y));
    }
  }
  return map;
}

}  // namespace sandstroke
