#include "import/sample_cells.h"

#include <algorithm>
#include <initializer_list>
#include <limits>

#include "core/error.h"
#include "core/small_letters.h"
#include "import/dialect.h"
#include "import/table_option.h"

namespace sandstroke {
namespace {

constexpr double missing_value = std::numeric_limits<double>::quiet_NaN();

bool is_one_of(const std::string& text, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

/// A pen's state as a number: "true" is 1; so is "down", or "up" in a column whose name says up.
std::optional<double> state_in_words(const std::string& small, bool named_up) {
  if (is_one_of(small, {"true", "t", "yes", "y", "on"})) return 1.0;
  if (is_one_of(small, {"false", "f", "no", "n", "off"})) return 0.0;
  if (is_one_of(small, {"down", "pd", "contact", "touch", "pen"})) return named_up ? 0.0 : 1.0;
  if (is_one_of(small, {"up", "pu", "hover", "hovering", "air"})) return named_up ? 1.0 : 0.0;
  return std::nullopt;
}

}  // namespace

SampleCells::SampleCells(const TableLayout& layout, const TableSettings& settings, DecimalMark decimal)
    : time_(layout.time ? layout.time : layout.replaced_time),
      times_count_(layout.time.has_value()),
      decimal_(decimal),
      named_up_(layout.state_named_up) {
  if (settings.pen_state.empty()) found_state_ = layout.pen_state;
  for (const ColumnChoices* choices :
       {&layout.position, &layout.velocity, &layout.force, &layout.orientation})
    for (const ColumnChoice& choice : *choices) want(choice.column, Cell::number);
  if (layout.pressure) want(*layout.pressure, Cell::number);
  if (layout.time_fraction) want(*layout.time_fraction, times_count_ ? Cell::number : Cell::perhaps_number);
  if (layout.pen_state) want(*layout.pen_state, Cell::state);
  if (layout.stroke_number) want(*layout.stroke_number, Cell::label);
  for (const std::size_t column : layout.perhaps_pen_state) want(column, Cell::perhaps_state);
  for (const std::size_t column : layout.perhaps_stroke_number) want(column, Cell::label);
  if (layout.sample_number) want(*layout.sample_number, Cell::perhaps_number);
}

void SampleCells::want(std::size_t column, Cell cell) {
  const bool known =
      time_ == column || std::any_of(wanted_.begin(), wanted_.end(),
                                     [&](const Wanted& wanted) { return wanted.column == column; });
  if (!known) wanted_.push_back({column, cell});
}

void SampleCells::read(const std::vector<std::string>& fields, SampleTable& table, const std::string& name,
                       std::size_t line) {
  const auto append = [&](std::size_t column, const std::optional<double>& value, const char* right) {
    if (!value)
      throw_input_error("{}:{}: column '{}': '{}' is not {}; correct or remove the line", name, line,
                        table.columns[column].name, excerpt(fields[column]), right);
    table.columns[column].values.push_back(*value);
  };
  if (time_) {
    const auto time = time_of(fields[*time_]);
    append(*time_, time || times_count_ ? time : missing_value,
           "a time in the format of the rows before, or a finite number");
  }
  for (Wanted& wanted : wanted_)
    append(wanted.column, value_of(fields[wanted.column], wanted, table),
           wanted.cell == Cell::state ? "0, 1 or a word such as up or down" : "a finite number");
}

void SampleCells::finish(SampleTable& table, const std::string& name) const {
  if (!unknown_state_.empty()) {
    SampleColumn& state = table.columns[*found_state_];
    state.values.clear();
    table.warnings.push_back(fmt::format(
        "{}: column '{}' is not taken for the pen's state, because '{}' is not 0, 1 or a word such as up or "
        "down; name the column of the state with {}, or set that to none",
        name, state.name, excerpt(unknown_state_), option_and_key("pen_state")));
  }
  if (!time_) return;
  SampleColumn& time = table.columns[*time_];
  time.origin = stamps_.origin();
  if (stamps_.iso()) time.unit = iso_unit;
}

std::optional<double> SampleCells::time_of(const std::string& field) {
  if (is_missing(field)) return missing_value;
  if (decimal_ == DecimalMark::point) return stamps_.read(field);
  std::string plain = field;
  std::replace(plain.begin(), plain.end(), ',', '.');
  return stamps_.read(plain);
}

std::optional<double> SampleCells::value_of(const std::string& field, Wanted& wanted,
                                            const SampleTable& table) {
  if (const auto value = field_number(field, decimal_)) return value;
  if (is_missing(field) || wanted.cell == Cell::perhaps_number) return missing_value;
  if (wanted.cell == Cell::perhaps_state)
    return state_in_words(small_letters(field), false).value_or(missing_value);
  if (wanted.cell == Cell::state) {
    const auto state = state_of(field, table.columns[wanted.column]);
    if (state || wanted.column != found_state_) return state;
    if (unknown_state_.empty()) unknown_state_ = field;
    return missing_value;
  }
  if (wanted.cell != Cell::label) return std::nullopt;
  if (field != wanted.label) ++wanted.labels;  // another text, another number
  wanted.label = field;
  return wanted.labels;
}

/// In events of a pointer, "move" changes nothing.
std::optional<double> SampleCells::state_of(const std::string& field, const SampleColumn& column) const {
  const std::string small = small_letters(field);
  if (small != "move") return state_in_words(small, named_up_);
  if (!column.values.empty()) return column.values.back();
  return state_in_words("up", named_up_);
}

std::string excerpt(std::string_view text) {
  constexpr std::size_t most = 60;
  return text.size() <= most ? std::string(text) : std::string(text.substr(0, most)) + "...";
}

}  // namespace sandstroke
