#include "import/merge_strokes.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/error.h"
#include "import/table_layout.h"

namespace sandstroke {
namespace {

/// The seconds to add to the second's times.
double offset_of(const ImportedStroke& first, const ImportedStroke& second, double shift,
                 const std::string& first_name, const std::string& second_name) {
  if (first.clock.has_value() != second.clock.has_value() && shift == 0.0)
    throw_input_error(
        "{}: only one of this table and {} has clock times, so their times cannot be aligned; give {}: the "
        "seconds to add to the times of this table",
        second_name, first_name, option_and_key("merge_shift"));
  if (!first.clock || !second.clock) return shift;
  constexpr std::int64_t second_ns = 1'000'000'000;
  const auto whole = static_cast<double>(*second.clock / second_ns - *first.clock / second_ns);
  return shift + whole + 1e-9 * static_cast<double>(*second.clock % second_ns - *first.clock % second_ns);
}

}  // namespace

void merge_strokes(ImportedStroke& first, const ImportedStroke& second, double shift,
                   const std::string& first_name, const std::string& second_name) {
  const Stroke& from = second.stroke;
  if (from.force.empty() && from.orientation.empty())
    throw_input_error("{}: no columns are named as a force or an orientation; name the columns with {} or {}",
                      second_name, option_and_key("force"), option_and_key("orientation"));
  const double offset = offset_of(first, second, shift, first_name, second_name);
  Stroke& stroke = first.stroke;
  const double begin = from.time.front() + offset, end = from.time.back() + offset;
  first.description += fmt::format(
      "; merged {}: begins {:+.6g} s after the first table begins, ends {:+.6g} s after it ends ({})",
      second_name, begin - stroke.time.front(), end - stroke.time.back(), second.description);
  first.warnings.insert(first.warnings.end(), second.warnings.begin(), second.warnings.end());
  if (begin > stroke.time.back() || end < stroke.time.front())
    throw_input_error("{}: its times, {:.6g} to {:.6g} s, do not overlap {:.6g} to {:.6g} s of {}; give {}",
                      second_name, begin, end, stroke.time.front(), stroke.time.back(), first_name,
                      option_and_key("merge_shift"));
  const double before = std::max(begin - stroke.time.front(), 0.0),
               after = std::max(stroke.time.back() - end, 0.0);
  if (before > 0.0 || after > 0.0)
    first.warnings.push_back(fmt::format(
        "{}: {:.6g} s at its beginning and {:.6g} s at its end are left out, because {} does not cover them",
        first_name, before, after, second_name));
  const auto sample_at = [&](double time) {
    return static_cast<std::size_t>(std::lower_bound(stroke.time.begin(), stroke.time.end(), time) -
                                    stroke.time.begin());
  };
  const std::size_t kept_end = static_cast<std::size_t>(
      std::upper_bound(stroke.time.begin(), stroke.time.end(), end) - stroke.time.begin());
  if (sample_at(begin) >= kept_end)
    throw_input_error("{}: no sample of {} lies within the times of this table; give {}", second_name,
                      first_name, option_and_key("merge_shift"));
  keep_samples(stroke, sample_at(begin), kept_end);

  if (!from.force.empty()) stroke.force_sign = from.force_sign;
  if (!from.force.empty()) stroke.force.clear();
  if (!from.orientation.empty()) stroke.orientation.clear();
  std::size_t k = 0;
  for (const double time : stroke.time) {
    const double own = std::clamp(time - offset, from.time.front(), from.time.back());
    while (k + 2 < from.size() && from.time[k + 1] <= own) ++k;
    const std::size_t next = std::min(k + 1, from.size() - 1);
    const double fraction = next == k ? 0.0 : (own - from.time[k]) / (from.time[next] - from.time[k]);
    if (!from.force.empty())
      stroke.force.push_back(from.force[k] + fraction * (from.force[next] - from.force[k]));
    if (!from.orientation.empty())
      stroke.orientation.push_back(Eigen::Quaterniond(from.orientation[k])
                                       .slerp(fraction, Eigen::Quaterniond(from.orientation[next]))
                                       .coeffs());
  }
}

}  // namespace sandstroke
