#include "import/text_table.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/error.h"
#include "import/column_name.h"
#include "import/dialect.h"
#include "import/json_rows.h"
#include "import/sample_cells.h"
#include "import/table_header.h"
#include "import/table_layout.h"
#include "import/table_option.h"
#include "import/text_lines.h"
#include "import/text_parts.h"

namespace sandstroke {
namespace {

constexpr std::size_t lines_to_look_at = 64;  // for the dialect

bool begins_with_one_of(std::string_view line, const std::vector<std::string>& words) {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    if (word.empty() || !line.starts_with(word)) return false;
    return line.size() == word.size() ||
           std::string_view(" \t,;:").find(line[word.size()]) != std::string::npos;
  });
}

/// A number with commas: "12,040" of 12040.
std::string grouped(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
  return digits;
}

}  // namespace

class TextTable::Rows {
 public:
  Rows(std::string name, const TableSettings& settings, const std::optional<Eigen::Matrix3d>& of_first)
      : name_(std::move(name)),
        settings_(settings),
        of_first_(of_first),
        skip_(parts_of_list(settings.skip)),
        pen_up_(parts_of_list(settings.pen_up)),
        lines_(name_, settings.encoding) {}

  void read(std::string_view bytes) {
    lines_.read(bytes, [this](std::string_view line, std::size_t number) { take_numbered(line, number); });
  }

  SampleTable take() {
    lines_.end([this](std::string_view line, std::size_t number) { take_numbered(line, number); });
    if (!dialect_) begin_rows();
    if (table_.lines.empty()) throw_input_error("{}: has no samples; add at least one row", name_);
    cells_.finish(table_, name_);
    table_.description = fmt::format(
        "{}{}, {} columns, {} rows", lines_.encoding().empty() ? "" : lines_.encoding() + ", ",
        json_ ? "lines of JSON" : dialect_->text(), table_.columns.size(), grouped(table_.lines.size()));
    if (!pen_up_.empty() && !lifted_)
      table_.warnings.push_back(fmt::format("{}: no line begins with {}, so the pen never lifts; correct {}",
                                            name_, settings_.pen_up, option_and_key("pen_up")));
    if (has_no_header_) table_.description += ", no header";
    if (has_row_names_) table_.description += ", names of rows in the first one";
    if (shape_.fields > table_.columns.size()) table_.description += ", separators at the end of rows";
    return std::move(table_);
  }

 private:
  /// A line that waits until the dialect is known.
  struct Line {
    std::size_t number;
    std::string text;
    bool lifts;
  };

  void take_numbered(std::string_view line, std::size_t number) {
    line_ = number;
    if (line_ > static_cast<std::size_t>(settings_.skip_lines)) take_line(line);
  }

  void take_line(std::string_view with_tabs) {
    const std::string_view line = without_blanks(with_tabs, " \t");
    const bool nothing_before = !dialect_ && waiting_.empty();
    if (with_tabs.empty() || (line.empty() && nothing_before) || begins_with_one_of(line, skip_)) return;
    const bool lifts = begins_with_one_of(line, pen_up_);
    lifted_ = lifted_ || lifts;
    if (!lifts && is_comment(line)) {
      if (waiting_rows_ == 0 && !dialect_) comment_ = line.substr(1);
      return;
    }
    if (line_ == 1 && with_tabs.size() == 5 && with_tabs.starts_with("sep=")) {  // Excel writes it
      const auto separator = std::string_view(" ,;\t").find(with_tabs[4]);
      if (separator != std::string_view::npos && separator > 0) {
        if (settings_.separator == Separator::found) settings_.separator = static_cast<Separator>(separator);
        return;
      }
    }
    if (json_ || (nothing_before && begin_json(line))) {
      if (!line.empty()) take_row(json_->split(line, fmt::format("{}:{}", name_, line_)));
      return;
    }
    if (dialect_) {
      take_fields(with_tabs, lifts);
      return;
    }
    waiting_.push_back({line_, std::string(with_tabs), lifts});
    waiting_rows_ += lifts ? 0 : 1;
    if (waiting_rows_ == lines_to_look_at) begin_rows();
  }

