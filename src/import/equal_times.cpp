#include "import/equal_times.h"

#include <algorithm>

#include "core/error.h"
#include "import/missing_samples.h"
#include "import/table_option.h"

namespace sandstroke {
namespace {

void check_times(const Stroke& stroke, const std::vector<std::size_t>& lines, const std::string& name,
                 bool equal_allowed) {
  const auto line = [&](std::size_t i) {
    return lines.empty() ? fmt::format("sample {}", i) : fmt::format("line {}", lines[i]);
  };
  for (std::size_t i = 1; i < stroke.size(); ++i) {
    if (stroke.time[i] < stroke.time[i - 1]) {
      throw_input_error("{}: time {} s is earlier than {} s in {}; sort or correct them",
                        sample_location(name, lines, i), stroke.time[i], stroke.time[i - 1], line(i - 1));
    }
    if (stroke.time[i] == stroke.time[i - 1] && !equal_allowed) {
      throw_input_error(
          "{}: time {} s is the same as in {}; set {} to drop (keep the first sample) or spread (space the "
          "samples evenly)",
          sample_location(name, lines, i), stroke.time[i], line(i - 1), option_and_key("equal_times"));
    }
  }
}

void drop_equal_times(Stroke& stroke, std::vector<std::size_t>& lines) {
  const std::vector<double> time = stroke.time;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (i == 0 || time[i] != time[i - 1]) {
      kept.push_back(i);
    } else if (!stroke.contact.empty() && stroke.contact[i] == pen_lifts) {
      stroke.contact[kept.back()] = pen_lifts;
    }
  }
  keep_samples(stroke, lines, kept);
}

void spread_equal_times(Stroke& stroke, const std::string& name) {
  std::vector<double>& time = stroke.time;
  for (std::size_t begin = 0, end = 0; begin < time.size(); begin = end) {
    for (end = begin + 1; end < time.size() && time[end] == time[begin]; ++end) {
    }
    if (end - begin == 1) continue;
    const bool has_next = end < time.size();
    if (!has_next && begin == 0)
      throw_input_error("{}: all {} samples have the same time; use {} instead", name, time.size(),
                        option_and_key("rate"));
    const bool ends_pen_stroke =
        !has_next || (!stroke.contact.empty() && stroke.contact[end - 1] == pen_lifts);
    double spacing = has_next ? (time[end] - time[begin]) / static_cast<double>(end - begin) : time[begin];
    if (ends_pen_stroke && begin > 0) {
      const double before = time[begin] - time[begin - 1];
      spacing = has_next ? std::min(spacing, before) : before;
    }
    for (std::size_t i = begin + 1; i < end; ++i)
      time[i] = time[begin] + static_cast<double>(i - begin) * spacing;
  }
}

}  // namespace

void settle_equal_times(Stroke& stroke, std::vector<std::size_t>& lines, EqualTimes rule,
                        const std::string& name) {
  check_times(stroke, lines, name, rule != EqualTimes::error);
  if (rule == EqualTimes::drop) drop_equal_times(stroke, lines);
  if (rule == EqualTimes::spread) spread_equal_times(stroke, name);
}

}  // namespace sandstroke
