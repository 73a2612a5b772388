#include "import/sample_cells.h"

#include <algorithm>
#include <cctype>
#include <limits>

#include "core/error.h"
#include "import/dialect.h"

namespace sandstroke {
namespace {

constexpr double missing_value = std::numeric_limits<double>::quiet_NaN();

/// A pen's state as a number: "true" and "down" are 1, "false" and "up" 0.
std::optional<double> state_in_words(const std::string& field) {
  std::string small = field.substr(0, 6);
  for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* word : {"true", "down", "yes", "on"})
    if (small == word) return 1.0;
  for (const char* word : {"false", "up", "no", "off"})
    if (small == word) return 0.0;
  return std::nullopt;
}

}  // namespace

SampleCells::SampleCells(const TableLayout& layout, DecimalMark decimal)
    : time_(layout.time ? layout.time : layout.replaced_time),
      times_count_(layout.time.has_value()),
      decimal_(decimal) {
  for (const ColumnChoices* choices :
       {&layout.position, &layout.velocity, &layout.force, &layout.orientation})
    for (const ColumnChoice& choice : *choices) want(choice.column, Cell::number);
  for (const std::optional<std::size_t>& column : {layout.pressure, layout.time_fraction})
    if (column) want(*column, Cell::number);
  if (layout.pen_state) want(*layout.pen_state, Cell::state);
  if (layout.stroke_number) want(*layout.stroke_number, Cell::label);
  for (const std::size_t column : layout.perhaps_pen_state) want(column, Cell::perhaps);
  for (const std::size_t column : layout.perhaps_stroke_number) want(column, Cell::perhaps);
  if (layout.sample_number) want(*layout.sample_number, Cell::perhaps);
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
  for (const Wanted& wanted : wanted_)
    append(wanted.column, value_of(fields[wanted.column], wanted.cell), "a finite number");
}

void SampleCells::finish(SampleTable& table) const {
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

std::optional<double> SampleCells::value_of(const std::string& field, Cell cell) {
  if (const auto value = field_number(field, decimal_)) return value;
  if (is_missing(field) || cell == Cell::perhaps) return missing_value;
  if (cell == Cell::state) return state_in_words(field);
  if (cell != Cell::label) return std::nullopt;
  if (field != label_) ++labels_;  // another text, another number
  label_ = field;
  return labels_;
}

std::string excerpt(std::string_view text) {
  constexpr std::size_t most = 60;
  return text.size() <= most ? std::string(text) : std::string(text.substr(0, most)) + "...";
}

}  // namespace sandstroke
