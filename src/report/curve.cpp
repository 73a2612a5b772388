#include "report/curve.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sandstroke {

Curve thinned_curve(const Curve& curve, std::size_t most) {
  const std::size_t points = curve.value.size();
  if (points <= most) return curve;
  Curve kept;
  const std::size_t stretches = std::max<std::size_t>(1, most / 2);
  for (std::size_t k = 0; k < stretches; ++k) {
    const std::size_t begin = k * points / stretches, end = (k + 1) * points / stretches;
    std::optional<std::size_t> least, greatest, gap;
    for (std::size_t i = begin; i < end; ++i) {
      const double value = curve.value[i];
      if (!std::isfinite(value)) {
        if (!gap) gap = i;
        continue;
      }
      if (!least || value < curve.value[*least]) least = i;
      if (!greatest || value > curve.value[*greatest]) greatest = i;
    }
    std::vector<std::size_t> chosen;
    for (const std::optional<std::size_t>& one : {least, greatest, gap})
      if (one) chosen.push_back(*one);
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    for (const std::size_t i : chosen) kept.add(curve.at[i], curve.value[i]);
  }
  return kept;
}

nlohmann::ordered_json curve_json(const Curve& curve) {
  Curve thinned = thinned_curve(curve, most_points);
  return {{"at", std::move(thinned.at)}, {"value", std::move(thinned.value)}};
}

}  // namespace sandstroke
