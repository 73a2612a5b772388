#include "import/array_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/counted.h"
#include "core/error.h"

namespace sandstroke {
namespace {

/// The column of a clock's stamps, if its first number is one: a double does not hold all of its digits.
bool take_clock(const StoredNumbers& numbers, std::size_t k, SampleColumn& column) {
  constexpr std::uint64_t least = 1'000'000'000'000'000;  // 16 digits: us since 1970
  if (numbers.type.kind == StoredType::Kind::real || numbers.type.bytes < 8 || numbers.samples == 0)
    return false;
  const std::uint64_t first = numbers.bits(0, k);
  if (first < least || first > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
    return false;
  column.origin = static_cast<std::int64_t>(first);
  for (std::size_t i = 0; i < numbers.samples; ++i) {
    const std::uint64_t value = numbers.bits(i, k);
    const bool negative = numbers.type.kind == StoredType::Kind::whole && value >> 63;
    const bool later = !negative && value >= first;
    const auto since = static_cast<double>(later ? value - first : first - value);
    column.values.push_back(later ? since : -since);
  }
  return true;
}

std::string listed(const std::vector<NamedArray>& arrays) {
  constexpr std::size_t most = 20;
  std::vector<std::string> names;
  for (const NamedArray& array : arrays)
    names.push_back(fmt::format("{} ({} x {})", array.name, array.samples, array.width));
  return first_of(std::move(names), most);
}

/// The arrays to take, all of one length.
std::vector<NamedArray> chosen(std::vector<NamedArray> arrays, const std::string& part,
                               const std::string& file, const ArrayWords& words) {
  const auto exact =
      std::find_if(arrays.begin(), arrays.end(), [&](const NamedArray& one) { return one.name == part; });
  const std::size_t length = exact == arrays.end() ? 0 : exact->samples;
  const auto fits = [&](const NamedArray& one) {
    if (length > 0) return one.samples == length && (!one.columns.empty() || one.name == part);
    return part.empty() || one.name.starts_with(part + ".");
  };
  if (std::none_of(arrays.begin(), arrays.end(), fits))
    throw_input_error("{}: has no {} '{}'; stroke.table.part (stroke convert: --part) takes one of: {}", file,
                      words.array, part, listed(arrays));
  std::erase_if(arrays, [&](const NamedArray& one) { return !fits(one); });
  std::set<std::size_t> lengths;
  for (const NamedArray& one : arrays) lengths.insert(one.samples);
  if (lengths.size() > 1)
    throw_input_error(
        "{}: its {}s differ in length; name one with stroke.table.part (stroke convert: --part), and all {}s "
        "of that length are read: {}",
        file, words.array, words.array, listed(arrays));
  return arrays;
}

bool is_ever_finite(const SampleColumn& column) {
  return std::any_of(column.values.begin(), column.values.end(),
                     [](double value) { return std::isfinite(value); });
}

}  // namespace

NamedArray named_array(const std::string& name, const StoredNumbers& numbers) {
  NamedArray made{name, numbers.samples, numbers.width, {}};
  if (made.width > made.samples) return made;
  for (std::size_t k = 0; k < made.width; ++k) {
    SampleColumn& column = made.columns.emplace_back();
    column.name = made.width == 1 ? name : fmt::format("{}.{}", name, k + 1);
    column.values.reserve(made.samples);
    if (take_clock(numbers, k, column)) continue;
    for (std::size_t i = 0; i < made.samples; ++i) {
      const double value = numbers.real(i, k);
      column.values.push_back(std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return made;
}

SampleTable table_of_columns(std::vector<SampleColumn> columns, const std::string& kind,
                             const std::string& file) {
  std::vector<std::string> without;
  for (const SampleColumn& column : columns)
    if (!is_ever_finite(column)) without.push_back(column.name);
  if (without.size() == columns.size())
    throw_input_error("{}: has no finite number in {}; name a file with numbers", file,
                      columns.size() == 1 ? "its column" : "its columns");
  SampleTable table;
  table.columns = std::move(columns);
  std::erase_if(table.columns, [](const SampleColumn& column) { return !is_ever_finite(column); });
  table.description = fmt::format(
      "{}: {} columns, {} samples{}", kind, table.columns.size(), table.size(),
      without.empty() ? "" : fmt::format(", left out because all is NaN: {}", fmt::join(without, ", ")));
  return table;
}

SampleTable table_of_arrays(std::vector<NamedArray> arrays, const std::string& part, const std::string& file,
                            const ArrayWords& words) {
  if (arrays.empty()) throw_input_error("{}: {}", file, words.none);
  std::vector<SampleColumn> columns;
  for (NamedArray& one : chosen(std::move(arrays), part, file, words)) {
    if (one.columns.empty())
      throw_input_error(
          "{}: {}{}{} has {} rows and {} columns, but each row must be a sample; save it transposed: {}",
          file, words.array, one.name.empty() ? "" : " ", one.name, one.samples, one.width, words.transpose);
    std::move(one.columns.begin(), one.columns.end(), std::back_inserter(columns));
  }
  return table_of_columns(std::move(columns), words.kind, file);
}

}  // namespace sandstroke
