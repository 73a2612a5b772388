#include "io/key_reader.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/key_visitor.h"

namespace sandstroke {
namespace {

/// Gives each key the value in the file, if there is one.
class KeyReader : public KeyVisitor {
 public:
  explicit KeyReader(const TomlReader& toml) : toml_(toml) {}

  void section(const char* name, const char*) override {
    prefix_ = std::string(name) + ".";
    toml_.has(name);
  }
  bool optional_section(const char* name, bool, const char* help) override {
    section(name, help);
    return toml_.has(name);
  }
  int tables(const char* name, int count) override {
    const int found = toml_.count_tables(name);
    return toml_.has(name) ? found : count;
  }
  void table(const char* list, int place, const char* help) override {
    section(fmt::format("{}.{}", list, place).c_str(), help);
  }
  bool given(const char* key) override { return toml_.has(prefix_ + key); }
  void require(const char* key) override { toml_.require(prefix_ + key); }
  void number(const char* key, double& value, Range range, const char* unit, const char*) override {
    value = toml_.number(prefix_ + key, value, range, unit);
  }
  void numbers(const char* key, double* values, int count, Range range, const char* unit,
               const char*) override {
    const auto read = toml_.numbers(prefix_ + key, std::vector<double>(values, values + count), range, unit);
    std::copy(read.begin(), read.end(), values);
  }
  void profile(const char* key, std::vector<double>& values, Range range, const char* unit,
               const char*) override {
    values = toml_.profile(prefix_ + key, values, range, unit);
  }
  void points(const char* key, std::vector<Eigen::Vector2d>& values, const char*, const char*) override {
    if (toml_.has(prefix_ + key)) values.clear();
    for (const std::vector<double>& xy : toml_.points(prefix_ + key)) values.emplace_back(xy[0], xy[1]);
  }
  void integers(const char* key, int* values, int count, int lowest, int highest, const char*) override {
    if (count == 1) {
      values[0] = toml_.integer(prefix_ + key, values[0], lowest, highest);
      return;
    }
    const Range range{
        .lowest = static_cast<double>(lowest), .highest = static_cast<double>(highest), .whole = true};
    const auto read = toml_.numbers(prefix_ + key, std::vector<double>(values, values + count), range);
    for (int i = 0; i < count; ++i) values[i] = static_cast<int>(read[i]);
  }
  void flag(const char* key, bool& value, const char*) override {
    value = toml_.boolean(prefix_ + key, value);
  }
  void text(const char* key, std::string& value, const char*) override {
    value = toml_.text(prefix_ + key, value);
  }
  void texts(const char* key, std::vector<std::string>& values, const char*) override {
    values = toml_.texts(prefix_ + key, values);
  }
  void choice(const char* key, int& value, const std::vector<std::string>& names, const char*) override {
    value = toml_.choice(prefix_ + key, value, names);
  }
  bool reads() const override { return true; }

 private:
  const TomlReader& toml_;
  std::string prefix_;
};

}  // namespace

void read_keys(const TomlReader& toml, const ShowKeys& show) {
  KeyReader reader(toml);
  show(reader);
}

}  // namespace sandstroke
