#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/table_settings.h"

struct csv_parser;

namespace sandstroke {

/// How lines of a table are parted into fields; neither is `found`.
struct Dialect {
  Separator separator = Separator::comma;
  DecimalMark decimal = DecimalMark::point;
  /// "semicolons, decimal commas".
  std::string text() const;
};

/// Splits lines (libcsv: quotes, any separator).
class LineSplitter {
 public:
  LineSplitter();
  LineSplitter(const LineSplitter&) = delete;
  ~LineSplitter();
  /// The fields, trimmed, without their quotes; there until the next call.
  const std::vector<std::string>& split(std::string_view line, Separator separator);

 private:
  csv_parser* parser_;
  std::vector<std::string> fields_;
  std::size_t count_ = 0;
  std::string line_;
};

/// A field as a number, with that decimal mark; finite.
std::optional<double> field_number(const std::string& field, DecimalMark decimal);
/// A number (also not-a-number), or a date with a time.
bool is_value(const std::string& field, DecimalMark decimal);

/// The dialect in which most of these lines are rows of numbers of equal length; `columns` is that length.
/// What the settings say is taken. Nothing: in none are there two columns of numbers.
std::optional<Dialect> find_dialect(const std::vector<std::string>& lines, const TableSettings& settings,
                                    std::size_t& columns);

}  // namespace sandstroke
