#include "sand/tool_path.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace sandstroke {
namespace {

/// The part [begin, end] of a way, as fractions of it.
struct Part {
  double begin = 0.0, end = 1.0;

  /// Keeps the fractions at which start + fraction * change lies between low and high.
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

TipSteps steps_between(const BedGeometry& bed, double reach, const Eigen::Vector3d& from,
                       const Eigen::Vector3d& to, double longest, double highest) {
  const Eigen::Vector3d motion = to - from;
  const double half_x = 0.5 * bed.cols() * bed.cell_size() + reach,
               half_y = 0.5 * bed.rows() * bed.cell_size() + reach;
  Part part;
  part.clip(from.x(), motion.x(), -half_x, half_x);
  part.clip(from.y(), motion.y(), -half_y, half_y);
  part.clip(from.z(), motion.z(), -std::numeric_limits<double>::infinity(), highest);
  if (!(part.begin < part.end)) return {};
  TipSteps steps{from + part.begin * motion, (part.end - part.begin) * motion, 0};
  steps.count = static_cast<std::int64_t>(std::ceil(steps.way.head<2>().norm() / longest));
  return steps;
}

}  // namespace sandstroke
