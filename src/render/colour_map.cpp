#include "render/colour_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sandstroke {
namespace {

constexpr std::array<std::uint32_t, 20> viridis = {
    0x440154, 0x481567, 0x482677, 0x453781, 0x404788, 0x39568c, 0x33638d, 0x2d708e, 0x287d8e, 0x238a8d,
    0x1f968b, 0x20a387, 0x29af7f, 0x3cbb75, 0x55c667, 0x73d055, 0x95d840, 0xb8de29, 0xdce319, 0xfde725};
constexpr std::array<std::uint32_t, 11> blue_white_red = {0x053061, 0x2166ac, 0x4393c3, 0x92c5de,
                                                          0xd1e5f0, 0xf7f7f7, 0xfddbc7, 0xf4a582,
                                                          0xd6604d, 0xb2182b, 0x67001f};

template <std::size_t count>
std::array<double, 3> between(const std::array<std::uint32_t, count>& points, double unit) {
  if (std::isnan(unit)) return {0.5, 0.5, 0.5};
  const double at = std::clamp(unit, 0.0, 1.0) * (count - 1);
  const auto first = std::min(static_cast<std::size_t>(at), count - 2);
  const double part = at - static_cast<double>(first);
  std::array<double, 3> colour;
  for (int channel = 0; channel < 3; ++channel) {
    const int shift = 16 - 8 * channel;
    const double from = (points[first] >> shift & 255u) / 255.0,
                 to = (points[first + 1] >> shift & 255u) / 255.0;
    colour[channel] = from + part * (to - from);
  }
  return colour;
}

}  // namespace

std::array<double, 3> sequential_colour(double unit) { return between(viridis, unit); }

std::array<double, 3> diverging_colour(double minus_one_to_one) {
  return between(blue_white_red, 0.5 * (minus_one_to_one + 1.0));
}

std::array<double, 3> scale_colour(double value, double low, double high, ColourScale scale) {
  const double unit = (value - low) / (high - low);
  return scale == ColourScale::diverging ? diverging_colour(2.0 * unit - 1.0) : sequential_colour(unit);
}

Rgb as_bytes(const std::array<double, 3>& colour) {
  Rgb rgb;
  for (int channel = 0; channel < 3; ++channel)
    rgb[channel] = static_cast<std::uint8_t>(std::lround(255.0 * colour[channel]));
  return rgb;
}

}  // namespace sandstroke
