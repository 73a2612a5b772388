#include "import/redundancy.h"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/median.h"
#include "haptics/stroke_pieces.h"
#include "import/missing_samples.h"
#include "import/units.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

bool differ(double a, double b, double factor) { return a > factor * b || b > factor * a; }

/// A way of the tip, by its positions and by its recorded velocity [m].
struct TwoWays {
  Vector3d by_position, by_velocity;
};

Eigen::AlignedBox3d box_of(const Stroke& stroke) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& position : stroke.position) box.extend(position);
  return box;
}

/// Parts of the stroke, each long enough that noise of the positions does not matter.
std::vector<TwoWays> ways_of(const Stroke& stroke) {
  const double least = 0.02 * box_of(stroke).diagonal().norm();
  std::vector<TwoWays> ways;
  for (const StrokePiece& piece : joined_pieces(stroke)) {
    std::size_t begin = piece.begin;
    Vector3d by_velocity = Vector3d::Zero();
    for (std::size_t i = begin; i + 1 < piece.end; ++i) {
      by_velocity +=
          0.5 * (stroke.time[i + 1] - stroke.time[i]) * (stroke.velocity[i] + stroke.velocity[i + 1]);
      const Vector3d by_position = stroke.position[i + 1] - stroke.position[begin];
      if (!(by_position.norm() > 0.0 && by_position.norm() >= least)) continue;
      ways.push_back({by_position, by_velocity});
      begin = i + 1;
      by_velocity = Vector3d::Zero();
    }
  }
  return ways;
}

/// How well two ways agree along an axis: 1 alike, -1 opposite. 1 also if the tip hardly moves along it.
double agreement(const std::vector<TwoWays>& ways, Eigen::Index axis) {
  double all = 0.0, product = 0.0, position = 0.0, velocity = 0.0;
  for (const TwoWays& way : ways) {
    all += way.by_position.squaredNorm();
    product += way.by_position[axis] * way.by_velocity[axis];
    position += way.by_position[axis] * way.by_position[axis];
    velocity += way.by_velocity[axis] * way.by_velocity[axis];
  }
  constexpr double least_share = 0.05;  // of the motion
  if (position < least_share * all || velocity == 0.0) return 1.0;
  return product / std::sqrt(position * velocity);
}

/// The step of stamps that are coarser than the samples, so that some repeat: whole seconds. Else 0.
double step_of_stamps(const std::vector<double>& stamps) {
  double least = std::numeric_limits<double>::infinity();
  bool repeat = false;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    const double step = stamps[i] - stamps[i - 1];
    repeat = repeat || step == 0.0;
    if (step > 0.0) least = std::min(least, step);
  }
  return repeat && std::isfinite(least) ? least : 0.0;
}

constexpr double least_jump_ratio = 20.0;    // to the fastest other steps, or the usual of few
constexpr double least_jump_distance = 0.1;  // of the stroke's extent

/// The ends of steps to samples that stand alone: the tip goes far away from where it hardly moves, and comes
/// back at once. However many they are, as where a tracker writes -9999 for what it did not see, no hand does
/// that.
std::vector<std::size_t> ends_at_lone_samples(const Stroke& stroke, double least_speed,
                                              double least_distance) {
  constexpr double nearby = 0.1;  // of the way to the sample
  const auto step = [&](std::size_t i) { return stroke.position[i + 1] - stroke.position[i]; };
  std::vector<std::size_t> ends;
  for (std::size_t i = 1; i + 1 < stroke.size(); ++i) {
    if (!stroke.joined(i - 1) || !stroke.joined(i)) continue;
    const double there = step(i - 1).norm(), back = step(i).norm(), nearer = std::min(there, back);
    const double longer = std::max(stroke.time[i] - stroke.time[i - 1], stroke.time[i + 1] - stroke.time[i]);
    const bool returns = (step(i - 1) + step(i)).norm() < nearby * nearer;
    const bool came_slowly = i < 2 || step(i - 2).norm() < nearby * nearer;
    const bool goes_slowly = i + 2 >= stroke.size() || step(i + 1).norm() < nearby * nearer;
    if (returns && came_slowly && goes_slowly && nearer > least_distance && nearer > least_speed * longer)
      ends.insert(ends.end(), {i, i + 1});
  }
  return ends;
}

}  // namespace

