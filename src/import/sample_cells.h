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
/// that only perhaps tell of a pen's state, other text is NaN. So it is in a column of states that nobody
/// named, which is emptied at the end then, with a warning.
class SampleCells {
 public:
  SampleCells() = default;
  SampleCells(const TableLayout& layout, const TableSettings& settings, DecimalMark decimal);

  /// Appends a row to the columns that are used. Error: input; `name` and `line` say where the row stands.
  void read(const std::vector<std::string>& fields, SampleTable& table, const std::string& name,
            std::size_t line);
  /// Notes the clock of the times, after the last row. `name` is the table's.
  void finish(SampleTable& table, const std::string& name) const;

 private:
  enum class Cell { number, state, label, perhaps_state, perhaps_number };
  struct Wanted {
    std::size_t column;
    Cell cell;
    std::string label = {};  // the last text in a column of stroke numbers
    double labels = 0x1p52;  // grows where it changes; larger than the numbers of strokes beside texts
  };

  void want(std::size_t column, Cell cell);
  std::optional<double> time_of(const std::string& field);
  std::optional<double> value_of(const std::string& field, Wanted& wanted, const SampleTable& table);
  std::optional<double> state_of(const std::string& field, const SampleColumn& column) const;

  std::optional<std::size_t> time_;
  bool times_count_ = false;    // a rate or a speed does not replace them
  std::vector<Wanted> wanted_;  // columns to read, except the time
  DecimalMark decimal_ = DecimalMark::point;
  TimeStamps stamps_;
  std::optional<std::size_t> found_state_;  // a column of states that nobody named
  bool named_up_ = false;                   // TableLayout::state_named_up
  std::string unknown_state_;               // a text in it that tells no state
};

/// The beginning of a text, short enough for a sentence.
std::string excerpt(std::string_view text);

}  // namespace sandstroke
