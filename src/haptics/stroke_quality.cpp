#include "haptics/stroke_quality.h"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/median.h"
#include "haptics/stroke_pieces.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

constexpr double widest_hand = 3.0;    // m, the widest reach of an arm
constexpr double fastest_hand = 10.0;  // m/s; a hand that draws is slower

/// How far four samples are from any parabola over time [m^2], as the square of one sample's noise.
double squared_residual(const Stroke& stroke, std::size_t first) {
  const double spacing = (stroke.time[first + 3] - stroke.time[first]) / 3.0;
  Vector3d sum = Vector3d::Zero();
  double squares = 0.0;
  for (std::size_t i = first; i < first + 4; ++i) {
    double product = 1.0;
    for (std::size_t k = first; k < first + 4; ++k)
      if (k != i) product *= (stroke.time[i] - stroke.time[k]) / spacing;
    sum += stroke.position[i] / product;
    squares += 1.0 / (product * product);
  }
  return sum.squaredNorm() / squares;
}

double noise_of(const Stroke& stroke) {
  std::vector<double> residuals;
  for (const StrokePiece& piece : joined_pieces(stroke))
    for (std::size_t i = piece.begin; i + 3 < piece.end; ++i)
      if (const double residual = squared_residual(stroke, i); std::isfinite(residual))
        residuals.push_back(residual);
  constexpr double median_of_mean = 2.365974 / 3.0;  // of squares of three normal numbers
  return std::sqrt(median(std::move(residuals)) / median_of_mean);
}

}  // namespace

StrokeQuality quality_of(const Stroke& stroke) {
  StrokeQuality quality;
  std::vector<double> spacings, speeds;
  for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
    if (!stroke.joined(i)) continue;
    spacings.push_back(stroke.time[i + 1] - stroke.time[i]);
    const double speed = (stroke.position[i + 1] - stroke.position[i]).norm() / spacings.back();
    if (speed > 0.0) speeds.push_back(speed);
    if (speed > quality.top_speed) {
      quality.top_speed = speed;
      quality.top_time = stroke.time[i];
    }
  }
  const double usual_spacing = median(spacings);
  double squares = 0.0;
  for (const double spacing : spacings) squares += (spacing - usual_spacing) * (spacing - usual_spacing);
  if (!spacings.empty()) quality.jitter = std::sqrt(squares / static_cast<double>(spacings.size()));
  quality.usual_speed = median(std::move(speeds));
  quality.repeats = repeats_of(stroke);
  quality.noise = noise_of(without_repeated_samples(stroke));
  const std::vector<Vector3d> drawn = drawn_points(stroke);
  quality.plane = plane_through(drawn);
  Eigen::AlignedBox3d extent;
  for (const Vector3d& p : drawn) extent.extend(p);
  if (!extent.isEmpty()) quality.extent = extent.sizes();
  return quality;
}

std::vector<std::string> quality_warnings(const StrokeQuality& quality) {
  std::vector<std::string> warnings;
  if (const double widest = quality.extent.maxCoeff(); widest > widest_hand)
    warnings.push_back(
        fmt::format("it is {:.4g} m wide: if its positions are not in metres, convert it with their unit, or "
                    "set stroke.scale (0.001 for millimetres) or stroke.fit = 0.8",
                    widest));
  if (quality.repeats.fraction > 0.1 && quality.repeats.period > 1)
    warnings.push_back(fmt::format(
        "{:.0f} % of its samples repeat the one before (up to {} alike): its device was read faster than it "
        "measures, and speeds look up to {} times too high; set stroke.held = \"drop\"",
        100.0 * quality.repeats.fraction, quality.repeats.period, quality.repeats.period));
  if (!(quality.top_speed > fastest_hand)) return warnings;
  if (quality.top_speed > 10.0 * quality.usual_speed)
    warnings.push_back(fmt::format(
        "it jumps at {:.4g} s at a speed of {:.4g} m/s, {:.0f} times its usual speed: if the pen was "
        "lifted there, give its pen states or a smaller gap threshold when you convert it; "
        "otherwise try stroke.held = \"drop\" or stroke.smooth",
        quality.top_time, quality.top_speed, quality.top_speed / quality.usual_speed));
  else
    warnings.push_back(
        fmt::format("it moves at up to {:.4g} m/s, usually {:.4g} m/s, faster than any hand: check the units "
                    "of its times and positions, or set stroke.speed or stroke.scale",
                    quality.top_speed, quality.usual_speed));
  return warnings;
}

}  // namespace sandstroke
