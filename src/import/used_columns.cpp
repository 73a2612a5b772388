#include "import/used_columns.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "import/missing_samples.h"
#include "import/table_option.h"

namespace sandstroke {
namespace {

/// Columns that a stroke may lack.
struct OptionalColumns {
  ColumnChoices* choices;
  bool asked;
  const char* key;
  bool runs_use_it;
};

std::vector<std::size_t> indices_of(const ColumnChoices& choices) {
  std::vector<std::size_t> columns;
  for (const ColumnChoice& choice : choices) columns.push_back(choice.column);
  return columns;
}

class ColumnsFinder {
 public:
  ColumnsFinder(const SampleTable& table, const TableLayout& layout, const TableSettings& settings,
                const std::string& name, bool is_second)
      : table_(table),
        settings_(settings),
        name_(name),
        is_second_(is_second),
        missing_(table, name, settings.missing) {
    used_.layout = layout;
    used_.notes = layout.notes;
    for (const std::string& warning : layout.warnings) used_.warnings.push_back(name + ": " + warning);
  }

  UsedColumns find() {
    TableLayout& layout = used_.layout;
    if (!layout.position.empty()) used_.length = position_unit();
    const OptionalColumns velocity{&layout.velocity, !settings_.velocity.empty(), "velocity", false};
    const OptionalColumns force{&layout.force, !settings_.force.empty() || is_second_, "force", true};
    const OptionalColumns orientation{&layout.orientation, !settings_.orientation.empty() || is_second_,
                                      "orientation", true};
    used_.speed = unit_of_optional(velocity, Quantity::speed, settings_.velocity_unit);
    used_.force = unit_of_optional(force, Quantity::force, settings_.force_unit);
    refuse_empty_height();
    missing_.need(indices_of(layout.position));
    if (layout.time) missing_.need({*layout.time});
    settle_pressure();
    for (const OptionalColumns& one : {velocity, force, orientation})
      if (one.asked) missing_.need(indices_of(*one.choices));
    for (const OptionalColumns& one : {velocity, force, orientation})
      if (!one.asked) leave_out_unless_complete(one);
    used_.missing = missing_.samples();
    if (const std::string text = missing_.text(); !text.empty())
      used_.warnings.push_back(fmt::format("{}: {}", name_, text));
    return std::move(used_);
  }

 private:
  std::string names(const ColumnChoices& choices) const { return names_of(table_, choices); }

  /// The common unit of the columns; empty: they have none, or different ones.
  std::string own_unit(const ColumnChoices& choices) const {
    const std::string& unit = table_.columns[choices.front().column].unit;
    const bool same = std::all_of(choices.begin(), choices.end(), [&](const ColumnChoice& choice) {
      return table_.columns[choice.column].unit == unit;
    });
    return same ? unit : "";
  }

  /// The unit of each column, if all are known and they differ.
  std::optional<NamedUnit> own_units(Quantity quantity, const ColumnChoices& choices) const {
    NamedUnit units;
    for (const ColumnChoice& choice : choices) {
      const std::string& unit = table_.columns[choice.column].unit;
      const auto known = known_unit(quantity, unit);
      if (!known || is_pixel(unit)) return std::nullopt;
      units.name += (units.name.empty() ? "" : ", ") + unit;
      units.each.push_back(*known);
    }
    if (!own_unit(choices).empty()) return std::nullopt;
    units.unit = units.each.front();
    return units;
  }

  /// Tells of columns whose own unit is another one than the user gives.
  void compare_with_own(Quantity quantity, const std::string& given, const Unit& unit,
                        const ColumnChoices& choices, const std::string& key) {
    for (const ColumnChoice& choice : choices) {
      const SampleColumn& column = table_.columns[choice.column];
      const auto own = known_unit(quantity, column.unit);
      if (!own || (is_pixel(column.unit) && is_pixel(given))) continue;
      const double ratio = own->to_si(1.0) / unit.to_si(1.0);
      if (!is_pixel(column.unit) && std::abs(ratio - 1.0) < 1e-9) continue;
      used_.warnings.push_back(
          fmt::format("{}: column '{}' is in {} by the file, but is read in {}, which {} "
                      "says; leave that out to use the file's unit",
                      name_, column.name, column.unit, given, option_and_key(key)));
      return;
    }
  }

  std::string unit_not_known(const ColumnChoices& choices) const {
    std::vector<std::string> units;
    for (const ColumnChoice& choice : choices) units.push_back(table_.columns[choice.column].unit);
    const bool none =
        std::all_of(units.begin(), units.end(), [](const std::string& unit) { return unit.empty(); });
    return none ? "not known" : fmt::format("not the same in all columns ({})", fmt::join(units, ", "));
  }

  /// The unit of this name; asks for another one if there is none.
  NamedUnit unit_named(Quantity quantity, const std::string& unit, const ColumnChoices& choices,
                       const char* key) {
    if (quantity == Quantity::length && is_pixel(unit) && !(settings_.pixel_size > 0.0)) {
      used_.asks.push_back(fmt::format("{} {} in px, which need the size of a pixel; give {} in m",
                                       names(choices), choices.size() == 1 ? "is" : "are",
                                       option_and_key("pixel_size")));
      return {unit, {}};
    }
    try {
      return {unit, unit_of(quantity, unit, settings_.pixel_size)};
    } catch (const Error& failure) {
      used_.asks.push_back(
          fmt::format("the unit of {}: {}; give {}", names(choices), failure.what(), option_and_key(key)));
      return {unit, {}};
    }
  }

