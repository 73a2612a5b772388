#include "import/stroke_of_table.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/counted.h"
#include "core/error.h"
#include "haptics/gap_threshold.h"
#include "haptics/stroke_lines.h"
#include "import/equal_times.h"
#include "import/joined_clock.h"
#include "import/missing_samples.h"
#include "import/pen_states.h"
#include "import/redundancy.h"
#include "import/table_layout.h"
#include "import/table_option.h"
#include "import/table_times.h"
#include "import/used_columns.h"

namespace sandstroke {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Vectors of a stroke from 2 or 3 columns.
std::vector<Vector3d> vectors(const SampleTable& table, const ColumnChoices& choices, const NamedUnit& unit) {
  std::vector<Vector3d> rows(table.size(), Vector3d::Zero());
  for (std::size_t k = 0; k < choices.size(); ++k) {
    const std::vector<double>& values = table.columns[choices[k].column].values;
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i][static_cast<Eigen::Index>(k)] = choices[k].sign * unit.of(k).to_si(values[i]);
  }
  return rows;
}

/// Turns an orientation from the table's axes to the stroke's. A reflection of the axes is no rotation of the
/// tool; together with one of the tool itself, in its own y, it is. Tools that are alike on both sides do not
/// change by that: a plate is wide along y.
Quaterniond turned(const Matrix3d& axes, const Quaterniond& q) {
  if (axes.determinant() > 0.0) return Quaterniond(axes) * q;
  const Matrix3d both = axes * Vector3d(1, -1, 1).asDiagonal();
  return Quaterniond(both) * Quaterniond(q.w(), -q.x(), q.y(), -q.z());  // q as the mirrored tool has it
}

class StrokeMaker {
 public:
  StrokeMaker(const SampleTable& table, const TableLayout& found, const TableSettings& settings,
              const std::string& name, bool is_second)
      : table_(table),
        settings_(settings),
        name_(name),
        is_second_(is_second),
        found_(found),
        used_(used_columns(table, found_, settings, name, is_second_)),
        layout_(used_.layout),
        lines_(table.lines) {}

  ImportedStroke make() {
    made_.description = table_.description;
    made_.axes = layout_.axes;
    made_.warnings = table_.warnings;
    const TableTimes times = table_times(table_, layout_, settings_, name_, is_second_);
    std::vector<std::string> asks = used_.asks;
    asks.insert(asks.end(), times.asks.begin(), times.asks.end());
    if (!asks.empty()) throw_input_error("{}: {}", name_, fmt::join(asks, "; and "));
    take_columns();
    tell(times.text);
    for (const std::string& note : used_.notes) tell(note);
    for (const std::string& warning : used_.warnings) made_.warnings.push_back(warning);
    for (const std::string& warning : times.warnings) warn(warning);
    take_times(times);
    take_pen();
    tell_unused_columns();
    settle_gaps();
    Stroke& stroke = made_.stroke;
    stroke.frame = settings_.frame;
    check_stroke(stroke, name_);
    if (table_.line_tolerance > 0.0)
      keep_lines_straight(stroke, used_.length.unit.to_si(table_.line_tolerance));
    else
      compare_columns();
    return std::move(made_);
  }

 private:
  void tell(const std::string& what) { made_.description += (made_.description.empty() ? "" : "; ") + what; }
  void warn(const std::string& what) {
    if (!what.empty()) made_.warnings.push_back(fmt::format("{}: {}", name_, what));
  }
  std::string names(const ColumnChoices& choices) const { return names_of(table_, choices); }

  void tell_unused_columns() {
    std::vector<bool> used(table_.columns.size(), false);
    for (const ColumnChoices* choices :
         {&found_.position, &found_.velocity, &found_.force, &found_.orientation})
      for (const ColumnChoice& choice : *choices) used[choice.column] = true;
    for (const std::optional<std::size_t>& column :
         {found_.time, found_.pressure, found_.stroke_number, found_.pen_state})
      if (column) used[*column] = true;
    if (found_.time && found_.time_fraction && table_.columns[*found_.time].unit == joined_unit)
      used[*found_.time_fraction] = true;
    constexpr std::size_t most = 8;
    std::vector<std::string> left;
    for (std::size_t i = 0; i < used.size(); ++i)
      if (!used[i]) left.push_back(table_.columns[i].name);
    if (!left.empty()) tell("not used: " + first_of(std::move(left), most));
  }