  /// True if the first line is an object of JSON: then all are.
  bool begin_json(std::string_view line) {
    std::vector<std::string> names = JsonRows::names_in(line);
    if (names.empty()) return false;
    if (!settings_.columns.empty())
      throw_input_error("{}: lines of JSON name the columns themselves; leave out {}", name_,
                        option_and_key("columns"));
    dialect_ = {Separator::comma, DecimalMark::point};  // of the numbers' texts
    set_columns(names, fmt::format("{}:{}", name_, line_));
    json_.emplace(std::move(names));
    return true;
  }

  static bool is_blank(std::string_view line) { return line.find_first_not_of('\t') == std::string::npos; }

  /// True for a comment. A row may begin with the error of a spreadsheet's cell, too.
  bool is_comment(std::string_view line) const {
    if (!line.starts_with('#')) return line.starts_with('%');
    return json_ || !is_spreadsheet_error(line.substr(0, line.find_first_of(" \t,;")));
  }

  /// True for a comment that begins as a row would.
  bool is_late_comment(std::string_view line, std::size_t fields) const {
    return line.starts_with('#') && fields != shape_.fields &&
           (table_.columns.empty() || fields != table_.columns.size());
  }

  /// Takes a line when the dialect is known. One of tabs alone is a row of empty fields, if it has enough of
  /// them.
  void take_fields(std::string_view line, bool lifts) {
    if (lifts) {
      if (!table_.lifts.empty()) table_.lifts.back() = true;
      return;
    }
    const std::vector<std::string>& fields = splitter_.split(line, dialect_->separator);
    if (is_late_comment(line, fields.size())) return;
    const bool is_row =
        !is_blank(line) || (dialect_->separator == Separator::tab && fields.size() >= table_.columns.size());
    if (is_row) take_row(fields);
  }

  /// Finds the dialect, and reads what waited for it.
  void begin_rows() {
    std::vector<std::string> lines;
    for (const Line& line : waiting_)
      if (!line.lifts && !is_blank(line.text)) lines.push_back(line.text);
    if (lines.empty())
      throw_input_error("{}: is empty; give a table with one row per sample, and a header above", name_);
    std::size_t fields_of_most = 0;
    dialect_ = find_dialect(lines, settings_, fields_of_most);
    if (!dialect_) refuse(lines);
    shape_ = row_shape(lines, *dialect_, fields_of_most);
    refuse_thousands(lines);
    const std::size_t last = line_;
    for (const Line& line : std::exchange(waiting_, {})) {
      line_ = line.number;
      take_fields(line.text, line.lifts);
    }
    line_ = last;
  }

  [[noreturn]] void refuse(const std::vector<std::string>& lines) const {
    if (lines.size() == 1) throw_input_error("{}: has no samples; add at least one row", name_);
    const auto second = std::find_if(waiting_.begin() + 1, waiting_.end(),
                                     [](const Line& l) { return !l.lifts && !is_blank(l.text); });
    throw_input_error(
        "{}:{}: '{}' is not a row of two or more numbers, with any known separator and decimal mark; give a "
        "table with one row per sample (--skip-lines and --skip leave out other lines)",
        name_, second->number, excerpt(second->text));
  }

  /// Refuses quoted "1,000" between commas, which is a thousand or 1.
  void refuse_thousands(const std::vector<std::string>& lines) {
    if (settings_.decimal != DecimalMark::found || dialect_->decimal != DecimalMark::comma ||
        dialect_->separator != Separator::comma)
      return;
    std::string first;
    for (const std::string& line : lines)
      for (const std::string& field : splitter_.split(line, Separator::comma)) {
        const std::size_t comma = field.find(',');
        if (comma == std::string::npos || !field_number(field, DecimalMark::comma)) continue;
        if (field.size() != comma + 4) return;  // not three digits after it
        if (first.empty()) first = field;
      }
    if (!first.empty())
      throw_input_error(
          "{}: the comma in \"{}\" may separate thousands or decimals; give {}, or save the table without "
          "thousands separators",
          name_, first, option_and_key("decimal"));
  }