  NamedUnit position_unit() {
    const ColumnChoices& position = used_.layout.position;
    std::string unit = settings_.position_unit;
    if (unit.empty()) {
      if (const auto units = own_units(Quantity::length, position)) return *units;
      unit = own_unit(position);
    }
    if (!unit.empty() && (unit != "radius" || !settings_.position_unit.empty())) {
      const NamedUnit named = unit_named(Quantity::length, unit, position, "position_unit");
      compare_with_own(Quantity::length, unit, named.unit, position, "position_unit");
      return named;
    }
    used_.asks.push_back(fmt::format("the unit of {} is {}; give {}: {}", names(position),
                                     unit.empty() ? unit_not_known(position) : "the pattern's radius",
                                     option_and_key("position_unit"),
                                     unit.empty() ? unit_symbols(Quantity::length) : "the radius in metres"));
    return {"m", {}};
  }

  /// Leaves the columns out if nobody named them and their unit is not known.
  NamedUnit unit_of_optional(const OptionalColumns& one, Quantity quantity, const std::string& given) {
    if (one.choices->empty()) return {};
    const std::string key = std::string(one.key) + "_unit";
    if (given.empty())
      if (const auto units = own_units(quantity, *one.choices)) return *units;
    const std::string unit = given.empty() ? own_unit(*one.choices) : given;
    if (one.asked && unit.empty()) {
      used_.asks.push_back(fmt::format("the unit of {} is {}; give {}: {}", names(*one.choices),
                                       unit_not_known(*one.choices), option_and_key(key),
                                       unit_symbols(quantity)));
      return {};
    }
    if (one.asked || !given.empty() || known_unit(quantity, unit)) {
      const NamedUnit named = unit_named(quantity, unit, *one.choices, key.c_str());
      compare_with_own(quantity, unit, named.unit, *one.choices, key);
      return named;
    }
    leave_out(one, fmt::format("because its unit is not known; give {}", option_and_key(key)));
    return {};
  }

  void leave_out(const OptionalColumns& one, const std::string& why) {
    const std::string sentence = fmt::format("{} left out, {}", names(*one.choices), why);
    if (one.runs_use_it)
      used_.warnings.push_back(fmt::format("{}: {}", name_, sentence));
    else
      used_.notes.push_back(sentence);
    one.choices->clear();
  }

  void refuse_empty_height() const {
    const ColumnChoices& position = used_.layout.position;
    if (position.size() != 3 || !has_no_values(table_.columns[position[2].column])) return;
    throw_input_error(
        "{}: column '{}' has no value in any sample; name another column for it, or, if the stroke is flat, "
        "set {} to \"{}\"",
        name_, table_.columns[position[2].column].name, option_and_key("position"),
        names_of(table_, {position[0], position[1]}, ","));
  }

  /// A pressure that is missing does not say whether the pen is down.
  void settle_pressure() {
    std::optional<std::size_t>& pressure = used_.layout.pressure;
    if (!pressure) return;
    if (settings_.pressure.empty() && has_no_values(table_.columns[*pressure])) {
      used_.notes.push_back(fmt::format("{} left out: no values", table_.columns[*pressure].name));
      pressure.reset();
    } else {
      missing_.need({*pressure});
    }
  }

  void leave_out_unless_complete(const OptionalColumns& one) {
    const std::vector<std::size_t> columns = indices_of(*one.choices);
    if (std::any_of(columns.begin(), columns.end(),
                    [&](std::size_t column) { return has_no_values(table_.columns[column]); })) {
      used_.notes.push_back(fmt::format("{} left out: no values", names(*one.choices)));
      one.choices->clear();
      return;
    }
    const std::vector<std::size_t> lacking = missing_.lacking(columns);
    if (lacking.empty()) return;
    if (settings_.missing == Missing::error) missing_.need(columns);
    leave_out(one, fmt::format("because {} a value in it (the first is {}); to use it, set {} to "
                               "\"{}\": the tool lifts where values are missing",
                               lacking.size() == 1 ? "a sample lacks"
                                                   : fmt::format("{} samples lack", lacking.size()),
                               sample_location(name_, table_.lines, lacking.front()), option_and_key(one.key),
                               names_of(table_, *one.choices, ",")));
  }

  const SampleTable& table_;
  const TableSettings& settings_;
  const std::string& name_;
  bool is_second_;
  MissingSamples missing_;
  UsedColumns used_;
};

}  // namespace

UsedColumns used_columns(const SampleTable& table, const TableLayout& layout, const TableSettings& settings,
                         const std::string& name, bool is_second) {
  return ColumnsFinder(table, layout, settings, name, is_second).find();
}

std::string names_of(const SampleTable& table, const ColumnChoices& choices, const char* between) {
  std::vector<std::string> texts;
  for (const ColumnChoice& choice : choices)
    texts.push_back((choice.sign < 0.0 ? "-" : "") + table.columns[choice.column].name);
  return fmt::format("{}", fmt::join(texts, between));
}

}  // namespace sandstroke
