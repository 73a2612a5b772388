#include "import/dialect.h"

#include <csv.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <new>

#include "core/small_letters.h"
#include "import/text_parts.h"
#include "import/time_stamp.h"

namespace sandstroke {
namespace {

constexpr unsigned char separator_bytes[] = {',', ',', ';', '\t', ' '};

/// A mark that stands in sentences and headers as well as for a missing value.
bool says_nothing(const std::string& field) { return field.empty() || field == "-" || field == "."; }

/// True for a field that is one of these words, in small or large letters.
template <std::size_t N>
bool is_among(const std::string_view (&words)[N], std::string_view field) {
  constexpr std::size_t longest = 9;
  if (field.size() > longest || std::isdigit(static_cast<unsigned char>(field.back()))) return false;
  const auto same = [](char one, char c) { return one == small_letter(c); };
  return std::any_of(std::begin(words), std::end(words), [&](std::string_view word) {
    return std::equal(word.begin(), word.end(), field.begin(), field.end(), same);
  });
}

/// How well a dialect fits the lines: many fields are numbers, few are not, and most rows are equally long.
/// Lines without a number are names, units or remarks, and only their length counts.
long score_of(const std::vector<std::string>& lines, const Dialect& dialect, std::size_t& columns) {
  LineSplitter splitter;
  struct Rows {
    long count = 0, with_values = 0, score = 0;
  };
  std::map<std::size_t, Rows> by_length;
  for (const std::string& line : lines) {
    const std::vector<std::string>& fields = splitter.split(line, dialect.separator);
    Rows& rows = by_length[fields.size()];
    ++rows.count;
    long score = 0;
    bool has_cell = false;
    for (const std::string& field : fields) {
      if (says_nothing(field)) continue;
      const bool is_cell = is_value(field, dialect.decimal) || is_missing(field);
      has_cell = has_cell || is_cell;
      score += is_cell ? 4 : -1;
    }
    if (!has_cell) continue;
    ++rows.with_values;
    rows.score += score;
  }
  const auto most = std::max_element(by_length.begin(), by_length.end(), [](const auto& a, const auto& b) {
    const auto by = [](const auto& rows) {
      return std::pair(rows.with_values, rows.count);
    };  // a header tips it
    return by(a.second) < by(b.second);
  });
  if (most == by_length.end() || most->first < 2) return 0;
  columns = most->first;
  long score = most->second.score;
  for (const auto& [length, rows] : by_length)
    if (length != most->first) score -= rows.count * static_cast<long>(length);
  return score;
}

}  // namespace

std::string Dialect::text() const {
  constexpr const char* separators[] = {"", "commas", "semicolons", "tabs", "spaces"};
  return fmt::format("{}, decimal {}", separators[static_cast<int>(separator)],
                     decimal == DecimalMark::comma ? "commas" : "points");
}

LineSplitter::LineSplitter() : parser_(new csv_parser) {
  if (csv_init(parser_, CSV_APPEND_NULL | CSV_EMPTY_IS_NULL) != 0) {
    delete parser_;
    throw std::bad_alloc();
  }
}

LineSplitter::~LineSplitter() {
  csv_free(parser_);
  delete parser_;
}

const std::vector<std::string>& LineSplitter::split(std::string_view line, Separator separator) {
  line_ = line;
  if (separator == Separator::blanks) std::replace(line_.begin(), line_.end(), '\t', ' ');
  csv_set_delim(parser_, separator_bytes[static_cast<int>(separator)]);
  struct Taken {
    LineSplitter* splitter;
    bool blanks;
  } taken{this, separator == Separator::blanks};
  count_ = 0;
  const auto take = [](void* text, std::size_t length, void* data) {
    const Taken& to = *static_cast<Taken*>(data);
    if (!text && to.blanks) return;  // between two blanks in a row
    LineSplitter& splitter = *to.splitter;
    if (splitter.count_ == splitter.fields_.size()) splitter.fields_.emplace_back();
    splitter.fields_[splitter.count_++].assign(text ? static_cast<const char*>(text) : "", length);
  };
  const auto end = [](int, void*) {};
  if (csv_parse(parser_, line_.data(), line_.size(), take, end, &taken) != line_.size() ||
      csv_fini(parser_, take, end, &taken) != 0)
    throw std::bad_alloc();  // csv_parse() is not strict: it has no other errors
  fields_.resize(count_);
  return fields_;
}

std::optional<double> field_number(const std::string& field, DecimalMark decimal) {
  if (decimal == DecimalMark::point) return finite_number(field);
  if (field.find('.') != std::string::npos || field.ends_with(',')) return std::nullopt;
  std::string plain = field;
  std::replace(plain.begin(), plain.end(), ',', '.');
  return finite_number(plain);
}

bool is_missing(std::string_view field) {
  constexpr std::string_view words[] = {"-",         "--",      "?",       ".",     "na",    "n/a",
                                        "nan",       "-nan",    "+nan",    "nil",   "null",  "none",
                                        "missing",   "#nan",    "<na>",    "nat",   "nan()", "nan(ind)",
                                        "-nan(ind)", "1.#qnan", "-1.#ind", "1.#ind"};
  return field.empty() || is_among(words, field) || is_spreadsheet_error(field);
}

bool is_spreadsheet_error(std::string_view field) {
  constexpr std::string_view words[] = {"#n/a",   "#ref!",  "#div/0!", "#value!", "#num!",
                                        "#name?", "#null!", "#calc!",  "#spill!", "#error!"};
  return field.starts_with('#') && is_among(words, field);
}

bool is_value(const std::string& field, DecimalMark decimal) {
  if (field_number(field, decimal) || iso_time(field)) return true;
  const std::string small = small_letters(field.substr(0, 5));
  return small == "inf" || small == "-inf" || small == "+inf";
}

std::optional<Dialect> find_dialect(const std::vector<std::string>& lines, const TableSettings& settings,
                                    std::size_t& columns) {
  using enum Separator;
  std::optional<Dialect> best;
  long best_score = 0;
  for (const DecimalMark decimal : {DecimalMark::point, DecimalMark::comma}) {
    if (settings.decimal != DecimalMark::found && settings.decimal != decimal) continue;
    for (const Separator separator : {comma, semicolon, tab, blanks}) {
      if (settings.separator != found && settings.separator != separator) continue;
      const Dialect dialect{separator, decimal};
      std::size_t length = 0;
      const long score = score_of(lines, dialect, length);
      if (score <= best_score) continue;
      best = dialect;
      best_score = score;
      columns = length;
    }
  }
  return best;
}

}  // namespace sandstroke
