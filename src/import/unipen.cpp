#include "import/unipen.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/input_file.h"
#include "import/sample_checks.h"
#include "import/text_parts.h"

namespace sandstroke {
namespace {

class UnipenReader {
 public:
  explicit UnipenReader(const std::string& name) : name_(name) {}

  void take_line(std::string_view line, std::size_t number) {
    line_ = number;
    if (line.starts_with('.')) {
      take_keyword(cut_word(line), line);
    } else if (part_ != Part::text && !line.empty()) {
      take_row(line);
    }
  }

  SampleTable table();

 private:
  enum class Part { text, down, up };

  void take_keyword(std::string_view keyword, std::string_view rest) {
    part_ = Part::text;
    if (keyword == ".PEN_DOWN" || keyword == ".PEN_UP") {
      if (!table_.lifts.empty()) table_.lifts.back() = true;
      part_ = keyword == ".PEN_DOWN" ? Part::down : Part::up;
      if (!without_blanks(rest).empty()) take_row(rest);
    } else if (keyword == ".COORD") {
      take_columns(rest);
    } else if (keyword == ".DT") {
      waited_ += 1e-3 * number_after(keyword, rest);
    } else if (keyword == ".POINTS_PER_SECOND") {
      rate_ = above_zero(keyword, rest);
    } else if (keyword == ".X_POINTS_PER_INCH" || keyword == ".Y_POINTS_PER_INCH") {
      points_per_mm_[keyword[1] == 'X' ? "x" : "y"] = above_zero(keyword, rest) / 25.4;
    } else if (keyword == ".X_POINTS_PER_MM" || keyword == ".Y_POINTS_PER_MM") {
      points_per_mm_[keyword[1] == 'X' ? "x" : "y"] = above_zero(keyword, rest);
    }
  }

  double number_after(std::string_view keyword, std::string_view rest) const {
    if (const std::optional<double> number = finite_number(cut_word(rest))) return *number;
    throw_input_error("{}:{}: {} needs a number; correct or remove the line", name_, line_, keyword);
  }
  double above_zero(std::string_view keyword, std::string_view rest) const {
    const double number = number_after(keyword, rest);
    if (number > 0.0) return number;
    throw_input_error("{}:{}: {} is {}, but must be above 0; correct or remove the line", name_, line_,
                      keyword, number);
  }

  void take_columns(std::string_view rest) {
    std::vector<std::string> names;
    for (std::string_view word = cut_word(rest); !word.empty(); word = cut_word(rest))
      names.push_back(column_name(word));
    if (rows_ > 0 && names != names_)
      throw_input_error("{}:{}: .COORD changes the columns within the file; split the file before this line",
                        name_, line_);
    for (const char* needed : {"x", "y"})
      if (std::count(names.begin(), names.end(), needed) != 1)
        throw_input_error("{}:{}: .COORD must name X and Y once each; correct it", name_, line_);
    if (names.size() > 100)
      throw_input_error("{}:{}: .COORD names more than 100 columns; correct it", name_, line_);
    names_ = names;
  }

  static std::string column_name(std::string_view word) {
    const std::map<std::string_view, const char*> names{
        {"X", "x"}, {"Y", "y"}, {"Z", "z"}, {"T", "time"}, {"P", "pressure"}};
    const auto found = names.find(word);
    return found == names.end() ? std::string(word) : found->second;
  }

  void take_row(std::string_view line) {
    if (table_.columns.empty())
      for (const std::string& name : names_) table_.columns.push_back({name, name == "time" ? "ms" : "", {}});
    std::vector<double> row;
    for (std::string_view rest = line, word = cut_word(rest); !word.empty(); word = cut_word(rest)) {
      const std::optional<double> number = finite_number(word);
      if (!number)
        throw_input_error("{}:{}: '{}' is not a finite number; correct or remove the line", name_, line_,
                          word.substr(0, 40));
      row.push_back(*number);
    }
    if (row.size() != names_.size()) {
      throw_input_error("{}:{}: {} numbers instead of {} (.COORD: {}); correct or remove the line", name_,
                        line_, row.size(), names_.size(), fmt::join(names_, " "));
    }
    const double time = rate_ > 0.0 ? static_cast<double>(rows_) / rate_ + waited_ : 0.0;
    ++rows_;
    if (part_ != Part::down) return;
    for (std::size_t i = 0; i < row.size(); ++i) table_.columns[i].values.push_back(row[i]);
    times_.push_back(time);
    table_.lines.push_back(line_);
    table_.lifts.push_back(false);
  }

  const std::string& name_;
  std::size_t line_ = 0;
  Part part_ = Part::text;
  std::vector<std::string> names_{"x", "y"};
  std::map<std::string, double> points_per_mm_;
  double rate_ = 0.0, waited_ = 0.0;  // Hz, s
  std::size_t rows_ = 0;              // also those with the pen up
  std::vector<double> times_;         // s
  SampleTable table_;
};

SampleTable UnipenReader::table() {
  if (table_.size() == 0)
    throw_input_error("{}: has no samples after .PEN_DOWN; give a file with pen strokes", name_);
  const bool has_time = std::count(names_.begin(), names_.end(), "time") > 0;
  for (SampleColumn& column : table_.columns) {
    if (points_per_mm_.size() < 2 || !points_per_mm_.contains(column.name)) continue;
    column.unit = "mm";
    for (double& value : column.values) value /= points_per_mm_.at(column.name);
  }
  if (!has_time && rate_ > 0.0) table_.columns.push_back({"time", "s", std::move(times_)});
  const auto strokes = 1 + std::count(table_.lifts.begin(), table_.lifts.end() - 1, true);
  table_.description = fmt::format("UNIPEN: {} pen strokes, {} samples, columns {}, y is taken to point up",
                                   strokes, table_.size(), fmt::join(names_, ", "));
  return std::move(table_);
}

}  // namespace

SampleTable parse_unipen(std::string_view text, const std::string& name) {
  text = without_byte_order_mark(text);
  UnipenReader reader(name);
  for (std::size_t number = 1; !text.empty(); ++number) reader.take_line(cut_line(text), number);
  return finite_samples(reader.table(), name);
}

SampleTable read_unipen(const std::filesystem::path& path) {
  return parse_unipen(read_text_file(path, most_sample_text_bytes), path.string());
}

bool looks_like_unipen(std::string_view text) {
  while (!text.empty()) {
    std::string_view line = cut_line(text);
    const std::string_view word = cut_word(line);
    if (word == ".PEN_DOWN" || word == ".COORD") return true;
  }
  return false;
}

}  // namespace sandstroke
