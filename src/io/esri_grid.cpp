#include "io/esri_grid.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/input_file.h"
#include "import/text_parts.h"

namespace sandstroke {
namespace {

constexpr std::string_view esri_keys[] = {"ncols",     "nrows",     "cellsize",  "dx",        "dy",
                                          "xllcorner", "xllcenter", "yllcorner", "yllcenter", "nodata_value"};

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  return small;
}

bool is_esri_key(const std::string& word) {
  return std::find(std::begin(esri_keys), std::end(esri_keys), word) != std::end(esri_keys);
}

/// True for not-a-number, as C and Python write it.
bool is_nan(std::string_view word) {
  const std::string small = in_small_letters(word);
  return small == "nan" || small == "-nan";
}

/// The words of a text file and the lines they are in.
class WordsOfFile {
 public:
  explicit WordsOfFile(const std::filesystem::path& path) : name_(path.string()), file_(path) {}

  /// The next word, valid until the next call; empty at the end.
  std::string_view next() {
    word_.clear();
    while (true) {
      if (rest_.empty() && (rest_ = next_block()).empty()) return word_;
      const char c = rest_.front();
      const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
      if (blank && !word_.empty()) return word_;
      rest_.remove_prefix(1);
      if (c == '\n') ++line_;
      if (blank) continue;
      word_ += c;
      if (word_.size() > most_word_bytes) fail(word_ + "...", "is no number of an ESRI ASCII grid");
    }
  }

  /// Error: input, naming the line.
  [[noreturn]] void fail(std::string_view word, const char* sentence) const {
    throw_input_error("{}:{}: '{}' {}", name_, line_, word, sentence);
  }

  /// Error: input, unless it is a number; not-a-number counts.
  double number(std::string_view word) const {
    if (const std::optional<double> value = finite_number(word)) return *value;
    if (is_nan(word)) return std::numeric_limits<double>::quiet_NaN();
    if (word.find(',') != std::string_view::npos)
      fail(word, "has a comma; save the grid with points in numbers, and blanks between them");
    fail(word, "is not a number; save the grid again");
  }

  const std::string& name() const { return name_; }

 private:
  static constexpr std::size_t most_word_bytes = 400;  // of 1e-308 with all its zeros

  std::string_view next_block() {
    const std::string_view block = file_.next_block();
    return std::exchange(begins_, false) ? without_byte_order_mark(block) : block;
  }

  std::string name_;
  InputFile file_;
  std::string_view rest_;
  std::string word_;
  std::size_t line_ = 1;
  bool begins_ = true;
};

class EsriGrid : public HeightMap {
 public:
  explicit EsriGrid(const std::filesystem::path& path) : words_(path) {
    read_header();
    const double cols = header("ncols"), rows = header("nrows");
    set_size(words_.name(), rows, cols);
    const double x = first_of("cellsize", "dx"), y = first_of("cellsize", "dy");
    if (!(x > 0.0 && y > 0.0))
      throw_input_error("{}: has no cellsize above 0 m; add one to its header", words_.name());
    layout_.cell = {x, y};
    if (values_.contains("nodata_value")) no_data_ = values_.at("nodata_value");
  }

  void next_line(double* values) override {
    for (int col = 0; col < layout_.cols; ++col) {
      if (word_.empty())
        throw_input_error("{}: ends after {} of {} x {} heights; it is cut off, so save it again",
                          words_.name(), read_, layout_.cols, layout_.rows);
      const double value = words_.number(word_);
      values[col] = is_no_data(value, no_data_) ? std::numeric_limits<double>::quiet_NaN() : value;
      ++read_;
      word_ = words_.next();
    }
    if (read_ == static_cast<double>(layout_.rows) * layout_.cols && !word_.empty())
      words_.fail(word_, "follows the last height; make ncols and nrows agree with the heights");
  }

 private:
  /// Reads keys and their values, up to the first word that is a height.
  void read_header() {
    for (word_ = words_.next(); !word_.empty(); word_ = words_.next()) {
      const std::string key = in_small_letters(word_);
      if (std::isalpha(static_cast<unsigned char>(key.front())) == 0 || is_nan(key)) return;
      if (!is_esri_key(key))
        words_.fail(word_,
                    "is no key of an ESRI ASCII grid, which are ncols, nrows, xllcorner, yllcorner, "
                    "cellsize and NODATA_value");
      const double value = words_.number(words_.next());
      if (!values_.emplace(key, value).second) words_.fail(key, "is there twice; remove one");
    }
  }

  double header(const std::string& key) const {
    const auto found = values_.find(key);
    if (found == values_.end()) throw_input_error("{}: has no {} in its header; add it", words_.name(), key);
    if (found->second != std::floor(found->second))
      throw_input_error("{}: {} is {}, which is no whole number; correct it", words_.name(), key,
                        found->second);
    return found->second;
  }
  /// The value of the first of two keys that is there; 0: none is.
  double first_of(const std::string& one, const std::string& other) const {
    const auto found = values_.contains(one) ? values_.find(one) : values_.find(other);
    return found == values_.end() ? 0.0 : found->second;
  }

  WordsOfFile words_;
  std::string_view word_;  // the next one
  std::map<std::string, double> values_;
  double no_data_ = -9999.0;
  double read_ = 0.0;
};

}  // namespace

bool begins_as_esri_grid(std::string_view text) {
  text = without_blanks(without_byte_order_mark(text));
  const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
  return word.size() < 16 && is_esri_key(in_small_letters(word));
}

std::unique_ptr<HeightMap> open_esri_grid(const std::filesystem::path& path) {
  return std::make_unique<EsriGrid>(path);
}

}  // namespace sandstroke