std::string time_disagreement(const SampleColumn& column, const std::string& unit, double duration,
                              const std::string& by, double factor) {
  const std::vector<double> finite = finite_values(column);
  if (finite.size() < 2 || !(finite.back() > finite.front())) return "";
  const double span = finite.back() - finite.front();
  const double ends = 2.0 * step_of_stamps(finite);  // both stamps at the ends are rounded
  const auto disagree = [&](const Unit& known) {
    return known.to_si(span - ends) > factor * duration || duration > factor * known.to_si(span + ends);
  };
  if (const auto known = known_unit(Quantity::time, unit)) {
    if (!disagree(*known)) return "";
    return fmt::format("the times in column {} last {:.4g} s, but {} makes {:.4g} s of the samples",
                       column.name, known->to_si(span), by, duration);
  }
  for (const char* any : {"s", "ms", "us", "ns"})
    if (!disagree(*known_unit(Quantity::time, any))) return "";
  return fmt::format(
      "the times in column {} last {:.4g}, which in s, ms, us and ns differs from the {:.4g} s that {} makes "
      "of the samples",
      column.name, span, duration, by);
}

std::string number_disagreement(const SampleColumn& numbers, const std::vector<double>& time) {
  std::vector<double> steps, times;
  double before = std::nan(""), time_before = 0.0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double number = numbers.values[i];
    if (!std::isfinite(number) || !std::isfinite(time[i])) continue;
    if (number != std::floor(number) || number <= before) return "";  // no numbers of samples
    if (std::isfinite(before)) {
      steps.push_back(number - before);
      times.push_back(time[i] - time_before);
    }
    before = number;
    time_before = time[i];
  }
  const double step = median(steps), spacing = median(times);
  double skipped = 0.0, lasted = 0.0;  // samples in jumps of the numbers, and s
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!(steps[i] > step)) continue;
    skipped += steps[i] / step;
    lasted += times[i];
  }
  if (!(spacing > 0.0) || skipped < 0.01 * static_cast<double>(steps.size()) ||
      !differ(skipped * spacing, lasted, 1.5))
    return "";
  return fmt::format(
      "column {} skips numbers, which at the usual {:.4g} s per sample last {:.4g} s, but the times go on by "
      "{:.4g} s there; samples may be lost, and times that count rows are too short then",
      numbers.name, spacing, skipped * spacing, lasted);
}

std::string velocity_disagreement(const Stroke& stroke, const std::vector<std::string>& position,
                                  const std::vector<std::string>& velocity) {
  constexpr std::size_t least_ways = 5;
  const std::vector<TwoWays> ways = ways_of(stroke);
  if (ways.size() < least_ways) return "";
  std::vector<double> ratios;
  for (const TwoWays& way : ways) ratios.push_back(way.by_velocity.norm() / way.by_position.norm());
  const double ratio = median(std::move(ratios));
  if (differ(ratio, 1.0, 2.0))
    return fmt::format(
        "velocity {} is {:.4g} times the speed of position {} over time; check the units of velocity and "
        "position, and the times",
        fmt::join(velocity, ", "), ratio, fmt::join(position, ", "));
  for (std::size_t k = 0; k < std::min(position.size(), velocity.size()); ++k) {
    const double alike = agreement(ways, static_cast<Eigen::Index>(k));
    if (alike >= 0.5) continue;
    return fmt::format(
        "velocity {} {} position {} (1 would be alike, -1 opposite: they have {:.2f}); check order and signs "
        "of both",
        velocity[k], alike < -0.5 ? "goes against the motion of" : "does not go with the motion of",
        position[k], alike);
  }
  return "";
}

std::vector<Jump> jumps_of(const Stroke& stroke) {
  constexpr std::size_t least_steps = 3, few_steps = 20;
  std::vector<Jump> steps;
  std::vector<double> speeds;
  for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
    if (!stroke.joined(i)) continue;
    const double distance = (stroke.position[i + 1] - stroke.position[i]).norm();
    const double time = stroke.time[i + 1] - stroke.time[i];
    steps.push_back({i + 1, distance, time, distance / time});
    speeds.push_back(distance / time);
  }
  if (steps.size() < least_steps) return {};
  // One wrong sample makes two fast steps, which are many of few: then the usual step is compared.
  const auto others = speeds.size() < few_steps
                          ? speeds.begin() + static_cast<std::ptrdiff_t>((speeds.size() - 1) / 2)
                          : speeds.end() - 3 - static_cast<std::ptrdiff_t>(speeds.size() / 100);
  std::nth_element(speeds.begin(), others, speeds.end());
  const double fastest = *others, least_distance = least_jump_distance * box_of(stroke).sizes().maxCoeff();
  const double usual = median(std::move(speeds));
  std::vector<std::size_t> alone;
  if (usual > 0.0) alone = ends_at_lone_samples(stroke, least_jump_ratio * usual, least_distance);
  std::erase_if(steps, [&](const Jump& step) {
    const bool fast =
        fastest > 0.0 && step.ratio > least_jump_ratio * fastest && step.distance > least_distance;
    return !fast && !std::binary_search(alone.begin(), alone.end(), step.sample);
  });
  const double other = fastest > 0.0 && !(usual > 0.0 && usual < fastest) ? fastest : usual;
  for (Jump& jump : steps) jump.ratio /= other;
  return steps;
}

}  // namespace sandstroke
