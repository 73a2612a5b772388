#include "import/merge_strokes.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/error.h"
#include "import/missing_samples.h"
#include "import/table_option.h"

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

/// The sample of a stroke at or before a time within it, and the fraction of the way to the next one.
struct Between {
  std::size_t sample = 0, next = 0;
  double fraction = 0.0;
};
Between between(const std::vector<double>& time, double at) {
  const auto after = std::upper_bound(time.begin(), time.end(), at) - time.begin();
  const auto sample = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - 1, 0));
  const std::size_t next = std::min(sample + 1, time.size() - 1);
  const double step = time[next] - time[sample];
  return {sample, next, step > 0.0 ? std::clamp((at - time[sample]) / step, 0.0, 1.0) : 0.0};
}

/// Leaves out the samples in gaps of the second table. Returns a warning, or nothing.
std::string leave_out_gaps(Stroke& stroke, const Stroke& from, double offset,
                           const std::string& second_name) {
  std::vector<bool> in_gap;
  for (const double time : stroke.time) {
    const Between at = between(from.time, time - offset);
    in_gap.push_back(at.fraction > 0.0 && at.fraction < 1.0 && !from.sampled_between(at.sample));
  }
  const auto count = std::count(in_gap.begin(), in_gap.end(), true);
  if (count == 0) return "";
  if (count == std::ssize(in_gap))
    throw_input_error("{}: all samples of the first table lie in its gaps of over {:.4g} s; give {}",
                      second_name, from.gap_threshold, option_and_key("merge_shift"));
  std::vector<std::size_t> no_lines;
  leave_out_samples(stroke, no_lines, in_gap);
  return fmt::format(
      "{}: {} samples of the first table are left out, and the tool lifts there, because they lie in gaps of "
      "this one, where it has no samples for over {:.4g} s",
      second_name, count, from.gap_threshold);
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

  if (const std::string gaps = leave_out_gaps(stroke, from, offset, second_name); !gaps.empty())
    first.warnings.push_back(gaps);

  if (!from.force.empty()) stroke.force_sign = from.force_sign;
  if (!from.force.empty()) stroke.force.clear();
  if (!from.orientation.empty()) stroke.orientation.clear();
  for (const double time : stroke.time) {
    const auto [k, next, fraction] = between(from.time, time - offset);
    if (!from.force.empty())
      stroke.force.push_back(from.force[k] + fraction * (from.force[next] - from.force[k]));
    if (!from.orientation.empty())
      stroke.orientation.push_back(Eigen::Quaterniond(from.orientation[k])
                                       .slerp(fraction, Eigen::Quaterniond(from.orientation[next]))
                                       .coeffs());
  }
}

}  // namespace sandstroke
