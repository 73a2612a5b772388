#include "import/pen_states.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "haptics/stroke.h"
#include "import/table_option.h"

namespace sandstroke {
namespace {

class PenReader {
 public:
  PenReader(const SampleTable& table, const TableLayout& layout, const TableSettings& settings,
            const std::string& name)
      : table_(table), layout_(layout), settings_(settings), name_(name) {
    for (const bool lifts : table.lifts) states_.contact.push_back(lifts ? pen_lifts : pen_down);
  }

  PenStates read() {
    if (layout_.pen_state) take_state(table_.columns[*layout_.pen_state]);
    if (layout_.stroke_number) take_number(table_.columns[*layout_.stroke_number]);
    for (const std::size_t column : layout_.perhaps_pen_state) ask_state(table_.columns[column]);
    for (const std::size_t column : layout_.perhaps_stroke_number) ask_number(table_.columns[column]);
    return std::move(states_);
  }

 private:
  void tell(const std::string& what) { states_.text += (states_.text.empty() ? "" : "; ") + what; }
  void warn(const std::string& what) { states_.warnings.push_back(name_ + ": " + what); }

  /// The samples after which another value follows.
  static std::size_t changes_of(const std::vector<double>& values) {
    std::size_t changes = 0;
    for (std::size_t i = 0; i + 1 < values.size(); ++i) changes += differ(values[i], values[i + 1]);
    return changes;
  }
  static bool differ(double a, double b) { return a != b && (std::isfinite(a) || std::isfinite(b)); }
  static bool all_whole(const std::vector<double>& values) {
    return std::none_of(values.begin(), values.end(), has_fraction);
  }
  /// Strokes have two samples at least, on average.
  static bool may_be_numbers(const std::vector<double>& values) {
    return all_whole(values) && 2 * changes_of(values) <= values.size();
  }

  void take_state(const SampleColumn& column) {
    if (column.values.empty()) return;  // it has other words, as the reader of the cells told
    const auto is_up = [&](double value) {
      return !std::isfinite(value) || (value != 0.0) == layout_.state_is_up;
    };
    const auto up = std::count_if(column.values.begin(), column.values.end(), is_up);
    const char* meaning = layout_.state_is_up ? "where it is not 0" : "where it is 0";
    if (up == std::ssize(column.values) && settings_.pen_state.empty()) {
      warn(fmt::format(
          "column '{}' would lift the pen in all samples, so it is not taken for the pen's state; "
          "name the column with {} if it is",
          column.name, option_and_key("pen_state")));
      return;
    }
    if (up == 0 && changes_of(column.values) > 0)
      warn(
          fmt::format("column '{}' changes but never lifts the pen, which is up {}; if it numbers strokes, "
                      "name it with {}",
                      column.name, meaning, option_and_key("stroke_number")));
    states_.contact.resize(column.values.size(), pen_down);
    for (std::size_t i = 0; i < column.values.size(); ++i)
      if (is_up(column.values[i])) states_.contact[i] = pen_up;
    tell(fmt::format("pen state {}: up {}, in {} samples", column.name, meaning, up));
  }

  void take_number(const SampleColumn& column) {
    const std::vector<double>& values = column.values;
    if (settings_.stroke_number.empty() && !may_be_numbers(values)) {
      warn(
          fmt::format("column '{}' changes too often to number strokes, so the pen does not lift where it "
                      "does; name it with {} if it should",
                      column.name, option_and_key("stroke_number")));
      return;
    }
    states_.contact.resize(values.size(), pen_down);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(values[i])) states_.contact[i] = pen_up;
      if (i + 1 < values.size() && differ(values[i], values[i + 1]) && states_.contact[i] == pen_down)
        states_.contact[i] = pen_lifts;
    }
    tell(fmt::format("stroke number {}: {} strokes, between which the pen lifts", column.name,
                     changes_of(values) + 1));
  }

  void ask_state(const SampleColumn& column) {
    const std::vector<double>& values = column.values;
    const auto has = [&](double state) {
      return std::find(values.begin(), values.end(), state) != values.end();
    };
    const bool is_state = std::all_of(values.begin(), values.end(), [](double value) {
      return value == 0.0 || value == 1.0 || !std::isfinite(value);
    });
    if (is_state && has(0.0) && has(1.0))
      warn(
          fmt::format("column '{}' changes between 0 and 1 (or up and down), as the state of a pen does, but "
                      "the pen stays down; if it is one, name it with {}",
                      column.name, option_and_key("pen_state")));
  }

  void ask_number(const SampleColumn& column) {
    if (changes_of(column.values) > 0 && may_be_numbers(column.values))
      warn(
          fmt::format("column '{}' changes {} times, as the number of a stroke does, but the pen stays down; "
                      "if it numbers strokes, name it with {}",
                      column.name, changes_of(column.values), option_and_key("stroke_number")));
  }

  const SampleTable& table_;
  const TableLayout& layout_;
  const TableSettings& settings_;
  const std::string& name_;
  PenStates states_;
};

}  // namespace

PenStates pen_states(const SampleTable& table, const TableLayout& layout, const TableSettings& settings,
                     const std::string& name) {
  return PenReader(table, layout, settings, name).read();
}

}  // namespace sandstroke
