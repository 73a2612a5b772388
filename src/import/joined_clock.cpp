#include "import/joined_clock.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/error.h"
#include "import/column_name.h"
#include "import/missing_samples.h"
#include "import/table_option.h"
#include "import/units.h"

namespace sandstroke {
namespace {

constexpr std::int64_t ns_per_second = 1'000'000'000;

}  // namespace

void join_clock(SampleTable& table, const TableLayout& layout, const std::string& name) {
  const std::optional<std::size_t>& time = layout.time ? layout.time : layout.replaced_time;
  if (!time || !layout.time_fraction || table.columns[*time].unit == iso_unit) return;
  SampleColumn& seconds = table.columns[*time];
  SampleColumn& fractions = table.columns[*layout.time_fraction];
  std::string unit = fractions.unit;
  if (unit.empty()) unit = column_name(fractions.name).unit;
  const double per_second = known_unit(Quantity::time, unit).value_or(Unit()).divisor;
  const auto known = [&](std::size_t i) {
    return std::isfinite(seconds.values[i]) && std::isfinite(fractions.values[i]);
  };
  const std::size_t size = std::min(seconds.values.size(), fractions.values.size());
  if (std::any_of(seconds.values.begin(), seconds.values.end(), has_fraction)) return;
  for (std::size_t i = 0; i < size; ++i) {
    const double fraction = fractions.values[i];
    if (!known(i) || (!has_fraction(fraction) && fraction >= 0.0 && fraction < per_second)) continue;
    if (!layout.time) return;  // nobody needs it
    throw_input_error(
        "{}: column '{}' is taken for the {} of the whole seconds in '{}', but {:.17g} is not between 0 and "
        "{:g}; name the one column of the time with {}",
        sample_location(name, table.lines, i), fractions.name, unit, seconds.name, fraction, per_second - 1.0,
        option_and_key("time"));
  }
  constexpr double most_seconds = 9e9;  // 64 bits hold their ns
  const std::int64_t origin = seconds.origin.value_or(0),
                     per = ns_per_second / static_cast<std::int64_t>(per_second);
  std::optional<std::int64_t> first;
  for (std::size_t i = 0; i < size; ++i) {
    const bool fits = known(i) && std::abs(seconds.values[i] + static_cast<double>(origin)) < most_seconds;
    if (!fits) {
      seconds.values[i] = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    const std::int64_t stamp = (static_cast<std::int64_t>(seconds.values[i]) + origin) * ns_per_second +
                               static_cast<std::int64_t>(fractions.values[i]) * per;
    if (!first) first = stamp;
    seconds.values[i] = static_cast<double>(stamp - *first);
  }
  seconds.origin = first;
  seconds.unit = joined_unit;
  if (layout.time)
    table.description +=
        fmt::format("{}one clock of {} (whole seconds) and {} ({})", table.description.empty() ? "" : "; ",
                    seconds.name, fractions.name, unit);
  fractions.values.clear();
}

}  // namespace sandstroke
