#include "sand/region_values.h"

#include <algorithm>
#include <cmath>

namespace sandstroke {

RegionValues::RegionValues(const std::vector<SandRegion>& regions, const ValueOf& value_of, double blend) {
  for (SandRegion region : regions) {
    const std::optional<double> value = value_of(region);
    if (!value) continue;
    region.soft = std::max(region.soft, blend);
    regions_.push_back({RegionArea(region), *value});
  }
}

double RegionValues::at(const Eigen::Vector2d& place, double own) const {
  double value = own;
  for (const Region& region : regions_) value = std::lerp(value, region.value, region.area.share(place));
  return value;
}

void RegionValues::fill(const ToolElements& elements, const Eigen::Vector2d& tip, double own,
                        double* values) const {
  const auto count = static_cast<std::size_t>(elements.count());
  std::fill_n(values, elements.size(), own);
  if (empty()) return;
  const auto [least_x, most_x] = std::minmax_element(elements.x(), elements.x() + count);
  const auto [least_y, most_y] = std::minmax_element(elements.y(), elements.y() + count);
  const Eigen::Vector2d centre = tip + 0.5 * Eigen::Vector2d(*least_x + *most_x, *least_y + *most_y);
  const double side = std::max(*most_x - *least_x, *most_y - *least_y);
  for (const Region& region : regions_) {
    const double share = region.area.whole_share(centre, side);
    if (share == 0.0) continue;
    if (share == 1.0) {
      std::fill_n(values, count, region.value);
      continue;
    }
    for (std::size_t i = 0; i < count; ++i)
      values[i] = std::lerp(values[i], region.value,
                            region.area.share(tip + Eigen::Vector2d(elements.x()[i], elements.y()[i])));
  }
}

}  // namespace sandstroke
