#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/table_settings.h"

struct csv_parser;

namespace sandstroke {

/// How the lines of a table are split into fields. Neither member is `found`.
struct Dialect {
  Separator separator = Separator::comma;
  DecimalMark decimal = DecimalMark::point;
  /// For people: "semicolons, decimal commas".
  std::string text() const;
};

/// Splits lines (libcsv: quotes, any separator).
class LineSplitter {
 public:
  LineSplitter();
  LineSplitter(const LineSplitter&) = delete;
  ~LineSplitter();
  /// The fields (an empty one between two separators, unless those are blanks), trimmed and without their
  /// quotes; valid until the next call.
  const std::vector<std::string>& split(std::string_view line, Separator separator);

 private:
  csv_parser* parser_;
  std::vector<std::string> fields_;
  std::size_t count_ = 0;
  std::string line_;
};

/// A field as a finite number with that decimal mark.
std::optional<double> field_number(const std::string& field, DecimalMark decimal);
/// True for a field that says that it has no value: empty, "nan", "N/A", "null", "-" and the like.
bool is_missing(std::string_view field);
/// True for what a spreadsheet shows in place of a value: "#N/A", "#REF!", "#DIV/0!" and the like.
bool is_spreadsheet_error(std::string_view field);
/// True for a number (also infinite), or a date with a time.
bool is_value(const std::string& field, DecimalMark decimal);

/// The dialect in which most of these lines are rows of numbers of equal length; `columns` becomes that
/// length. What the settings name is kept. None: no dialect gives two columns of numbers.
std::optional<Dialect> find_dialect(const std::vector<std::string>& lines, const TableSettings& settings,
                                    std::size_t& columns);

}  // namespace sandstroke
