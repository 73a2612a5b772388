#include "io/key_reader.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace sandstroke {

void KeyReader::section(const char* name, const char*) {
  prefix_ = std::string(name) + ".";
  toml_.has(name);
}

bool KeyReader::optional_section(const char* name, bool, const char* help) {
  section(name, help);
  return toml_.has(name);
}

bool KeyReader::given(const char* key) { return toml_.has(prefix_ + key); }

void KeyReader::require(const char* key) { toml_.require(prefix_ + key); }

void KeyReader::number(const char* key, double& value, Range range, const char* unit, const char*) {
  value = toml_.number(prefix_ + key, value, range, unit);
}

void KeyReader::numbers(const char* key, double* values, int count, Range range, const char* unit,
                        const char*) {
  const auto read = toml_.numbers(prefix_ + key, std::vector<double>(values, values + count), range, unit);
  std::copy(read.begin(), read.end(), values);
}

void KeyReader::profile(const char* key, std::vector<double>& values, Range range, const char* unit,
                        const char*) {
  values = toml_.profile(prefix_ + key, values, range, unit);
}

void KeyReader::points(const char* key, std::vector<Eigen::Vector2d>& values, const char*, const char*) {
  for (const std::vector<double>& xy : toml_.points(prefix_ + key)) values.emplace_back(xy[0], xy[1]);
}

void KeyReader::integers(const char* key, int* values, int count, int lowest, int highest, const char*) {
  if (count == 1) {
    values[0] = toml_.integer(prefix_ + key, values[0], lowest, highest);
    return;
  }
  const Range range{static_cast<double>(lowest), static_cast<double>(highest), false};
  const auto read = toml_.numbers(prefix_ + key, std::vector<double>(values, values + count), range);
  for (int i = 0; i < count; ++i) {
    if (read[i] != std::floor(read[i]))
      toml_.fail(prefix_ + key, fmt::format("is {}; give integers", read[i]));
    values[i] = static_cast<int>(read[i]);
  }
}

void KeyReader::flag(const char* key, bool& value, const char*) {
  value = toml_.boolean(prefix_ + key, value);
}

void KeyReader::text(const char* key, std::string& value, const char*) {
  value = toml_.text(prefix_ + key, value);
}

void KeyReader::texts(const char* key, std::vector<std::string>& values, const char*) {
  values = toml_.texts(prefix_ + key, values);
}

void KeyReader::choice(const char* key, int& value, const std::vector<std::string>& names, const char*) {
  value = toml_.choice(prefix_ + key, value, names);
}

}  // namespace sandstroke
