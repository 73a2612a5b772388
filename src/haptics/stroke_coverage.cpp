#include "haptics/stroke_coverage.h"

#include <spdlog/fmt/fmt.h>

namespace sandstroke {
namespace {

/// Numbers of samples at which the pen is down and does not lift: those that no line joins, and all.
struct LoneSamples {
  std::size_t alone = 0, all = 0;
};

LoneSamples lone_samples(const Stroke& stroke) {
  LoneSamples samples;
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    if (!stroke.pen_down(i) || (!stroke.contact.empty() && stroke.contact[i] == pen_lifts)) continue;
    ++samples.all;
    samples.alone += !stroke.joined(i) && (i == 0 || !stroke.joined(i - 1));
  }
  return samples;
}

/// Numbers of steps between samples with the pen down: those that are too long in time to be joined, and all.
struct CutSteps {
  std::size_t cut = 0, all = 0;
};

CutSteps cut_steps(const Stroke& stroke) {
  CutSteps steps;
  for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
    if (!stroke.pen_down(i) || !stroke.pen_down(i + 1)) continue;
    if (!stroke.contact.empty() && stroke.contact[i] == pen_lifts) continue;
    ++steps.all;
    steps.cut += !stroke.sampled_between(i);
  }
  return steps;
}

}  // namespace

PlayedPart played_part(const StrokeSampler& stroke) {
  const double whole = stroke.stroke().duration();
  double lifted = 0.0;
  for (const StrokeGap& gap : stroke.gaps()) lifted += gap.end - gap.begin;
  return {whole - lifted, whole, static_cast<int>(stroke.gaps().size())};
}

std::string played_text(const PlayedPart& part) {
  return fmt::format("plays {:.4g} s of {:.4g} s: the tool is lifted in {} gap{}", part.played, part.whole,
                     part.gaps, part.gaps == 1 ? "" : "s");
}

std::string coverage_warning(const Stroke& stroke, const std::string& name) {
  double missing = 0.0, begin = 0.0, end = 0.0;  // s, of all gaps; of the largest one
  for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
    if (stroke.sampled_between(i)) continue;
    missing += stroke.time[i + 1] - stroke.time[i];
    if (stroke.time[i + 1] - stroke.time[i] > end - begin) {
      begin = stroke.time[i];
      end = stroke.time[i + 1];
    }
  }
  if (stroke.starved)
    return fmt::format(
        "{}: over a tenth of its ticks were skipped during recording; a run {}; record it again on a machine "
        "that passes sandstroke record --check",
        name, played_text(played_part(StrokeSampler(stroke))));
  if (missing > 60.0 && missing > 0.99 * stroke.duration())
    return fmt::format(
        "{}: samples cover {:.4g} s of {:.10g} s, and the tool is lifted in the rest; the largest gap is "
        "{:.10g} s, from {:.10g} s to {:.10g} s; check the unit of the times (stroke convert --time-unit), "
        "and the times at that gap",
        name, stroke.duration() - missing, stroke.duration(), end - begin, begin, end);
  if (const auto [alone, all] = lone_samples(stroke); alone > 1 && 2 * alone > all)
    return fmt::format(
        "{}: {} of its {} samples are more than {:.4g} s from the next, and the tool is lifted between them: "
        "hardly anything is drawn; check the unit of the times, or give a larger gap threshold (stroke "
        "convert --gap-threshold, stroke.table.gap_threshold)",
        name, alone, all, stroke.gap_threshold);
  constexpr std::size_t few = 10;
  if (const auto [cut, all] = cut_steps(stroke); cut > few && 5 * cut > all)
    return fmt::format(
        "{}: the tool is lifted in {} of the {} steps between its samples, because they are longer than "
        "{:.4g} s: its furrow is dashed; check the unit of the times, or give a larger gap threshold (stroke "
        "convert --gap-threshold, stroke.table.gap_threshold)",
        name, cut, all, stroke.gap_threshold);
  return "";
}

}  // namespace sandstroke
