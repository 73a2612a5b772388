#include "render/round_scale.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace sandstroke {

double round_interval(double range, int most) {
  const double least = range / most;
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  constexpr double slack = 1e-9;  // 0.3 / 3 is not exactly 0.1
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * decade >= least * (1.0 - slack)) return factor * decade;
  return 10.0 * decade;
}

LengthUnit length_unit(double magnitude) {
  if (magnitude >= 1.0) return {"m", 1.0};
  if (magnitude >= 1e-3) return {"mm", 1e-3};
  if (magnitude >= 1e-6) return {"um", 1e-6};
  return {"nm", 1e-9};
}

std::vector<ScaleTick> scale_ticks(double low, double high, const LengthUnit& unit, int most) {
  const double interval = round_interval((high - low) / unit.metres, most);
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(interval) + 1e-9)));
  std::vector<ScaleTick> ticks;
  const double first = std::ceil(low / unit.metres / interval - 1e-6);
  const double last = std::floor(high / unit.metres / interval + 1e-6);
  for (double k = first; k <= last; ++k) {
    const double number = k == 0.0 ? 0.0 : k * interval;  // no "-0"
    ticks.push_back({number * unit.metres, decimals <= 3 ? fmt::format("{:.{}f}", number, decimals)
                                                         : fmt::format("{:.6g}", number)});
  }
  return ticks;
}

}  // namespace sandstroke
