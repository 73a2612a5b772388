#include "import/stroke_of_table.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "haptics/stroke_lines.h"
#include "import/equal_times.h"
#include "import/pen_states.h"
#include "import/table_layout.h"
#include "import/units.h"

namespace sandstroke {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

class StrokeMaker {
 public:
  StrokeMaker(const SampleTable& table, const TableSettings& settings, const std::string& name,
              const std::optional<Matrix3d>& of_first)
      : table_(table),
        settings_(settings),
        name_(name),
        layout_(table_layout(table.columns, settings, name, of_first)),
        is_second_(of_first.has_value()) {}

  ImportedStroke make() {
    Stroke& stroke = made_.stroke;
    made_.description = table_.description;
    made_.axes = layout_.axes;
    made_.warnings = table_.warnings;
    take_positions();
    take_velocity();
    take_force();
    take_orientation();
    take_pressure();
    take_pen();
    take_times();
    if (!asks_.empty()) throw_input_error("{}: {}", name_, fmt::join(asks_, "; and "));
    EqualTimes rule = settings_.equal_times;
    if (by_speed_) rule = EqualTimes::drop;  // at equal times the tip did not move
    settle_equal_times(stroke, table_.lines, rule, name_);
    tell_unused_columns();
    stroke.frame = settings_.frame;
    if (settings_.gap_threshold > 0.0)
      stroke.gap_threshold = settings_.gap_threshold;
    else if (by_speed_ || table_.line_tolerance > 0.0)
      stroke.gap_threshold = 1.0 + stroke.duration();  // however far apart the points are
    check_stroke(stroke, name_);
    if (table_.line_tolerance > 0.0) keep_lines_straight(stroke, length_.to_si(table_.line_tolerance));
    return std::move(made_);
  }

 private:
  void tell(const std::string& what) { made_.description += (made_.description.empty() ? "" : "; ") + what; }

  std::string names(const ColumnChoices& choices) const {
    std::vector<std::string> texts;
    for (const ColumnChoice& choice : choices)
      texts.push_back((choice.sign < 0.0 ? "-" : "") + table_.columns[choice.column].name);
    return fmt::format("{}", fmt::join(texts, ", "));
  }

