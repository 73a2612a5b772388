#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "import/dialect.h"

namespace sandstroke {

/// The length of a table's rows.
struct RowShape {
  std::size_t fields = 0;  ///< of most rows
  std::size_t spare = 0;   ///< last fields that are empty in all of these rows: separators at their ends
  /// The first fields of these rows are no numbers, or count from 0 or 1: they may be names of the rows.
  bool may_have_names = false;
};
RowShape row_shape(const std::vector<std::string>& lines, const Dialect& dialect, std::size_t fields_of_most);

/// The names of a table's columns. A column without a name has its number, from 1 on.
struct TableHeader {
  std::vector<std::string> names;
  bool is_row = false;         ///< the row that was looked at names the columns, and is no sample
  bool found = false;          ///< the row or the comment names them
  bool has_row_names = false;  ///< the rows' first field has no name in the header
};

/// Looks for names in the first row, else in the comment above it. A header may have separators at its end,
/// or lack those of the rows. It may lack the name of the first column, as R writes it, if the rows may have
/// names; a last field that is empty in every row is no sign of that. None: the row is neither a header nor
/// as long as the others.
std::optional<TableHeader> table_header(const std::vector<std::string>& row, const std::string& comment,
                                        const Dialect& dialect, const RowShape& shape);

/// True for a row of units below the header: no number, and at least one known unit.
bool is_row_of_units(const std::vector<std::string>& row, const Dialect& dialect);
/// The unit in a field, as unit_symbol() and without brackets: mm of "[mm]"; empty for "-".
std::string bare_unit(const std::string& field);

/// True if the fields from that one on are empty.
bool empty_from(const std::vector<std::string>& fields, std::size_t first);

}  // namespace sandstroke
