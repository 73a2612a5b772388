#pragma once

#include <string>
#include <vector>

#include "import/sample_table.h"
#include "import/table_layout.h"
#include "import/units.h"

namespace sandstroke {

/// A unit, and what the user or the table calls it.
struct NamedUnit {
  std::string name;
  Unit unit;                    ///< of the first column
  std::vector<Unit> each = {};  ///< one per column, if they differ
  const Unit& of(std::size_t column) const { return each.empty() ? unit : each[column]; }
};

/// The columns that a stroke takes from a table, and the samples that lack a value in them.
struct UsedColumns {
  TableLayout layout;  ///< without the optional columns that are left out
  NamedUnit length, speed, force;
  std::vector<bool> missing;          ///< one per sample
  std::vector<std::string> notes;     ///< for the description: what is left out
  std::vector<std::string> warnings;  ///< a sentence each
  std::vector<std::string> asks;      ///< what the user has to give
};

/// Finds the units of the layout's columns, and which of these the stroke takes. An optional column that
/// nobody named is left out if its unit is not known or values are missing; one that is named is needed, and
/// a sample without its value is missing. is_second: of two tables that are merged, which needs force and
/// orientation. Error: input.
UsedColumns used_columns(const SampleTable& table, const TableLayout& layout, const TableSettings& settings,
                         const std::string& name, bool is_second);

/// The names of columns with their signs, as an option takes them: "x,-z" (or "x, -z" for people).
std::string names_of(const SampleTable& table, const ColumnChoices& choices, const char* between = ", ");

}  // namespace sandstroke