  void tell_unused_columns() {
    std::vector<bool> used(table_.columns.size(), false);
    for (const ColumnChoices* choices :
         {&layout_.position, &layout_.velocity, &layout_.force, &layout_.orientation})
      for (const ColumnChoice& choice : *choices) used[choice.column] = true;
    for (const std::optional<std::size_t>& column :
         {layout_.time, layout_.pressure, layout_.stroke_number, layout_.pen_state})
      if (column) used[*column] = true;
    if (table_.columns[layout_.time.value_or(0)].unit == joined_unit && layout_.time_fraction)
      used[*layout_.time_fraction] = true;
    constexpr std::size_t most = 8;
    std::vector<std::string> left;
    for (std::size_t i = 0; i < used.size(); ++i)
      if (!used[i]) left.push_back(table_.columns[i].name);
    if (left.empty()) return;
    const std::size_t more = left.size() - std::min(left.size(), most);
    left.resize(left.size() - more);
    tell(fmt::format("not used: {}{}", fmt::join(left, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : ""));
  }

  /// The place of columns, for sentences.
  std::string where(const ColumnChoices& choices) const {
    return fmt::format("{}: column '{}'", name_, table_.columns[choices.front().column].name);
  }

  /// The key that names the times of this table.
  std::string own_key(const std::string& key) const { return is_second_ ? "merge_" + key : key; }

  /// The common unit of the columns; empty: they have none, or different ones.
  std::string own_unit(const ColumnChoices& choices) const {
    const std::string& unit = table_.columns[choices.front().column].unit;
    const bool same = std::all_of(choices.begin(), choices.end(), [&](const ColumnChoice& choice) {
      return table_.columns[choice.column].unit == unit;
    });
    return same ? unit : "";
  }

  std::string unit_not_known(const ColumnChoices& choices) const {
    std::vector<std::string> units;
    for (const ColumnChoice& choice : choices) units.push_back(table_.columns[choice.column].unit);
    const bool none =
        std::all_of(units.begin(), units.end(), [](const std::string& unit) { return unit.empty(); });
    return none ? "not known" : fmt::format("not the same in all columns ({})", fmt::join(units, ", "));
  }

  std::vector<Vector3d> vectors(const ColumnChoices& choices, const Unit& unit) const {
    std::vector<Vector3d> rows(table_.size(), Vector3d::Zero());
    for (std::size_t k = 0; k < choices.size(); ++k) {
      const std::vector<double>& values = table_.columns[choices[k].column].values;
      for (std::size_t i = 0; i < rows.size(); ++i)
        rows[i][static_cast<Eigen::Index>(k)] = choices[k].sign * unit.to_si(values[i]);
    }
    return rows;
  }

  void take_positions() {
    if (layout_.position.empty()) {
      made_.stroke.position.assign(table_.size(), Vector3d::Zero());
      return;
    }
    std::string unit = settings_.position_unit;
    if (unit.empty()) unit = own_unit(layout_.position);
    if (unit.empty() || (unit == "radius" && settings_.position_unit.empty())) {
      asks_.push_back(
          fmt::format("the unit of {} is {}; give {}: {}", names(layout_.position),
                      unit.empty() ? unit_not_known(layout_.position) : "the pattern's radius",
                      option_and_key("position_unit"),
                      unit.empty() ? "m, cm, mm, um, in, px or a number of metres" : "the radius in metres"));
      unit = "m";
    }
    length_ = unit_of(Quantity::length, unit, settings_.pixel_size, where(layout_.position),
                      option_and_key("position_unit"));
    made_.stroke.position = vectors(layout_.position, length_);
    tell(fmt::format("position {} ({})", names(layout_.position), unit));
    const std::vector<double>& y = table_.columns[layout_.position[1].column].values;
    const bool counts_down = layout_.position[1].sign > 0.0 &&
                             std::any_of(y.begin(), y.end(), [](double value) { return value > 0.0; });
    if (is_pixel(unit) && counts_down)
      made_.warnings.push_back(
          fmt::format("{}: y is taken to point upwards, but on screens and tablets it points downwards; if "
                      "the shape is upside down, set {} to \"{},-{}\"",
                      name_, option_and_key("position"), table_.columns[layout_.position[0].column].name,
                      table_.columns[layout_.position[1].column].name));
    if (layout_.position.size() == 3 && layout_.axes.determinant() < 0.0)
      made_.warnings.push_back(fmt::format(
          "{}: the axes {} are left-handed, so the shape is mirrored; change one sign, or swap two", name_,
          names(layout_.position)));
  }

  /// The unit of optional columns; empty: it is not known, and they are left out. asked: the settings name
  /// them, and without a unit this is an Error: input.
  std::string unit_or_none(const ColumnChoices& choices, const std::string& unit, bool asked, const char* key,
                           Quantity quantity) {
    const std::string found = unit.empty() ? own_unit(choices) : unit;
    if (asked && found.empty())
      throw_input_error("{}: the unit of {} is not known; give {}", name_, names(choices),
                        option_and_key(key));
    if (asked || !unit.empty() || known_unit(quantity, found)) return found;
    const std::string left_out = fmt::format("{} left out, because its unit is not known; give {}",
                                             names(choices), option_and_key(key));
    if (quantity == Quantity::force)
      made_.warnings.push_back(fmt::format("{}: {}", name_, left_out));
    else
      tell(left_out);  // no run uses it
    return "";
  }

  void take_velocity() {
    if (layout_.velocity.empty()) return;
    const std::string unit = unit_or_none(layout_.velocity, settings_.velocity_unit,
                                          !settings_.velocity.empty(), "velocity_unit", Quantity::speed);
    if (unit.empty()) return;
    made_.stroke.velocity = vectors(
        layout_.velocity,
        unit_of(Quantity::speed, unit, 0.0, where(layout_.velocity), option_and_key("velocity_unit")));
    tell(fmt::format("velocity {} ({})", names(layout_.velocity), unit));
  }

  void take_force() {
    if (layout_.force.empty()) return;
    const std::string unit = unit_or_none(layout_.force, settings_.force_unit, !settings_.force.empty(),
                                          "force_unit", Quantity::force);
    if (unit.empty()) return;
    made_.stroke.force = vectors(layout_.force, unit_of(Quantity::force, unit, 0.0, where(layout_.force),
                                                        option_and_key("force_unit")));
    tell(fmt::format("force {} ({})", names(layout_.force), unit));
    made_.stroke.force_sign = settings_.force_sign;
    if (settings_.force_sign == ForceSign::not_said)
      made_.warnings.push_back(
          fmt::format("{}: the table does not say whether {} is the force on the device or by the hand; it "
                      "is taken as on the device; set {} to say which",
                      name_, names(layout_.force), option_and_key("force_sign")));
  }

  void take_orientation() {
    if (layout_.orientation.empty()) return;
    if (layout_.axes.determinant() < 0.0) {
      if (!settings_.orientation.empty())
        throw_input_error("{}: orientation cannot be read with left-handed axes; change a sign of {}", name_,
                          names(layout_.position));
      return;
    }
    const Eigen::Quaterniond turn(layout_.axes);
    const auto value = [&](std::size_t k, std::size_t i) {
      const ColumnChoice& choice = layout_.orientation[k];
      return choice.sign * table_.columns[choice.column].values[i];
    };
    for (std::size_t i = 0; i < table_.size(); ++i) {
      Eigen::Quaterniond q;
      if (layout_.orientation.size() == 4) {
        q = Eigen::Quaterniond(value(3, i), value(0, i), value(1, i), value(2, i));
      } else {
        Matrix3d matrix;
        for (std::size_t k = 0; k < 9; ++k)
          matrix(static_cast<int>(k / 3), static_cast<int>(k % 3)) = value(k, i);
        const bool is_rotation = (matrix * matrix.transpose()).isIdentity(0.01) && matrix.determinant() > 0.0;
        q = is_rotation ? Eigen::Quaterniond(matrix) : Eigen::Quaterniond(0.0, 0.0, 0.0, 0.0);
      }
      if (!(q.norm() > 0.5 && q.norm() < 2.0))
        throw_input_error("{}: columns {} are not a {}; name other columns, or correct the sample",
                          location(i), names(layout_.orientation),
                          layout_.orientation.size() == 4 ? "quaternion of length 1" : "rotation matrix");
      made_.stroke.orientation.emplace_back((turn * q.normalized()).coeffs());
    }
    tell(fmt::format("orientation {}", names(layout_.orientation)));
  }

  void take_pressure() {
    if (!layout_.pressure) return;
    const SampleColumn& column = table_.columns[*layout_.pressure];
    made_.stroke.pressure = column.values;
    tell(fmt::format("pressure {}", column.name));
  }

  /// A pen that presses in some samples hovers in those without pressure.
  void take_pen() {
    Stroke& stroke = made_.stroke;
    const PenStates pen = pen_states(table_, layout_, settings_, name_);
    stroke.contact = pen.contact;
    if (!pen.text.empty()) tell(pen.text);
    made_.warnings.insert(made_.warnings.end(), pen.warnings.begin(), pen.warnings.end());
    const auto presses = [](double pressure) { return pressure > 0.0; };
    const auto pressed = std::count_if(stroke.pressure.begin(), stroke.pressure.end(), presses);
    if (pressed == 0 || pressed == std::ssize(stroke.pressure)) return;
    stroke.contact.resize(table_.size(), pen_down);
    for (std::size_t i = 0; i < stroke.contact.size(); ++i)
      if (!presses(stroke.pressure[i])) stroke.contact[i] = pen_up;
    tell(fmt::format("the pen is up in {} samples without pressure", std::ssize(stroke.pressure) - pressed));
  }

  std::string location(std::size_t i) const {
    return table_.lines.empty() ? fmt::format("{}: sample {}", name_, i)
                                : fmt::format("{}:{}", name_, table_.lines[i]);
  }

  void take_times() {
    const bool asked = !settings_.time.empty();
    if (asked + (settings_.rate > 0.0) + (settings_.speed > 0.0) > 1)
      throw_input_error("{}: the times are given twice; give only one of time, rate and speed", name_);
    Stroke& stroke = made_.stroke;
    const double rate = settings_.rate > 0.0 ? settings_.rate : table_.rate;
    if (layout_.time) {
      take_stamps(table_.columns[*layout_.time]);
    } else if (settings_.speed > 0.0) {
      times_by_way();
    } else if (rate > 0.0) {
      for (std::size_t i = 0; i < table_.size(); ++i) stroke.time.push_back(static_cast<double>(i) / rate);
      stroke.nominal_rate = rate;
      tell(fmt::format("{} Hz", rate));
    } else {
      if (table_.line_tolerance > 0.0)
        asks_.push_back(fmt::format("the file gives no speed; give {} in m/s", option_and_key("speed")));
      else if (is_second_)
        asks_.push_back(
            fmt::format("the times are unknown, because no column is named time or t; give {}, or {} in Hz",
                        option_and_key(own_key("time")), option_and_key(own_key("rate"))));
      else
        asks_.push_back(fmt::format(
            "the times are unknown, because no column is named time or t; give {}, {} in Hz, or {} in m/s",
            option_and_key("time"), option_and_key("rate"), option_and_key("speed")));
    }
  }

  void take_stamps(const SampleColumn& column) {
    const auto digits = std::to_string(column.origin.value_or(0)).size();
    std::string unit = settings_.time_unit;
    if (unit.empty()) unit = column.unit;
    const bool counts_ns = column.unit == iso_unit || column.unit == joined_unit;
    if (counts_ns) unit = "ns";
    if (unit.empty() && digits >= 10 && digits % 3 == 1) {  // clocks of today, since 1970
      unit = digits == 10 ? "s" : digits == 13 ? "ms" : digits == 16 ? "us" : "ns";
      // The time since a computer started can have as many digits, in a smaller unit.
      constexpr double most_spacing = 10.0;  // s, between samples
      const double span = unit_of(Quantity::time, unit).to_si(column.values.back() - column.values.front());
      if (span > most_spacing * static_cast<double>(column.values.size())) unit.clear();
    }
    if (unit.empty()) {
      asks_.push_back(fmt::format("the unit of the times '{}' is not known; give {}: s, ms, us or ns",
                                  column.name, option_and_key(own_key("time_unit"))));
      return;
    }
    const Unit of_time =
        unit_of(Quantity::time, unit, 0.0, where({{*layout_.time}}), option_and_key(own_key("time_unit")));
    for (const double stamp : column.values) made_.stroke.time.push_back(of_time.to_si(stamp));
    if (column.origin) {
      const auto per_unit = static_cast<std::int64_t>(of_time.to_si(1e9));
      std::int64_t clock = 0;
      if (!__builtin_mul_overflow(*column.origin, per_unit, &clock)) made_.clock = clock;
    }
    tell(fmt::format("time {} ({})", column.name, counts_ns ? column.unit : unit));
  }

  void times_by_way() {
    by_speed_ = true;
    Stroke& stroke = made_.stroke;
    double way = 0.0;
    for (std::size_t i = 0; i < stroke.position.size(); ++i) {
      if (i > 0) way += (stroke.position[i] - stroke.position[i - 1]).norm();
      stroke.time.push_back(way / settings_.speed);
    }
    stroke.tip_speed = settings_.speed;
    tell(fmt::format("{} m/s", settings_.speed));
  }

  const SampleTable& table_;
  const TableSettings& settings_;
  const std::string& name_;
  TableLayout layout_;
  bool is_second_;  // of two tables that are merged
  ImportedStroke made_;
  std::vector<std::string> asks_;  // what the user has to give
  Unit length_;                    // of the position
  bool by_speed_ = false;
};

}  // namespace

ImportedStroke stroke_of_table(const SampleTable& table, const TableSettings& settings,
                               const std::string& name, const std::optional<Matrix3d>& of_first) {
  return StrokeMaker(table, settings, name, of_first).make();
}

}  // namespace sandstroke