  void take_row(const std::vector<std::string>& fields) {
    if ((table_.columns.empty() || after_header_) && empty_from(fields, 0)) return;
    if (table_.columns.empty()) {
      if (!settings_.columns.empty()) {
        set_columns(parts_of_list(settings_.columns), "--columns");
      } else if (take_header(fields)) {
        return;
      }
    } else if (after_header_ && take_units(fields)) {
      return;
    }
    if (after_header_) begin_samples();
    take_sample(fields);
  }

  /// True if the row is a header, and no sample.
  bool take_header(const std::vector<std::string>& fields) {
    const std::string here = fmt::format("{}:{}", name_, line_);
    const std::optional<TableHeader> header = table_header(fields, comment_, *dialect_, shape_);
    if (!header)
      throw_input_error(
          "{}: the first line has {} fields ({}), but most lines have {}; leave it out with {} or {}", here,
          fields.size(), excerpt(fmt::format("{}", fmt::join(fields, ", "))), shape_.fields,
          option_and_key("skip_lines"), option_and_key("skip"));
    has_no_header_ = !header->found;
    has_row_names_ = header->has_row_names;
    set_columns(header->names, header->found ? here : here + " (no header names the columns)");
    return header->is_row;
  }

  void set_columns(const std::vector<std::string>& names, const std::string& location) {
    for (const std::string& name : names) table_.columns.push_back({name, column_name(name).unit, {}, 0});
    location_ = location;
    after_header_ = true;
  }

  bool take_units(const std::vector<std::string>& fields) {
    const std::size_t count = table_.columns.size();
    if (fields.size() < count || !empty_from(fields, count) || !is_row_of_units(fields, *dialect_))
      return false;
    for (std::size_t i = 0; i < count; ++i)
      if (table_.columns[i].unit.empty()) table_.columns[i].unit = bare_unit(fields[i]);
    return true;
  }

  void begin_samples() {
    after_header_ = false;
    cells_ = SampleCells(table_layout(table_.columns, settings_, location_, of_first_), settings_,
                         dialect_->decimal);
  }

  void take_sample(const std::vector<std::string>& fields) {
    const std::size_t count = table_.columns.size();
    if (fields.size() != count && (fields.size() < count || !empty_from(fields, count))) {
      throw_input_error("{}:{}: {} fields instead of {} ({}); correct or remove the line", name_, line_,
                        fields.size(), count, all_names());
    }
    cells_.read(fields, table_, name_, line_);
    table_.lines.push_back(line_);
    if (!pen_up_.empty()) table_.lifts.push_back(false);
  }

  std::string all_names() const {
    std::vector<std::string> names;
    for (const SampleColumn& column : table_.columns) names.push_back(column.name);
    return fmt::format("{}", fmt::join(names, ", "));
  }

  std::string name_;
  TableSettings settings_;
  std::optional<Eigen::Matrix3d> of_first_;
  std::vector<std::string> skip_, pen_up_;
  bool lifted_ = false;  // a line began with one of pen_up_
  TextLines lines_;
  std::size_t line_ = 0;  // number of the line that is taken
  std::vector<Line> waiting_;
  std::size_t waiting_rows_ = 0;
  std::string comment_;  // the last one before the first row
  std::optional<Dialect> dialect_;
  RowShape shape_;
  std::optional<JsonRows> json_;
  LineSplitter splitter_;
  std::string location_;       // of the columns' names
  bool after_header_ = false;  // no sample yet
  bool has_no_header_ = false, has_row_names_ = false;
  SampleCells cells_;
  SampleTable table_;
};

TextTable::TextTable(std::string name, const TableSettings& settings,
                     const std::optional<Eigen::Matrix3d>& of_first)
    : rows_(std::make_unique<Rows>(std::move(name), settings, of_first)) {}
TextTable::TextTable(TextTable&&) noexcept = default;
TextTable::~TextTable() = default;
void TextTable::read(std::string_view bytes) { rows_->read(bytes); }
SampleTable TextTable::take() { return rows_->take(); }

}  // namespace sandstroke
