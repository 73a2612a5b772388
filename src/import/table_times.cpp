#include "import/table_times.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "import/missing_samples.h"
#include "import/redundancy.h"
#include "import/table_option.h"
#include "import/units.h"

namespace sandstroke {
namespace {

bool counts_ns(const SampleColumn& column) { return column.unit == iso_unit || column.unit == joined_unit; }

/// The unit of a column of times: as asked for, as in the file, or by a clock's digits. Empty: not known.
std::string unit_of_times(const SampleColumn& column, const std::string& asked) {
  if (counts_ns(column)) return "ns";
  if (!asked.empty()) return asked;
  if (!column.unit.empty()) return column.unit;
  const auto digits = std::to_string(column.origin.value_or(0)).size();
  if (digits < 10 || digits % 3 != 1) return "";
  // Clocks of today, since 1970.
  const std::string unit = digits == 10 ? "s" : digits == 13 ? "ms" : digits == 16 ? "us" : "ns";
  // The time since a computer started can have as many digits, in a smaller unit.
  constexpr double most_spacing = 10.0;  // s, between samples
  const std::vector<double> finite = finite_values(column);
  if (finite.empty()) return unit;
  const double span = unit_of(Quantity::time, unit).to_si(finite.back() - finite.front());
  return span > most_spacing * static_cast<double>(finite.size()) ? "" : unit;
}

/// The key that names the times of this table.
std::string own_key(const std::string& key, bool is_second) { return is_second ? "merge_" + key : key; }

void take_stamps(TableTimes& times, const SampleColumn& column, const std::string& asked,
                 const std::string& key) {
  const std::string unit = unit_of_times(column, asked);
  const std::optional<Unit> of_time = known_unit(Quantity::time, unit);
  if (!of_time) {
    times.asks.push_back(fmt::format("the unit of the times '{}' is {}; give {}: {}", column.name,
                                     unit.empty() ? "not known" : fmt::format("'{}', which is none", unit),
                                     option_and_key(key), unit_symbols(Quantity::time)));
    return;
  }
  const auto own = known_unit(Quantity::time, column.unit);
  if (own && own->to_si(1.0) != of_time->to_si(1.0))
    times.warnings.push_back(
        fmt::format("column '{}' is in {} by the file, but is read in {}, which {} says; "
                    "leave that out to use the file's unit",
                    column.name, column.unit, unit, option_and_key(key)));
  for (const double stamp : column.values)
    times.time.push_back(std::isfinite(stamp) ? of_time->to_si(stamp) : std::nan(""));
  if (column.origin) {
    const auto per_unit = static_cast<std::int64_t>(of_time->to_si(1e9));
    std::int64_t clock = 0;
    if (!__builtin_mul_overflow(*column.origin, per_unit, &clock)) times.clock = clock;
  }
  times.text = fmt::format("time {} ({})", column.name, counts_ns(column) ? column.unit : unit);
}

std::string no_times(const SampleTable& table, bool is_second) {
  if (table.line_tolerance > 0.0)
    return fmt::format("the file gives no speed; give {} in m/s", option_and_key("speed"));
  if (is_second)
    return fmt::format("the times are unknown, because no column is named time or t; give {}, or {} in Hz",
                       option_and_key("merge_time"), option_and_key("merge_rate"));
  return fmt::format(
      "the times are unknown, because no column is named time or t; give {}, {} in Hz, or {} in m/s",
      option_and_key("time"), option_and_key("rate"), option_and_key("speed"));
}

std::string disagreement_with_times(const SampleTable& table, const TableLayout& layout,
                                    const TableSettings& settings, double duration, const std::string& by,
                                    double factor) {
  if (!layout.replaced_time) return "";
  const SampleColumn& column = table.columns[*layout.replaced_time];
  return time_disagreement(column, unit_of_times(column, settings.time_unit), duration, by, factor);
}

void compare(TableTimes& times, const SampleTable& table, const TableLayout& layout,
             const TableSettings& settings, bool is_second) {
  const auto warn = [&](const std::string& sentence) {
    if (!sentence.empty()) times.warnings.push_back(sentence);
  };
  const std::string key = option_and_key(own_key("rate", is_second));
  if (settings.rate > 0.0 && !times.time.empty()) {
    const std::string by = fmt::format("{} of {} Hz", key, settings.rate);
    constexpr double most = 1.05;
    if (const std::string twice =
            disagreement_with_times(table, layout, settings, times.time.back(), by, most);
        !twice.empty())
      warn(twice + "; leave out the rate to use the column");
  }
  if (layout.sample_number && times.time.size() == table.columns[*layout.sample_number].values.size())
    warn(number_disagreement(table.columns[*layout.sample_number], times.time));
}

}  // namespace

TableTimes table_times(const SampleTable& table, const TableLayout& layout, const TableSettings& settings,
                       const std::string& name, bool is_second) {
  const bool by_column = !settings.time.empty();
  if (by_column + (settings.rate > 0.0) + (settings.speed > 0.0) > 1)
    throw_input_error("{}: the times are given twice; give only one of time, rate and speed", name);
  TableTimes times;
  if (layout.time) {
    take_stamps(times, table.columns[*layout.time], settings.time_unit, own_key("time_unit", is_second));
  } else if (settings.speed > 0.0) {
    times.text = fmt::format("{} m/s", settings.speed);
  } else if (settings.rate > 0.0) {
    for (std::size_t i = 0; i < table.size(); ++i)
      times.time.push_back(static_cast<double>(i) / settings.rate);
    times.rate = settings.rate;
    times.text = fmt::format("{} Hz", settings.rate);
  } else {
    times.asks.push_back(no_times(table, is_second));
  }
  compare(times, table, layout, settings, is_second);
  return times;
}

std::string speed_against_times(const SampleTable& table, const TableLayout& layout,
                                const TableSettings& settings, double duration) {
  const std::string by = fmt::format("{} of {} m/s", option_and_key("speed"), settings.speed);
  const std::string twice = disagreement_with_times(table, layout, settings, duration, by, 2.0);
  return twice.empty() ? "" : twice + "; leave out the speed to use the column";
}

}  // namespace sandstroke
