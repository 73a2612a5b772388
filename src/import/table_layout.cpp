#include "import/table_layout.h"

#include <algorithm>

#include "core/error.h"
#include "import/layout_finder.h"
#include "import/table_option.h"

namespace sandstroke {
namespace {

using Means = ColumnName::Means;

/// Turns found columns, which are in the table's axes, as the position's columns are turned. None: they lack
/// an axis that the position has.
std::optional<ColumnChoices> along(const ColumnChoices& found, const Eigen::Matrix3d& axes) {
  ColumnChoices turned;
  for (std::size_t k = 0; k < found.size(); ++k)
    for (std::size_t axis = 0; axis < found.size(); ++axis)
      if (const double sign = axes(static_cast<int>(k), static_cast<int>(axis)); sign != 0.0)
        turned.push_back({found[axis].column, sign});
  return turned.size() == found.size() ? std::optional(turned) : std::nullopt;
}

void take_pen_columns(const LayoutFinder& finder, const TableSettings& settings, TableLayout& layout) {
  if (settings.stroke_number.empty())
    layout.stroke_number = finder.found_one(Means::stroke_number, "stroke_number", layout.warnings);
  else if (!is_none(settings.stroke_number))
    layout.stroke_number = finder.one(settings.stroke_number);
  ColumnChoice state;
  if (is_none(settings.pen_state)) {
    // The pen is down, whatever a column says.
  } else if (!settings.pen_state.empty()) {
    state = finder.signed_one(settings.pen_state);
    layout.pen_state = state.column;
  } else {
    layout.pen_state = finder.found_one(Means::pen_down, "pen_state", layout.warnings);
    if (!layout.pen_state) layout.pen_state = finder.found_one(Means::pen_up, "pen_state", layout.warnings);
  }
  if (layout.pen_state) {
    layout.state_named_up = finder.is_pen_up(*layout.pen_state);
    layout.state_is_up = layout.state_named_up || state.sign < 0.0;  // "-NAME" is down where it is 0
  }
  if (layout.stroke_number || layout.pen_state || is_none(settings.stroke_number) ||
      is_none(settings.pen_state))
    return;
  layout.perhaps_stroke_number = finder.first_two({Means::perhaps_stroke_number});
  layout.perhaps_pen_state = finder.first_two({Means::perhaps_pen_down, Means::perhaps_pen_up});
}

}  // namespace

TableLayout table_layout(const std::vector<SampleColumn>& columns, const TableSettings& settings,
                         const std::string& location, const std::optional<Eigen::Matrix3d>& of_first) {
  const LayoutFinder finder(columns, location);
  TableLayout layout;
  if (!settings.position.empty()) {
    layout.position = finder.named(settings.position, "position", {2, 3});
  } else if (!of_first) {
    layout.position = finder.found(Means::position, 2, 3);
    if (layout.position.empty())
      throw_input_error(
          "{}: no columns are named x, y and z; give the names or numbers of the position's columns with {}; "
          "the columns are: {}",
          location, option_and_key("position"), finder.all_names());
    if (const auto height = finder.lone_height(); height && layout.position.size() == 2)
      layout.warnings.push_back(fmt::format(
          "the stroke is flat, but column '{}' may be its height; if it is, set {} to \"{},{},{}\"",
          columns[*height].name, option_and_key("position"), columns[layout.position[0].column].name,
          columns[layout.position[1].column].name, columns[*height].name));
  }
  layout.axes = of_first ? *of_first : finder.axes_of(layout.position);
  const auto vector = [&](const std::string& list, const std::string& key, Means means,
                          std::vector<std::string>* doubts) {
    if (is_none(list)) return ColumnChoices();
    if (!list.empty()) return finder.named(list, key.c_str(), {2, 3});
    const auto turned = along(finder.found(means, 2, 3, doubts), layout.axes);
    if (turned) return *turned;
    layout.warnings.push_back(
        fmt::format("the {} is left out, because it has no column for an axis that the position has; name "
                    "its columns with {}",
                    key, option_and_key(key)));
    return ColumnChoices();
  };
  layout.velocity = vector(settings.velocity, "velocity", Means::velocity, &layout.notes);
  layout.force = vector(settings.force, "force", Means::force, nullptr);
  if (!settings.orientation.empty() && !is_none(settings.orientation)) {
    layout.orientation = finder.named(settings.orientation, "orientation", {4, 9});
  } else if (settings.orientation.empty()) {
    layout.orientation = finder.found(Means::orientation, 4, 4);
    if (layout.orientation.empty()) layout.orientation = finder.found(Means::matrix, 9, 9);
  }
  if (!is_none(settings.pressure))
    layout.pressure = settings.pressure.empty()
                          ? finder.found_one(Means::pressure, "pressure", layout.warnings)
                          : finder.one(settings.pressure);
  take_pen_columns(finder, settings, layout);
  const bool by_other = settings.time.empty() && (settings.rate > 0.0 || settings.speed > 0.0);
  const LayoutFinder::Time time = by_other ? finder.plainest_time()
                                  : settings.time.empty()
                                      ? finder.found_time(of_first ? "merge_time" : "time", layout.warnings)
                                      : finder.named_time(settings.time);
  (by_other ? layout.replaced_time : layout.time) = time.column;
  layout.time_fraction = time.fraction;
  layout.sample_number = finder.found_one(Means::number);
  return layout;
}

}  // namespace sandstroke
