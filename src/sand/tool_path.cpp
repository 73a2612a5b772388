#include "sand/tool_path.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace sandstroke {
namespace {

/// Of the radius. A drag at 2 radii a tick then leaves the mean furrow depth of 20 times as many ticks within
/// 2.5 %, with steps of a whole radius within 9 %, without any 49 % short (both presets, 4 and 10 mm deep).
constexpr double longest_step = 0.5;

/// The part [begin, end] of a way, as shares of it.
struct Part {
  double begin = 0.0, end = 1.0;

  /// Keeps the shares at which start + share * change lies between low and high.
  void clip(double start, double change, double low, double high) {
    if (change == 0.0) {
      if (!(start >= low && start <= high)) end = -1.0;
      return;
    }
    const double a = (low - start) / change, b = (high - start) / change;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
};

}  // namespace

double displace_between(HeightField& bed, ToolFootprint& footprint, const Eigen::Vector3d& from,
                        const Eigen::Vector3d& to, const DisplacementSettings& settings,
                        std::optional<double> highest) {
  const Eigen::Vector3d motion = to - from;
  const double step = longest_step * footprint.radius();
  if (!(motion.head<2>().stableNorm() > step)) return 0.0;

  const double half_x = 0.5 * bed.cols() * bed.cell_size() + footprint.reach(),
               half_y = 0.5 * bed.rows() * bed.cell_size() + footprint.reach();
  Part part;
  part.clip(from.x(), motion.x(), -half_x, half_x);
  part.clip(from.y(), motion.y(), -half_y, half_y);
  part.clip(from.z(), motion.z(), -std::numeric_limits<double>::infinity(),
            highest ? *highest : bed.highest());
  if (!(part.begin < part.end)) return 0.0;

  const Eigen::Vector3d enters = from + part.begin * motion, way = (part.end - part.begin) * motion;
  const auto steps = static_cast<std::int64_t>(std::ceil(way.head<2>().norm() / step));
  double moved = 0.0;
  for (std::int64_t i = 1; i < steps; ++i) {
    const Eigen::Vector3d tip = enters + static_cast<double>(i) / static_cast<double>(steps) * way;
    footprint.place(bed, tip.x(), tip.y());
    if (footprint.sand_level() > tip.z()) moved += displace(bed, footprint, tip.z(), way, settings);
  }
  return moved;
}

}  // namespace sandstroke