  void take_columns() {
    Stroke& stroke = made_.stroke;
    stroke.position = vectors(table_, layout_.position, used_.length);
    if (!layout_.position.empty()) {
      tell(fmt::format("position {} ({})", names(layout_.position), used_.length.name));
      warn_of_axes();
    }
    if (!layout_.velocity.empty()) {
      stroke.velocity = vectors(table_, layout_.velocity, used_.speed);
      tell(fmt::format("velocity {} ({})", names(layout_.velocity), used_.speed.name));
    }
    if (!layout_.force.empty()) {
      stroke.force = vectors(table_, layout_.force, used_.force);
      tell(fmt::format("force {} ({})", names(layout_.force), used_.force.name));
      stroke.force_sign = settings_.force_sign;
      if (settings_.force_sign == ForceSign::not_said)
        warn(
            fmt::format("the table does not say whether {} is the force on the device or by the hand; it "
                        "is taken as on the device; set {} to say which",
                        names(layout_.force), option_and_key("force_sign")));
    }
    if (!layout_.orientation.empty()) take_orientation();
    if (layout_.pressure) {
      const SampleColumn& column = table_.columns[*layout_.pressure];
      stroke.pressure = column.values;
      tell(fmt::format("pressure {}", column.name));
    }
  }

  void warn_of_axes() {
    const ColumnChoices& position = layout_.position;
    const std::vector<double>& y = table_.columns[position[1].column].values;
    const bool counts_down =
        position[1].sign > 0.0 && std::any_of(y.begin(), y.end(), [](double value) { return value > 0.0; });
    const bool of_pen = is_pixel(used_.length.name) || (layout_.pressure && position.size() == 2);
    if (of_pen && counts_down)
      warn(
          fmt::format("y is taken to point upwards, but on screens and tablets it points downwards; if "
                      "the shape is upside down, set {} to \"{},-{}\"",
                      option_and_key("position"), table_.columns[position[0].column].name,
                      table_.columns[position[1].column].name));
    if (position.size() == 3 && layout_.axes.determinant() < 0.0)
      warn(fmt::format("the axes {} are left-handed, so the shape is mirrored; change one sign, or swap two",
                       names(position)));
  }

  void take_orientation() {
    const auto value = [&](std::size_t k, std::size_t i) {
      const ColumnChoice& choice = layout_.orientation[k];
      return choice.sign * table_.columns[choice.column].values[i];
    };
    const bool is_quaternion = layout_.orientation.size() == 4;
    for (std::size_t i = 0; i < table_.size(); ++i) {
      Quaterniond q = Quaterniond::Identity();
      if (used_.missing[i]) {
        // Stays so until the sample is left out.
      } else if (is_quaternion) {
        q = Quaterniond(value(3, i), value(0, i), value(1, i), value(2, i));
      } else {
        Matrix3d matrix;
        for (std::size_t k = 0; k < 9; ++k)
          matrix(static_cast<int>(k / 3), static_cast<int>(k % 3)) = value(k, i);
        const bool is_rotation = (matrix * matrix.transpose()).isIdentity(0.01) && matrix.determinant() > 0.0;
        q = is_rotation ? Quaterniond(matrix) : Quaterniond(0.0, 0.0, 0.0, 0.0);
      }
      if (!(q.norm() > 0.5 && q.norm() < 2.0))
        throw_input_error("{}: columns {} are not a {}; name other columns, or correct the sample",
                          sample_location(name_, table_.lines, i), names(layout_.orientation),
                          is_quaternion ? "quaternion of length 1" : "rotation matrix");
      made_.stroke.orientation.emplace_back(turned(layout_.axes, q.normalized()).coeffs());
    }
    tell(fmt::format("orientation {}", names(layout_.orientation)));
    if (layout_.axes.determinant() < 0.0)
      warn(
          fmt::format("the axes of the position{} are left-handed, so orientation {} is mirrored, too; that "
                      "is right for tools whose sides (-y and y) are alike; for others change one sign, or "
                      "set {} to none",
                      is_second_ ? "" : " " + names(layout_.position), names(layout_.orientation),
                      option_and_key("orientation")));
  }

  /// Makes the times of the samples that lack no value, and lifts the pen where others were.
  void take_times(const TableTimes& times) {
    Stroke& stroke = made_.stroke;
    stroke.time = times.time;
    stroke.nominal_rate = times.rate;
    made_.clock = times.clock;
    PenStates pen = pen_states(table_, layout_, settings_, name_);
    stroke.contact = std::move(pen.contact);
    if (!pen.text.empty()) tell(pen.text);
    for (const std::string& warning : pen.warnings) made_.warnings.push_back(warning);
    EqualTimes rule = settings_.equal_times;
    if (rule == EqualTimes::spread && layout_.time) spread_times(stroke.time, stroke.contact);
    leave_out_samples(stroke, lines_, used_.missing);
    if (settings_.speed > 0.0) {
      times_by_way();
      rule = EqualTimes::drop;  // at equal times the tip did not move
    }
    settle_equal_times(stroke, lines_, rule, name_);
    if (settings_.speed > 0.0 && table_.line_tolerance == 0.0)  // a path's own speed is only a wish
      warn(speed_against_times(table_, layout_, settings_, stroke.duration()));
  }

