#include "haptics/gap_threshold.h"

#include <algorithm>
#include <cmath>

#include "core/median.h"

namespace sandstroke {

double usual_gap_threshold(const Stroke& stroke) {
  std::vector<double> spacings;
  for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
    const bool lifts = i < stroke.contact.size() && stroke.contact[i] == pen_lifts;
    const double spacing = stroke.time[i + 1] - stroke.time[i];
    if (!lifts && std::isfinite(spacing)) spacings.push_back(spacing);
  }
  return std::max(least_gap, spacings_of_a_gap * median(std::move(spacings)));
}

}  // namespace sandstroke
