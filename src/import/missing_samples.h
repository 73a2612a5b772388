#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "haptics/table_settings.h"
#include "import/sample_table.h"

namespace sandstroke {

/// The samples of a table that lack a value which the stroke needs: an empty cell, NaN or infinity.
class MissingSamples {
 public:
  /// Table and name must live as long as this.
  MissingSamples(const SampleTable& table, const std::string& name, Missing rule);

  /// The stroke needs a value in each of these columns. Error: input, if no sample has them all, or if one
  /// lacks a value and the rule is Missing::error; it names line and column then.
  void need(const std::vector<std::size_t>& columns);

  /// The samples that are not missing so far, but lack a value in one of these columns.
  std::vector<std::size_t> lacking(const std::vector<std::size_t>& columns) const;

  /// One entry per sample.
  const std::vector<bool>& samples() const { return missing_; }

  /// "12 samples without a value in x, y are left out in 3 gaps, where the tool lifts"; empty: none is
  /// missing.
  std::string text() const;

 private:
  void check_rule(const std::vector<std::size_t>& columns, std::size_t sample) const;

  const SampleTable& table_;
  const std::string& name_;
  Missing rule_;
  std::vector<bool> missing_;
  std::vector<std::size_t> columns_;  // in which a value lacks
};

/// The values that are not missing.
std::vector<double> finite_values(const SampleColumn& column);
/// True if a column has no finite value.
bool has_no_values(const SampleColumn& column);

/// Removes samples from a stroke, and their lines. The sample before each gap lifts.
void leave_out_samples(Stroke& stroke, std::vector<std::size_t>& lines, const std::vector<bool>& left_out);

/// Keeps these samples, in increasing order, and their lines, if there are any.
void keep_samples(Stroke& stroke, std::vector<std::size_t>& lines, const std::vector<std::size_t>& kept);

/// A sample in messages: "FILE:LINE", or "FILE: sample I" if the file has no lines.
std::string sample_location(const std::string& name, const std::vector<std::size_t>& lines, std::size_t i);

}  // namespace sandstroke
