#include "render/scale_bar.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "render/annotate.h"
#include "render/round_scale.h"

namespace sandstroke {
namespace {

/// The longest round length up to `most` [m].
double round_length(double most) {
  const double decade = std::pow(10.0, std::floor(std::log10(most)));
  for (const double factor : {5.0, 2.0})
    if (factor * decade <= most) return factor * decade;
  return decade;
}

std::string label_of(double length) {
  const LengthUnit unit = length_unit(length);
  return fmt::format("{:.6g} {}", length / unit.metres, unit.name);
}

Eigen::Vector2d pixel_of(const Camera& camera, const Eigen::Vector3d& point, int width, int height) {
  const Eigen::Vector4d clip = camera.to_clip * point.homogeneous();
  if (clip.w() <= 0.0) return Eigen::Vector2d::Constant(-1.0);  // behind the eye
  return {0.5 * (1.0 + clip.x() / clip.w()) * width, 0.5 * (1.0 - clip.y() / clip.w()) * height};
}

}  // namespace

std::optional<ScaleBar> scale_bar(const Camera& camera, const Eigen::AlignedBox3d& box, int width,
                                  int height) {
  constexpr double most = 0.25;  // of the picture or the side
  const double cap = annotation_cap_height(height);
  if (camera.orthographic) {
    const double length = round_length(most * width / camera.scale);
    const Eigen::Vector2d from(2.0 * cap, height - 1.5 * cap), to(from.x() + length * camera.scale, from.y());
    return ScaleBar{from, to, to + cap * Eigen::Vector2d(0.8, 0.5), length, label_of(length)};
  }
  // The sides of the box, seen from outside: the ends of the lower edge from left to right, and the way out.
  const Eigen::Vector3d low = box.min(), high = box.max();
  const Eigen::Vector3d corners[] = {
      low, {high.x(), low.y(), low.z()}, {high.x(), high.y(), low.z()}, {low.x(), high.y(), low.z()}};
  const Eigen::Vector3d out[] = {-Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX(),
                                 Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitX()};
  const auto faces_eye = [&](int side) { return out[side].dot(camera.eye - box.center()); };
  int nearest = 0;
  for (int side = 1; side < 4; ++side)
    if (faces_eye(side) > faces_eye(nearest)) nearest = side;
  const Eigen::Vector3d begin = corners[nearest], along = corners[(nearest + 1) % 4] - begin;
  const double length = round_length(most * along.norm());
  const Eigen::Vector3d from = begin + 0.04 * box.sizes().head<2>().maxCoeff() * out[nearest];
  const std::string label = label_of(length);
  const Eigen::Vector2d left = pixel_of(camera, from, width, height),
                        right = pixel_of(camera, from + length * along.normalized(), width, height);
  const auto is_inside = [&](const Eigen::Vector2d& p) {
    return p.x() > 0.5 * cap && p.x() < width - 0.5 * cap && p.y() > 0.5 * cap && p.y() < height - 0.5 * cap;
  };
  // The label lies beyond the bar, seen from the box. Where the bar leans, a corner of the text comes nearest
  // to it.
  const Eigen::Vector2d lean = (right - left).normalized(), beyond(-lean.y(), lean.x());
  const Eigen::Vector2d half_text(0.5 * text_width(cap, label), 0.5 * cap);
  const Eigen::Vector2d middle =
      0.5 * (left + right) +
      (0.8 * cap + half_text.x() * std::abs(lean.y()) + half_text.y() * std::abs(lean.x())) * beyond;
  for (const Eigen::Vector2d& point :
       {left, right, Eigen::Vector2d(middle - half_text), Eigen::Vector2d(middle + half_text)})
    if (!is_inside(point)) return std::nullopt;
  return ScaleBar{left, right, middle + Eigen::Vector2d(-half_text.x(), half_text.y()), length, label};
}

void draw_scale_bar(Image& image, const ScaleBar& bar) {
  const double cap = annotation_cap_height(image.height);
  const Eigen::Vector2d along = (bar.to - bar.from).normalized(),
                        tick = 0.35 * cap * Eigen::Vector2d(along.y(), -along.x());
  draw_lines(image, {{bar.from, bar.to}, {bar.from - tick, bar.from + tick}, {bar.to - tick, bar.to + tick}},
             0.12 * cap, annotation_ink);
  draw_text(image, bar.label_at.x(), bar.label_at.y(), cap, bar.label, annotation_ink);
}

}  // namespace sandstroke
