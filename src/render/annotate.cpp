#include "render/annotate.h"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "lettering/hershey_text.h"
#include "render/colour_map.h"
#include "render/round_scale.h"

namespace sandstroke {
namespace {

constexpr Rgb paper = {246, 246, 244};

void blend(std::uint8_t* pixel, const Rgb& rgb, double opacity) {
  for (int channel = 0; channel < 3; ++channel)
    pixel[channel] =
        static_cast<std::uint8_t>(std::lround(pixel[channel] + opacity * (rgb[channel] - pixel[channel])));
}

/// Fills [x0, x1) x [y0, y1), given in pixels, with exact coverage of the border pixels.
void fill_rectangle(Image& image, double x0, double y0, double x1, double y1, const Rgb& rgb,
                    double opacity = 1.0) {
  const auto covered = [](int pixel, double from, double to) {
    return std::clamp(std::min(pixel + 1.0, to) - std::max<double>(pixel, from), 0.0, 1.0);
  };
  const int left = std::max(0, static_cast<int>(std::floor(x0)));
  const int right = std::min(image.width, static_cast<int>(std::ceil(x1)));
  const int top = std::max(0, static_cast<int>(std::floor(y0)));
  const int bottom = std::min(image.height, static_cast<int>(std::ceil(y1)));
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x)
      blend(image.pixel(x, y), rgb, opacity * covered(x, x0, x1) * covered(y, y0, y1));
}

double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

/// Sizes of the legend's parts. All follow from the capital height.
struct LegendLayout {
  double cap, margin, bar_width, tick_length, label_width, usual_width;
  std::string title;
  std::vector<ScaleTick> ticks;

  LegendLayout(const Legend& legend, int image_height) : cap(annotation_cap_height(image_height)) {
    margin = 0.9 * cap;
    bar_width = 1.5 * cap;
    tick_length = 0.45 * cap;
    const LengthUnit unit = length_unit(std::max(std::abs(legend.low), std::abs(legend.high)));
    ticks = scale_ticks(legend.low, legend.high, unit, 7);
    title = fmt::format("{} [{}]", legend.quantity, unit.name);
    usual_width = 2.0 * margin + text_width(cap, legend.quantity + " [mm]");
    label_width = 0.0;
    for (const ScaleTick& tick : ticks) label_width = std::max(label_width, text_width(cap, tick.label));
  }
  double width() const {
    return std::max(usual_width, 2.0 * margin + bar_width + 1.8 * tick_length + label_width);
  }
};

}  // namespace

double annotation_cap_height(int image_height) { return std::max(8.5, 0.0185 * image_height); }

double text_width(double cap_height, std::string_view text) { return cap_height * hershey_text(text).width; }

void draw_lines(Image& image, const std::vector<std::vector<Eigen::Vector2d>>& lines, double half_width,
                Rgb rgb) {
  const double reach = half_width + 0.5;
  Eigen::AlignedBox2d around;
  for (const auto& line : lines)
    for (const Eigen::Vector2d& point : line) around.extend(point);
  if (around.isEmpty()) return;
  // Coverage is collected first, so that pixels where strokes meet are not painted twice.
  const auto pixel = [](double at, int pixels) {
    return static_cast<int>(std::clamp(at, 0.0, 1.0 * pixels));
  };
  const int left = pixel(std::floor(around.min().x() - reach), image.width),
            right = pixel(std::ceil(around.max().x() + reach) + 1.0, image.width),
            top = pixel(std::floor(around.min().y() - reach), image.height),
            bottom = pixel(std::ceil(around.max().y() + reach) + 1.0, image.height);
  if (left >= right || top >= bottom) return;
  Eigen::ArrayXXd coverage = Eigen::ArrayXXd::Zero(bottom - top, right - left);
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Eigen::Vector2d a = line[i], b = line[std::min(i + 1, line.size() - 1)];
      const Eigen::Vector2d low = a.cwiseMin(b).array() - reach, high = a.cwiseMax(b).array() + reach;
      for (int row = std::max(top, static_cast<int>(low.y())); row < std::min<double>(bottom, high.y());
           ++row) {
        for (int col = std::max(left, static_cast<int>(low.x())); col < std::min<double>(right, high.x());
             ++col) {
          const double distance = distance_to_segment({col + 0.5, row + 0.5}, a, b);
          double& covered = coverage(row - top, col - left);
          covered = std::max(covered, std::clamp(reach - distance, 0.0, 1.0));
        }
      }
    }
  }
  for (int row = top; row < bottom; ++row)
    for (int col = left; col < right; ++col)
      blend(image.pixel(col, row), rgb, coverage(row - top, col - left));
}

void draw_text(Image& image, double x, double y, double cap_height, std::string_view text, Rgb rgb) {
  std::vector<std::vector<Eigen::Vector2d>> lines = hershey_text(text).polylines;
  for (auto& line : lines)
    for (Eigen::Vector2d& p : line) p = Eigen::Vector2d(x + cap_height * p.x(), y - cap_height * p.y());
  draw_lines(image, lines, 0.5 * std::max(1.15, 0.11 * cap_height), rgb);
}

int legend_width(const Legend& legend, int image_height) {
  return static_cast<int>(std::ceil(LegendLayout(legend, image_height).usual_width));
}

void draw_legend(Image& image, const Legend& legend) {
  const LegendLayout layout(legend, image.height);
  const double cap = layout.cap;
  const double left = image.width - layout.width() + layout.margin;
  const double top = std::round(4.2 * cap), bottom = std::round(image.height - 2.2 * cap);
  const auto y_at = [&](double value) {
    return bottom - (value - legend.low) / (legend.high - legend.low) * (bottom - top);
  };
  fill_rectangle(image, image.width - layout.width(), 0.0, image.width, image.height, paper, 0.86);
  draw_text(image, left, 2.1 * cap, cap, layout.title, annotation_ink);

  for (int y = static_cast<int>(top); y < static_cast<int>(bottom); ++y) {
    const double value = legend.low + (bottom - y - 0.5) / (bottom - top) * (legend.high - legend.low);
    fill_rectangle(image, left, y, left + layout.bar_width, y + 1,
                   as_bytes(scale_colour(value, legend.low, legend.high, legend.scale)));
  }
  const double line = std::max(1.0, 0.08 * cap);
  const double spacing = legend.contour_interval / (legend.high - legend.low) * (bottom - top);  // pixels
  if (spacing > line) {  // no lines where they would touch, as in the picture
    for (double k = std::ceil(legend.low / legend.contour_interval);
         k * legend.contour_interval <= legend.high; ++k) {
      const double y = y_at(k * legend.contour_interval);
      fill_rectangle(image, left, y - 0.5 * line, left + layout.bar_width, y + 0.5 * line, annotation_ink,
                     0.55);
    }
  }
  const double right = left + layout.bar_width;
  for (const ScaleTick& tick : layout.ticks) {
    const double y = y_at(tick.value);
    fill_rectangle(image, right, y - 0.5 * line, right + layout.tick_length, y + 0.5 * line, annotation_ink);
    draw_text(image, right + 1.8 * layout.tick_length, y + 0.5 * cap, cap, tick.label, annotation_ink);
  }
}

}  // namespace sandstroke
