#include "compare/golden_trace.h"

#include <cmath>

#include "core/error.h"

namespace sandstroke {
namespace {

constexpr double most_steps = 0x1p50;  // so that second differences are exact
constexpr double in_contact = 1.0, lifted = 2.0;

/// The rows before differences are taken.
HeightGrid whole_numbers(const std::vector<TickRecord>& trace, double servo_rate, const std::string& name) {
  HeightGrid table(packed_trace_rows, static_cast<Eigen::Index>(trace.size()));
  double level = 0.0;
  Eigen::Index k = 0;
  for (const TickRecord& tick : trace) {
    const bool is_lifted = std::isnan(tick.level) && !tick.contact;
    if (!is_lifted) level = std::round(tick.level / trace_height_quantum);
    auto column = table.col(k++);
    column << std::round(tick.time * servo_rate), (tick.device_force.array() / trace_force_quantum).round(),
        level, level - std::round(tick.depth / trace_height_quantum),
        is_lifted ? lifted : tick.contact * in_contact;
    if (!(column.abs() <= most_steps).all())
      throw_input_error(
          "{}: a force, depth or level at time {} s is not finite or too large; this run cannot become "
          "golden",
          name, tick.time);
    if (column[0] / servo_rate != tick.time)
      throw_input_error(
          "{}: time {} s is not a whole multiple of the servo period; this run cannot become golden", name,
          tick.time);
  }
  return table;
}

}  // namespace

HeightGrid packed_trace(const std::vector<TickRecord>& trace, double servo_rate, const std::string& name) {
  HeightGrid table = whole_numbers(trace, servo_rate, name);
  for (int order = 0; order < 2; ++order)
    for (Eigen::Index k = table.cols() - 1; k > 0; --k) table.col(k) -= table.col(k - 1);
  return (table < 0.0).select(-2.0 * table - 1.0, 2.0 * table);
}

std::vector<TickRecord> unpacked_trace(const HeightGrid& packed, double servo_rate) {
  const HeightGrid half = (0.5 * packed).floor();
  HeightGrid table = (packed > 2.0 * half).select(-half - 1.0, half);
  for (int order = 0; order < 2; ++order)
    for (Eigen::Index k = 1; k < table.cols(); ++k) table.col(k) += table.col(k - 1);
  std::vector<TickRecord> trace(static_cast<std::size_t>(table.cols()));
  Eigen::Index k = 0;
  for (TickRecord& tick : trace) {
    const Eigen::Array<double, packed_trace_rows, 1> column = table.col(k++);
    tick.time = column[0] / servo_rate;
    tick.device_force = column.segment<3>(1) * trace_force_quantum;
    if (column[6] != lifted) tick.level = column[4] * trace_height_quantum;
    tick.depth = (column[4] - column[5]) * trace_height_quantum;
    tick.contact = column[6] == in_contact;
  }
  return trace;
}

}  // namespace sandstroke
