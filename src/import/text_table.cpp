#include "import/text_table.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <optional>
#include <utility>

#include "core/error.h"
#include "import/column_name.h"
#include "import/dialect.h"
#include "import/table_layout.h"
#include "import/text_lines.h"
#include "import/text_parts.h"
#include "import/time_stamp.h"
#include "import/units.h"

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

/// The beginning of a line, short enough for a message.
std::string excerpt(std::string_view line) {
  constexpr std::size_t most = 60;
  return line.size() <= most ? std::string(line) : std::string(line.substr(0, most)) + "...";
}

/// A unit without its brackets: mm of "[mm]".
std::string bare_unit(const std::string& field) {
  if (field.size() > 2 && (field.front() == '[' || field.front() == '('))
    return field.substr(1, field.size() - 2);
  return field;
}

bool is_unit_or_empty(const std::string& field) {
  using enum Quantity;
  const std::string unit = bare_unit(field);
  if (unit.empty() || unit == "-") return true;
  return known_unit(length, unit) || known_unit(time, unit) || known_unit(speed, unit) ||
         known_unit(force, unit);
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
    if (const auto stamps = layout_.time ? layout_.time : layout_.replaced_time) {
      SampleColumn& time = table_.columns[*stamps];
      time.origin = stamps_.origin();
      if (stamps_.iso()) time.unit = iso_unit;
    }
    table_.description =
        fmt::format("{}{}, {} columns, {} rows", lines_.encoding().empty() ? "" : lines_.encoding() + ", ",
                    dialect_->text(), table_.columns.size(), grouped(table_.lines.size()));
    if (!pen_up_.empty() && !lifted_)
      table_.warnings.push_back(fmt::format("{}: no line begins with {}, so the pen never lifts; correct {}",
                                            name_, settings_.pen_up, option_and_key("pen_up")));
    if (has_no_header_) table_.description += ", no header";
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

  void take_line(std::string_view line) {
    if (line.empty() || begins_with_one_of(line, skip_)) return;
    const bool lifts = begins_with_one_of(line, pen_up_);
    lifted_ = lifted_ || lifts;
    if (!lifts && (line[0] == '#' || line[0] == '%')) {
      if (waiting_rows_ == 0 && !dialect_) comment_ = line.substr(1);
      return;
    }
    if (line_ == 1 && line.size() == 5 && line.starts_with("sep=")) {  // Excel writes it
      const auto separator = std::string_view(" ,;\t").find(line[4]);
      if (separator != std::string_view::npos && separator > 0) {
        if (settings_.separator == Separator::found) settings_.separator = static_cast<Separator>(separator);
        return;
      }
    }
    if (dialect_) {
      if (lifts)
        lift();
      else
        take_row(splitter_.split(line, dialect_->separator));
      return;
    }
    waiting_.push_back({line_, std::string(line), lifts});
    waiting_rows_ += lifts ? 0 : 1;
    if (waiting_rows_ == lines_to_look_at) begin_rows();
  }

  void lift() {
    if (!table_.lifts.empty()) table_.lifts.back() = true;
  }

  /// Finds the dialect, and reads what waited for it.
  void begin_rows() {
    std::vector<std::string> lines;
    for (const Line& line : waiting_)
      if (!line.lifts) lines.push_back(line.text);
    if (lines.empty())
      throw_input_error("{}: is empty; give a table with one row per sample, and a header above", name_);
    dialect_ = find_dialect(lines, settings_, fields_of_most_);
    if (!dialect_) refuse(lines);
    refuse_thousands(lines);
    const std::size_t last = line_;
    for (const Line& line : std::exchange(waiting_, {})) {
      line_ = line.number;
      if (line.lifts)
        lift();
      else
        take_row(splitter_.split(line.text, dialect_->separator));
    }
    line_ = last;
  }

  [[noreturn]] void refuse(const std::vector<std::string>& lines) const {
    if (lines.size() == 1) throw_input_error("{}: has no samples; add at least one row", name_);
    const auto second =
        std::find_if(waiting_.begin() + 1, waiting_.end(), [](const Line& l) { return !l.lifts; });
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
    const auto is_number = [&](const std::string& field) { return is_value(field, dialect_->decimal); };
    const std::string here = fmt::format("{}:{}", name_, line_);
    const bool is_header = std::none_of(fields.begin(), fields.end(), is_number);
    const bool names_all = fields.size() == fields_of_most_ ||
                           (is_header && fields.size() > 1 && fields.size() + 1 == fields_of_most_) ||
                           (fields.size() == fields_of_most_ + 1 && fields.back().empty());
    if (!names_all)
      throw_input_error(
          "{}: the first line has {} fields ({}), but most lines have {}; leave it out with {} or {}", here,
          fields.size(), excerpt(fmt::format("{}", fmt::join(fields, ", "))), fields_of_most_,
          option_and_key("skip_lines"), option_and_key("skip"));
    if (is_header) {
      std::vector<std::string> names = fields;
      if (names.size() + 1 == fields_of_most_) names.insert(names.begin(), "row");  // R leaves it out
      if (names.size() == fields_of_most_ + 1 && names.back().empty()) names.pop_back();
      set_columns(names, here);
      return true;
    }
    for (const Separator separator : {dialect_->separator, Separator::blanks, Separator::comma}) {
      LineSplitter splitter;
      const std::vector<std::string>& names = splitter.split(comment_, separator);
      if (names.size() != fields.size() || std::any_of(names.begin(), names.end(), is_number)) continue;
      set_columns(names, here);
      return false;
    }
    std::vector<std::string> numbers;
    for (std::size_t i = 1; i <= fields.size(); ++i) numbers.push_back(std::to_string(i));
    has_no_header_ = true;
    set_columns(numbers, here + " (no header names the columns)");
    return false;
  }

  void set_columns(const std::vector<std::string>& names, const std::string& location) {
    for (const std::string& name : names) table_.columns.push_back({name, column_name(name).unit, {}, 0});
    location_ = location;
    after_header_ = true;
  }

  bool take_units(const std::vector<std::string>& fields) {
    const bool some =
        std::any_of(fields.begin(), fields.end(), [](const auto& field) { return !field.empty(); });
    if (!some || fields.size() != table_.columns.size() ||
        !std::all_of(fields.begin(), fields.end(), is_unit_or_empty))
      return false;
    for (std::size_t i = 0; i < fields.size(); ++i)
      if (table_.columns[i].unit.empty() && fields[i] != "-") table_.columns[i].unit = bare_unit(fields[i]);
    return true;
  }

  void begin_samples() {
    after_header_ = false;
    layout_ = table_layout(table_.columns, settings_, location_, of_first_);
    const auto want = [&](const ColumnChoices& choices) {
      for (const ColumnChoice& choice : choices) wanted_.push_back(choice.column);
    };
    want(layout_.position);
    want(layout_.velocity);
    want(layout_.force);
    want(layout_.orientation);
    if (layout_.pressure) wanted_.push_back(*layout_.pressure);
    std::sort(wanted_.begin(), wanted_.end());
    wanted_.erase(std::unique(wanted_.begin(), wanted_.end()), wanted_.end());
    if (layout_.time) std::erase(wanted_, *layout_.time);
    for (std::optional<std::size_t>* check : {&layout_.replaced_time, &layout_.sample_number})
      if (*check && (*check == layout_.time || std::binary_search(wanted_.begin(), wanted_.end(), **check)))
        check->reset();  // it is read for something else
  }

  void take_sample(const std::vector<std::string>& fields) {
    const bool ends_with_separator = fields.size() == table_.columns.size() + 1 && fields.back().empty();
    if (fields.size() != table_.columns.size() && !ends_with_separator) {
      throw_input_error("{}:{}: {} fields instead of {} ({}); correct or remove the line", name_, line_,
                        fields.size(), table_.columns.size(), all_names());
    }
    if (layout_.time) {
      const std::string& field = fields[*layout_.time];
      std::string plain = field;
      if (dialect_->decimal == DecimalMark::comma) std::replace(plain.begin(), plain.end(), ',', '.');
      const auto time = stamps_.read(plain);
      if (!time)
        refuse_field(*layout_.time, field, "a time in the format of the rows before, or a finite number");
      table_.columns[*layout_.time].values.push_back(*time);
    }
    read_checks(fields);
    for (const std::size_t column : wanted_) {
      const auto value = field_number(fields[column], dialect_->decimal);
      if (!value) refuse_field(column, fields[column], "a finite number");
      table_.columns[column].values.push_back(*value);
    }
    table_.lines.push_back(line_);
    if (!pen_up_.empty()) table_.lifts.push_back(false);
  }

  /// Reads the columns that only check others. They may hold anything.
  void read_checks(const std::vector<std::string>& fields) {
    const auto nothing = std::numeric_limits<double>::quiet_NaN();
    const auto plain = [&](std::string field) {
      if (dialect_->decimal == DecimalMark::comma) std::replace(field.begin(), field.end(), ',', '.');
      return field;
    };
    if (const auto column = layout_.replaced_time)
      table_.columns[*column].values.push_back(stamps_.read(plain(fields[*column])).value_or(nothing));
    if (const auto column = layout_.sample_number)
      table_.columns[*column].values.push_back(
          field_number(fields[*column], dialect_->decimal).value_or(nothing));
  }

  [[noreturn]] void refuse_field(std::size_t column, const std::string& field, const char* wanted) const {
    throw_input_error("{}:{}: column '{}': '{}' is not {}; correct or remove the line", name_, line_,
                      table_.columns[column].name, excerpt(field), wanted);
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
  std::size_t fields_of_most_ = 0;
  LineSplitter splitter_;
  std::string location_;       // of the columns' names
  bool after_header_ = false;  // no sample yet
  bool has_no_header_ = false;
  TableLayout layout_;
  std::vector<std::size_t> wanted_;  // columns to read, except the time
  TimeStamps stamps_;
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
