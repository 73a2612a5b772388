#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include "hdf5/hdf5_writer.h"

namespace sandstroke {

/// A column of results: a number or a text per row. Not-a-number: the row has no value in this column.
struct TableColumn {
  std::string name;   ///< as in files
  std::string title;  ///< for people
  std::string unit;   ///< empty: none
  std::variant<std::vector<double>, std::vector<std::string>> values;
};

/// Results of many runs: columns of equal length.
struct Table {
  std::vector<TableColumn> columns;
  std::size_t rows() const;
};

/// CSV (RFC 4180): names in the first line, an empty field if there is no number, quotes around fields with
/// commas or quotes.
std::string csv_text(const Table& table);
/// The same, for a table of any length.
void write_csv(std::ostream& file, const Table& table);

/// Writes one dataset of rank 1 per column into the group, with its title and unit as attributes.
void write_table(Hdf5Writer& file, const std::string& group, const Table& table);

/// The number, or null for infinity and not-a-number, which JSON does not have.
nlohmann::ordered_json number_or_null(double value);

/// {column: value} of a row; null if there is no number.
nlohmann::ordered_json row_json(const Table& table, std::size_t row);
/// [{name, title, unit}].
nlohmann::ordered_json columns_json(const Table& table);

/// Aligned text with the titles above, for a terminal. Numbers with `digits` significant ones.
std::string aligned_text(const Table& table, int digits = 4);

}  // namespace sandstroke