  /// Spreads equal times of all samples that have one, so that those without a position count, too.
  void spread_times(std::vector<double>& time, const std::vector<std::uint8_t>& contact) const {
    Stroke timed;
    std::vector<std::size_t> samples, lines;
    for (std::size_t i = 0; i < time.size(); ++i) {
      if (!std::isfinite(time[i])) continue;
      samples.push_back(i);
      timed.time.push_back(time[i]);
      if (!contact.empty()) timed.contact.push_back(contact[i]);
      if (!table_.lines.empty()) lines.push_back(table_.lines[i]);
    }
    settle_equal_times(timed, lines, EqualTimes::spread, name_);
    for (std::size_t k = 0; k < samples.size(); ++k) time[samples[k]] = timed.time[k];
  }

  void times_by_way() {
    Stroke& stroke = made_.stroke;
    double way = 0.0;
    for (std::size_t i = 0; i < stroke.position.size(); ++i) {
      if (i > 0) way += (stroke.position[i] - stroke.position[i - 1]).norm();
      stroke.time.push_back(way / settings_.speed);
    }
    stroke.tip_speed = settings_.speed;
  }

  /// A pen that presses in some samples hovers in those without pressure.
  void take_pen() {
    Stroke& stroke = made_.stroke;
    const auto presses = [](double pressure) { return pressure > 0.0; };
    const auto pressed = std::count_if(stroke.pressure.begin(), stroke.pressure.end(), presses);
    if (pressed == 0 || pressed == std::ssize(stroke.pressure)) return;
    stroke.contact.resize(stroke.size(), pen_down);
    for (std::size_t i = 0; i < stroke.contact.size(); ++i)
      if (!presses(stroke.pressure[i])) stroke.contact[i] = pen_up;
    tell(fmt::format("the pen is up in {} samples without pressure", std::ssize(stroke.pressure) - pressed));
  }

  void settle_gaps() {
    Stroke& stroke = made_.stroke;
    if (settings_.gap_threshold > 0.0) {
      stroke.gap_threshold = settings_.gap_threshold;
    } else if (settings_.speed > 0.0 || table_.line_tolerance > 0.0) {
      stroke.gap_threshold = 1.0 + stroke.duration();  // however far apart the points are
    } else {
      stroke.gap_threshold = usual_gap_threshold(stroke);
      if (stroke.gap_threshold > least_gap)
        tell(fmt::format("the tool lifts where samples are over {:.4g} s apart, {} times the usual spacing",
                         stroke.gap_threshold, spacings_of_a_gap));
    }
  }

  /// Warns where columns do not agree with each other, or a sample with all others.
  void compare_columns() {
    const Stroke& stroke = made_.stroke;
    const auto each_name = [&](const ColumnChoices& choices) {
      std::vector<std::string> texts;
      for (const ColumnChoice& choice : choices) texts.push_back(names({choice}));
      return texts;
    };
    if (settings_.speed > 0.0) return;  // times are no measurement
    if (!stroke.velocity.empty())
      warn(velocity_disagreement(stroke, each_name(layout_.position), each_name(layout_.velocity)));
    const std::vector<Jump> jumps = jumps_of(stroke);
    if (jumps.empty()) return;
    const Jump& first = jumps.front();
    made_.warnings.push_back(fmt::format(
        "{}: the tip jumps by {:.4g} m in {:.4g} s, {:.0f} times as fast as in most other steps{}; "
        "correct the sample, or leave its cells empty: then the tool lifts",
        sample_location(name_, lines_, first.sample), first.distance, first.time, first.ratio,
        jumps.size() > 1 ? fmt::format(" ({} jumps in all)", jumps.size()) : ""));
  }

  const SampleTable& table_;
  const TableSettings& settings_;
  const std::string& name_;
  bool is_second_;  // of two tables that are merged
  const TableLayout& found_;
  UsedColumns used_;
  const TableLayout& layout_;       // what is used of found_
  std::vector<std::size_t> lines_;  // of the samples that are not left out
  ImportedStroke made_;
};

}  // namespace

ImportedStroke stroke_of_table(SampleTable table, const TableSettings& settings, const std::string& name,
                               const std::optional<Matrix3d>& of_first) {
  const TableLayout layout = table_layout(table.columns, settings, name, of_first);
  join_clock(table, layout, name);
  return StrokeMaker(table, layout, settings, name, of_first.has_value()).make();
}

}  // namespace sandstroke
