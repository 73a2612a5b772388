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
    constexpr std::string_view components = components_of<std::decay_t<decltype(of(ticks.front()))>>();
    if constexpr (!components.empty())
      for (std::size_t i = 0; i < components.size(); ++i)
        add(field + "_" + components[i],
            [i](const auto& numbers) { return numbers[static_cast<Eigen::Index>(i)]; });
    else
      add(field, [](auto value) { return value; });
  });
  return table;
}

}  // namespace sandstroke
