#include "sweep/effects.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "core/compensated_sum.h"

namespace sandstroke {
namespace {

struct Mean {
  double sum = 0.0, count = 0.0;  // count 0: a group without values
  double value() const { return sum / count; }
};

/// The points that have a value of a metric.
class Values {
 public:
  Values(const CollectedSweep& sweep, std::size_t metric) {
    CompensatedSum sum;
    for (std::size_t point = 0; point < sweep.results.size(); ++point) {
      const double value = sweep.metric(point, metric);
      if (!std::isfinite(value)) continue;
      points.push_back(point);
      values.push_back(value);
      sum.add(value);
    }
    if (values.empty()) return;
    mean = sum.value() / static_cast<double>(values.size());
    CompensatedSum squares;
    for (const double value : values) squares.add((value - mean) * (value - mean));
    variance = squares.value() / static_cast<double>(values.size());
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    differ = *low != *high;
  }

  /// The mean of each group; group_of(i): of the i-th value, below `groups`.
  template <class GroupOf>
  std::vector<Mean> means(std::size_t groups, const GroupOf& group_of) const {
    std::vector<Mean> found(groups);
    for (std::size_t i = 0; i < values.size(); ++i) {
      Mean& there = found[group_of(i)];
      there.sum += values[i];
      there.count += 1.0;
    }
    std::erase_if(found, [](const Mean& one) { return one.count == 0.0; });
    return found;
  }

  /// The fraction of the variance that the groups' means have, each weighted by its values.
  double share_of(const std::vector<Mean>& means) const {
    CompensatedSum squares;
    for (const Mean& one : means) squares.add(one.count * (one.value() - mean) * (one.value() - mean));
    return squares.value() / static_cast<double>(values.size()) / variance;
  }

  std::vector<std::size_t> points;
  std::vector<double> values;
  double mean = 0.0, variance = 0.0;
  bool differ = false;
};

Effect effect_of(std::vector<std::size_t> axes, double share, const std::vector<Mean>& means) {
  const auto [low, high] = std::minmax_element(
      means.begin(), means.end(), [](const Mean& a, const Mean& b) { return a.value() < b.value(); });
  return {std::move(axes), share, low->value(), high->value()};
}

std::vector<Effect> effects_in_grid(const SweepDesign& design, const Values& known) {
  const std::size_t axes = design.axes.size();
  const auto size = [&](std::size_t axis) { return design.axes[axis].values.size(); };
  const auto at = [&](std::size_t i, std::size_t axis) { return design.value_at(known.points[i], axis); };
  std::vector<Effect> effects;
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const auto means = known.means(size(axis), [&](std::size_t i) { return at(i, axis); });
    effects.push_back(effect_of({axis}, known.share_of(means), means));
  }
  for (std::size_t a = 0; a < axes; ++a)
    for (std::size_t b = a + 1; b < axes; ++b) {
      const auto means =
          known.means(size(a) * size(b), [&](std::size_t i) { return at(i, a) * size(b) + at(i, b); });
      const double alone = effects[a].share + effects[b].share;
      effects.push_back(effect_of({a, b}, std::max(0.0, known.share_of(means) - alone), means));
    }
  return effects;
}

/// Groups neighbouring values, or equal texts.
std::vector<Effect> effects_in_hypercube(const SweepDesign& design, const Values& known) {
  const std::size_t count = known.values.size();
  const auto groups =
      static_cast<std::size_t>(std::max(2.0, std::round(std::cbrt(static_cast<double>(count)))));
  std::vector<Effect> effects;
  for (std::size_t axis = 0; axis < design.axes.size(); ++axis) {
    const SweepAxis& along = design.axes[axis];
    std::vector<std::size_t> order(count), group(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto value_at = [&](std::size_t i) { return design.value_at(known.points[i], axis); };
    std::map<std::string, std::size_t> texts;  // the values of a list, which points share
    for (std::size_t i = 0; i < count; ++i)
      group[i] = texts.try_emplace(along.label(value_at(i)), texts.size()).first->second;
    if (along.numeric() && texts.size() > groups) {
      std::vector<double> numbers(count);
      for (std::size_t i = 0; i < count; ++i) numbers[i] = along.number(value_at(i));
      std::stable_sort(order.begin(), order.end(),
                       [&](std::size_t p, std::size_t q) { return numbers[p] < numbers[q]; });
      for (std::size_t rank = 0; rank < count; ++rank) {
        const bool same = rank > 0 && numbers[order[rank]] == numbers[order[rank - 1]];
        group[order[rank]] = same ? group[order[rank - 1]] : rank * groups / count;
      }
    }
    const auto means = known.means(std::max(groups, texts.size()), [&](std::size_t i) { return group[i]; });
    const double share = known.share_of(means);
    const double n = static_cast<double>(count), k = static_cast<double>(means.size());
    const double adjusted = n > k ? 1.0 - (1.0 - share) * (n - 1.0) / (n - k) : 0.0;
    effects.push_back(effect_of({axis}, std::clamp(adjusted, 0.0, 1.0), means));
  }
  return effects;
}

}  // namespace

std::vector<Effect> effects_on(const CollectedSweep& sweep, std::size_t metric) {
  const SweepDesign& design = sweep.folder.design();
  const Values known(sweep, metric);
  if (!known.differ) return {};
  std::vector<Effect> effects =
      design.grid ? effects_in_grid(design, known) : effects_in_hypercube(design, known);
  std::stable_sort(effects.begin(), effects.end(),
                   [](const Effect& a, const Effect& b) { return a.share > b.share; });
  return effects;
}

std::vector<std::size_t> idle_axes(const CollectedSweep& sweep) {
  const SweepDesign& design = sweep.folder.design();
  if (!design.grid) return {};  // no two points differ in one axis alone
  std::vector<std::size_t> idle;
  std::size_t stride = sweep.results.size();  // between points that differ in one step of the axis alone
  for (std::size_t axis = 0; axis < design.axes.size(); ++axis) {
    stride /= design.axes[axis].values.size();
    bool compared = false, changes = false;
    for (std::size_t metric = 0; metric < sweep.folder.metrics().size() && !changes; ++metric) {
      if (sweep.folder.metrics()[metric].timing) continue;
      for (std::size_t point = 0; point < sweep.results.size() && !changes; ++point) {
        if (design.value_at(point, axis) == 0) continue;
        const double here = sweep.metric(point, metric), before = sweep.metric(point - stride, metric);
        const bool both_ran = sweep.results[point] && sweep.results[point - stride];
        if (!both_ran || (!std::isfinite(here) && !std::isfinite(before))) continue;
        compared = true;
        changes = here != before;  // a point that fails is a change, too
      }
    }
    if (compared && !changes) idle.push_back(axis);
  }
  return idle;
}

}  // namespace sandstroke
