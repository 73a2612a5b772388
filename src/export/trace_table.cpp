#include "export/trace_table.h"

namespace sandstroke {

Table trace_table(const std::vector<TickRecord>& ticks, const TraceContent& content) {
  Table table;
  visit_tick_fields([&](const FieldText& text, const auto& of) {
    if (text.only_with && !(content.*text.only_with)) return;
    const std::string field = text.name, unit = text.units;
    const auto add = [&](const std::string& name, const auto& number) {
      std::vector<double> numbers;
      numbers.reserve(ticks.size());
      for (const TickRecord& tick : ticks) numbers.push_back(static_cast<double>(number(of(tick))));
      table.columns.push_back(
          {unit.empty() ? name : name + " [" + unit + "]", name, unit, std::move(numbers)});
    };
    if constexpr (std::is_same_v<std::decay_t<decltype(of(ticks.front()))>, Eigen::Vector3d>)
      for (int i = 0; i < 3; ++i)
        add(field + "_" + "xyz"[i], [i](const Eigen::Vector3d& vector) { return vector[i]; });
    else
      add(field, [](auto value) { return value; });
  });
  return table;
}

}  // namespace sandstroke
