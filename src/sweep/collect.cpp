#include "sweep/collect.h"

#include "core/output_file.h"
#include "io/input_kind.h"
#include "io/table.h"
#include "report/page.h"
#include "sweep/sweep_file.h"
#include "sweep/sweep_page.h"

namespace sandstroke {
namespace {

/// A sweep's table is recognised by its columns.
constexpr OutputKind table_output{"a sweep's table", "point,", ",verdict,"};

/// Makes a table with a row per point: point, axes, verdict, metrics, reason.
Table sweep_table(const CollectedSweep& sweep) {
  Table table;
  const auto add = [&]<class Value>(const std::string& name, const std::string& title,
                                    const std::string& unit, Value, const auto& of) {
    std::vector<Value> values;
    for (std::size_t point = 0; point < sweep.results.size(); ++point) values.push_back(of(point));
    table.columns.push_back({name, title, unit, std::move(values)});
  };
  const double number{};
  const std::string text;
  add("point", "point", "", number, [](std::size_t point) { return static_cast<double>(point); });
  const SweepDesign& design = sweep.folder.design();
  for (std::size_t i = 0; i < design.axes.size(); ++i) {
    const SweepAxis& axis = design.axes[i];
    const auto value = [&](std::size_t point) { return design.value_at(point, i); };
    if (axis.numeric())
      add(axis.key, axis.key, axis.unit, number,
          [&](std::size_t point) { return axis.number(value(point)); });
    else
      add(axis.key, axis.key, axis.unit, text, [&](std::size_t point) { return axis.label(value(point)); });
  }
  add("verdict", "verdict", "", text, [&](std::size_t point) { return sweep.verdict_name(point); });
  const std::vector<Metric>& metrics = sweep.folder.metrics();
  for (std::size_t i = 0; i < metrics.size(); ++i)
    add(metrics[i].name, metrics[i].title, metrics[i].unit, number,
        [&](std::size_t point) { return sweep.metric(point, i); });
  add("reason", "reason", "", text, [&](std::size_t point) { return sweep.reason(point); });
  return table;
}

}  // namespace

void check_collectable(const SweepFolder& folder) {
  check_output(folder.path() / "sweep.h5", {}, output_kind(InputKind::sweep));
  check_output(folder.path() / "sweep.csv", {}, table_output);
  check_output(folder.path() / "sweep.html", {}, page_output);
}

CollectReport collect(const SweepFolder& folder) {
  check_collectable(folder);
  CollectReport report;
  const CollectedSweep sweep(folder, report);
  write_sweep_file(folder.path() / "sweep.h5", sweep, report.content_hash);
  write_text_file(folder.path() / "sweep.csv", csv_text(sweep_table(sweep)), table_output);
  write_text_file(folder.path() / "sweep.html", sweep_page(sweep_page_data(sweep, report)), page_output);
  return report;
}

}  // namespace sandstroke
