#include "import/table_header.h"

#include <algorithm>

#include "import/text_parts.h"
#include "import/units.h"

namespace sandstroke {
namespace {

std::size_t length_without_empty_end(const std::vector<std::string>& fields) {
  std::size_t length = fields.size();
  while (length > 0 && fields[length - 1].empty()) --length;
  return length;
}

bool has_value(const std::vector<std::string>& fields, const Dialect& dialect) {
  return std::any_of(fields.begin(), fields.end(),
                     [&](const std::string& field) { return is_value(field, dialect.decimal); });
}

bool is_header(const std::vector<std::string>& fields, const Dialect& dialect) {
  return !has_value(fields, dialect) && !std::all_of(fields.begin(), fields.end(), is_missing);
}

/// How many of the fields are names of columns, if they fit to the rows.
std::optional<std::size_t> names_that_fit(const std::vector<std::string>& fields, const RowShape& shape) {
  const std::size_t named = length_without_empty_end(fields), without_spare = shape.fields - shape.spare;
  if (named > shape.fields || fields.size() < without_spare) return std::nullopt;
  return std::max(named, without_spare);
}

/// Trims names that were quoted with blanks, and numbers those that are empty.
void number_unnamed(std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    names[i] = std::string(without_blanks(names[i]));
    if (names[i].empty()) names[i] = std::to_string(i + 1);
  }
}

/// True if no text is a number, or all count from 0 or 1.
bool may_be_names(const std::vector<std::string>& texts, DecimalMark decimal) {
  std::vector<double> numbers;
  for (const std::string& text : texts)
    if (const auto number = field_number(text, decimal)) numbers.push_back(*number);
  if (numbers.empty()) return true;
  if (numbers.size() < texts.size() || (numbers[0] != 0.0 && numbers[0] != 1.0)) return false;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] != numbers[0] + static_cast<double>(i)) return false;
  return true;
}

}  // namespace

RowShape row_shape(const std::vector<std::string>& lines, const Dialect& dialect,
                   std::size_t fields_of_most) {
  LineSplitter splitter;
  RowShape shape{fields_of_most, fields_of_most};
  std::vector<std::string> first;
  for (const std::string& line : lines) {
    const std::vector<std::string>& fields = splitter.split(line, dialect.separator);
    if (fields.size() != shape.fields || !has_value(fields, dialect)) continue;
    shape.spare = std::min(shape.spare, fields.size() - length_without_empty_end(fields));
    first.push_back(fields[0]);
  }
  shape.may_have_names = may_be_names(first, dialect.decimal);
  if (shape.spare == shape.fields) shape.spare = 0;
  return shape;
}

std::optional<TableHeader> table_header(const std::vector<std::string>& row, const std::string& comment,
                                        const Dialect& dialect, const RowShape& shape) {
  TableHeader header;
  const std::optional<std::size_t> fits = names_that_fit(row, shape);
  if (is_header(row, dialect)) {
    header.found = header.is_row = true;
    header.names = row;
    header.has_row_names =
        !fits && row.size() > 1 && row.size() + 1 == shape.fields - shape.spare && shape.may_have_names;
    if (!fits && !header.has_row_names) return std::nullopt;
    if (header.has_row_names)
      header.names.insert(header.names.begin(), "row");
    else
      header.names.resize(*fits);
    number_unnamed(header.names);
    return header;
  }
  if (!fits) return std::nullopt;
  for (const Separator separator : {dialect.separator, Separator::blanks, Separator::comma}) {
    LineSplitter splitter;
    const std::vector<std::string>& names = splitter.split(comment, separator);
    const auto named = names_that_fit(names, shape);
    if (!named || !is_header(names, dialect)) continue;
    header.found = true;
    header.names.assign(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(*named));
    number_unnamed(header.names);
    return header;
  }
  header.names.resize(shape.fields - shape.spare);
  number_unnamed(header.names);
  return header;
}

bool is_row_of_units(const std::vector<std::string>& row, const Dialect& dialect) {
  return !has_value(row, dialect) && std::any_of(row.begin(), row.end(), [](const std::string& field) {
    return is_unit(bare_unit(field));
  });
}

std::string bare_unit(const std::string& field) {
  if (field == "-") return "";
  if (field.size() > 2 && (field.front() == '[' || field.front() == '('))
    return unit_symbol(field.substr(1, field.size() - 2));
  return unit_symbol(field);
}

bool empty_from(const std::vector<std::string>& fields, std::size_t first) {
  return std::all_of(fields.begin() + static_cast<std::ptrdiff_t>(std::min(first, fields.size())),
                     fields.end(), [](const std::string& field) { return field.empty(); });
}

}  // namespace sandstroke
