#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/table_settings.h"
#include "import/sample_table.h"
#include "import/table_layout.h"
#include "import/time_stamp.h"

namespace sandstroke {

/// Reads those cells of a text's rows that the stroke needs. Numbers stay numbers; a cell without a value is
/// NaN. The pen's state may be true or down, false or up; the number of a stroke may be any text. In columns
/// that only perhaps tell of a pen, text is NaN.
class SampleCells {
 public:
  SampleCells() = default;
  SampleCells(const TableLayout& layout, DecimalMark decimal);

  /// Appends a row to the columns that are used. Error: input; `name` and `line` say where the row stands.
  void read(const std::vector<std::string>& fields, SampleTable& table, const std::string& name,
            std::size_t line);
  /// Notes the clock of the times, after the last row.
  void finish(SampleTable& table) const;

 private:
  enum class Cell { number, state, label, perhaps };
  struct Wanted {
    std::size_t column;
    Cell cell;
  };

  void want(std::size_t column, Cell cell);
  std::optional<double> time_of(const std::string& field);
  std::optional<double> value_of(const std::string& field, Cell cell);

  std::optional<std::size_t> time_;
  bool times_count_ = false;    // a rate or a speed does not replace them
  std::vector<Wanted> wanted_;  // columns to read, except the time
  DecimalMark decimal_ = DecimalMark::point;
  TimeStamps stamps_;
  std::string label_;    // the last text in the column of stroke numbers
  double labels_ = 0.0;  // how often it changed
};

/// The beginning of a text, short enough for a sentence.
std::string excerpt(std::string_view text);

}  // namespace sandstroke
