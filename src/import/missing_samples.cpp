#include "import/missing_samples.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "import/table_option.h"

namespace sandstroke {

MissingSamples::MissingSamples(const SampleTable& table, const std::string& name, Missing rule)
    : table_(table), name_(name), rule_(rule), missing_(table.size(), false) {}

std::vector<std::size_t> MissingSamples::lacking(const std::vector<std::size_t>& columns) const {
  std::vector<std::size_t> samples;
  for (std::size_t i = 0; i < missing_.size(); ++i) {
    const bool lacks = std::any_of(columns.begin(), columns.end(), [&](std::size_t column) {
      return !std::isfinite(table_.columns[column].values[i]);
    });
    if (lacks && !missing_[i]) samples.push_back(i);
  }
  return samples;
}

void MissingSamples::need(const std::vector<std::size_t>& columns) {
  const std::vector<std::size_t> found = lacking(columns);
  if (!found.empty()) check_rule(columns, found.front());
  for (const std::size_t sample : found) missing_[sample] = true;
  for (const std::size_t column : columns) {
    const std::vector<double>& values = table_.columns[column].values;
    if (std::any_of(found.begin(), found.end(), [&](std::size_t i) { return !std::isfinite(values[i]); }))
      columns_.push_back(column);
  }
  if (std::find(missing_.begin(), missing_.end(), false) != missing_.end()) return;
  for (const std::size_t column : columns)
    if (has_no_values(table_.columns[column]))
      throw_input_error("{}: column '{}' has no value in any sample; name another column for it", name_,
                        table_.columns[column].name);
  throw_input_error("{}: no sample has a value in each column that is used; name other columns with {}",
                    name_, option_and_key("position"));
}

void MissingSamples::check_rule(const std::vector<std::size_t>& columns, std::size_t sample) const {
  if (rule_ == Missing::gap) return;
  const auto column = std::find_if(columns.begin(), columns.end(), [&](std::size_t k) {
    return !std::isfinite(table_.columns[k].values[sample]);
  });
  throw_input_error(
      "{}: column '{}' has no value; correct the sample, or set {} to gap: it is left out then, and the tool "
      "lifts",
      sample_location(name_, table_.lines, sample), table_.columns[*column].name, option_and_key("missing"));
}

std::string MissingSamples::text() const {
  const auto count = std::count(missing_.begin(), missing_.end(), true);
  if (count == 0) return "";
  std::size_t gaps = 0;
  for (std::size_t i = 0; i < missing_.size(); ++i) gaps += missing_[i] && (i == 0 || !missing_[i - 1]);
  std::vector<std::string> names;
  for (const std::size_t column : columns_) names.push_back(table_.columns[column].name);
  const auto first = std::find(missing_.begin(), missing_.end(), true) - missing_.begin();
  return fmt::format(
      "{} sample{} without a value in {} left out in {} gap{}, where the tool lifts; the first is {}", count,
      count == 1 ? "" : "s", fmt::join(names, ", "), gaps, gaps == 1 ? "" : "s",
      sample_location(name_, table_.lines, static_cast<std::size_t>(first)));
}

std::vector<double> finite_values(const SampleColumn& column) {
  std::vector<double> finite;
  std::copy_if(column.values.begin(), column.values.end(), std::back_inserter(finite),
               [](double value) { return std::isfinite(value); });
  return finite;
}

bool has_no_values(const SampleColumn& column) {
  return std::none_of(column.values.begin(), column.values.end(),
                      [](double value) { return std::isfinite(value); });
}

void leave_out_samples(Stroke& stroke, std::vector<std::size_t>& lines, const std::vector<bool>& left_out) {
  std::vector<std::size_t> kept, ends;  // ends: kept samples before a gap
  for (std::size_t i = 0; i < left_out.size(); ++i) {
    if (left_out[i]) continue;
    if (i > 0 && left_out[i - 1] && !kept.empty()) ends.push_back(kept.back());
    kept.push_back(i);
  }
  if (kept.size() == left_out.size()) return;
  if (!ends.empty()) stroke.contact.resize(left_out.size(), pen_down);
  for (const std::size_t i : ends)
    if (stroke.contact[i] == pen_down) stroke.contact[i] = pen_lifts;
  keep_samples(stroke, lines, kept);
}

void keep_samples(Stroke& stroke, std::vector<std::size_t>& lines, const std::vector<std::size_t>& kept) {
  keep_samples(stroke, kept);
  if (lines.empty()) return;
  for (std::size_t i = 0; i < kept.size(); ++i) lines[i] = lines[kept[i]];
  lines.resize(kept.size());
}

std::string sample_location(const std::string& name, const std::vector<std::size_t>& lines, std::size_t i) {
  return lines.empty() ? fmt::format("{}: sample {}", name, i) : fmt::format("{}:{}", name, lines[i]);
}

}  // namespace sandstroke
