#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "haptics/table_settings.h"
#include "import/sample_table.h"

namespace sandstroke {

/// Reads a table of samples as text: rows of numbers, one per sample, in any common dialect and of any
/// length. It keeps only the columns of the stroke. It finds what the settings do not name:
///
/// - the encoding by a byte-order mark or UTF-16's zeros; separator and decimal mark from the first rows
///   (Excel's line sep=; is obeyed);
/// - a header: the first row without a number, or the comment before the first row if it has as many words
///   (numpy); a row of units under it; R's header that lacks the column of row names. Separators at the end
///   of rows are no columns.
///
/// It passes over blank lines, comments (# or %), and what settings.skip and skip_lines name. A cell that is
/// empty or says NaN is NaN in the table; so is other text in a column that only perhaps tells of a pen.
class TextTable {
 public:
  /// name: the file's name in messages. of_first: as in table_layout().
  TextTable(std::string name, const TableSettings& settings,
            const std::optional<Eigen::Matrix3d>& of_first = {});
  TextTable(TextTable&&) noexcept;
  ~TextTable();
  /// Takes the next part of the file, cut anywhere. Error: input, naming the line.
  void read(std::string_view bytes);
  /// Returns the table. Call it once, at the end. Error: input.
  SampleTable take();

 private:
  class Rows;
  std::unique_ptr<Rows> rows_;
};

}  // namespace sandstroke
