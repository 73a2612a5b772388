#include "sweep/sweep_design.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <random>

#include "core/elementary.h"

namespace sandstroke {
namespace {

/// Reads a text that is a number as a whole.
bool as_number(const std::string& text, double& number) {
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  return failure == std::errc() && end == text.data() + text.size();
}

}  // namespace

bool SweepAxis::numeric() const {
  double number;
  return std::all_of(values.begin(), values.end(),
                     [&](const std::string& value) { return as_number(value, number); });
}

double SweepAxis::number(std::size_t value) const {
  double number = std::nan("");
  as_number(values[value], number);
  return number;
}

std::string SweepAxis::label(std::size_t value) const {
  const std::string& text = values[value];
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

std::vector<std::size_t> SweepDesign::shape() const {
  if (!grid) return {points()};
  std::vector<std::size_t> shape;
  for (const SweepAxis& axis : axes) shape.push_back(axis.values.size());
  return shape;
}

std::size_t SweepDesign::points() const {
  if (!grid) return axes.front().values.size();
  std::size_t points = 1;
  for (const SweepAxis& axis : axes) points *= axis.values.size();
  return points;
}

std::size_t SweepDesign::value_at(std::size_t point, std::size_t axis) const {
  if (!grid) return point;
  for (std::size_t faster = axes.size() - 1; faster > axis; --faster) point /= axes[faster].values.size();
  return point % axes[axis].values.size();
}

std::vector<std::string> SweepDesign::settings(std::size_t point) const {
  std::vector<std::string> settings;
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
    settings.push_back(axes[axis].key + "=" + axes[axis].values[value_at(point, axis)]);
  return settings;
}

double rounded(double value, double size) {
  if (std::abs(value) < 1e-12 * std::abs(size)) return 0.0;
  as_number(fmt::format("{:.12g}", value), value);  // std::stod would refuse 1e-310
  return value;
}

std::vector<double> spread(double from, double to, std::size_t count, bool logarithmic) {
  std::vector<double> values(count, from);
  const double size = logarithmic ? 0.0 : std::max(std::abs(from), std::abs(to));
  for (std::size_t i = 1; i < count; ++i) {
    const double fraction = static_cast<double>(i) / static_cast<double>(count - 1);
    values[i] = i + 1 == count ? to
                               : rounded(logarithmic ? from * elementary::pow(to / from, fraction)
                                                     : from + (to - from) * fraction,
                                         size);
  }
  return values;
}

std::vector<std::size_t> spread_indices(std::size_t n, std::size_t most) {
  const std::size_t count = std::min(n, most);
  std::vector<std::size_t> indices(count);
  for (std::size_t i = 0; i < count; ++i) indices[i] = count == n ? i : i * (n - 1) / (count - 1);
  return indices;
}

std::vector<std::vector<double>> latin_hypercube(std::size_t axes, std::size_t n, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  const auto below_one = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<std::vector<double>> samples(axes, std::vector<double>(n));
  for (std::vector<double>& axis : samples) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    // Not std::shuffle: its order depends on the library.
    for (std::size_t i = n; i > 1; --i)
      std::swap(order[i - 1], order[static_cast<std::size_t>(below_one() * static_cast<double>(i))]);
    for (std::size_t i = 0; i < n; ++i)
      axis[i] = std::min((static_cast<double>(order[i]) + below_one()) / static_cast<double>(n),
                         std::nextafter(1.0, 0.0));
  }
  return samples;
}

}  // namespace sandstroke
