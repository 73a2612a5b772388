#include "render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/angle.h"
#include "core/error.h"

namespace sandstroke {
namespace {

constexpr double picture_border = 0.05;  ///< of the picture, left free around a framed subject

std::array<Eigen::Vector3d, 8> corners(const Eigen::AlignedBox3d& box) {
  std::array<Eigen::Vector3d, 8> points;
  for (int i = 0; i < 8; ++i) points[i] = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
  return points;
}

/// Rows: right, up, backward of a camera at this azimuth and elevation (seen from the target).
Eigen::Matrix3d camera_axes(double azimuth, double elevation) {
  const double ca = std::cos(to_radians(azimuth)), sa = std::sin(to_radians(azimuth));
  const double ce = std::cos(to_radians(elevation)), se = std::sin(to_radians(elevation));
  Eigen::Matrix3d axes;
  axes << -sa, ca, 0.0, -se * ca, -se * sa, ce, ce * ca, ce * sa, se;
  return axes;
}

/// One pair of opposite frustum planes around the subject. slope_low, slope_high: tangents of the angles
/// between the way ahead and the borders that the subject must stay within.
struct Fit {
  const std::array<Eigen::Vector3d, 8>& points;
  int across;  ///< 0: to the right, 1: up
  double slope_low, slope_high;

  /// The least depth (along the backward axis) from which an eye sees all of the subject.
  double least_depth() const {
    double low = -1e300, high = 1e300;
    for (const Eigen::Vector3d& p : points) {
      low = std::max(low, p(across) + slope_high * p.z());
      high = std::min(high, p(across) - slope_low * p.z());
    }
    return (low - high) / (slope_low + slope_high);
  }
  /// Where an eye at this depth, from which the subject fits, leaves as much of the picture free on both
  /// sides of the subject. That is not the middle of all places from where it is seen: what is near takes
  /// more of the picture.
  double centred(double depth) const {
    const auto distance = [&](const Eigen::Vector3d& p) { return std::max(depth - p.z(), 1e-9); };
    double from = 1e300, to = -1e300;  // from here all is beyond one border, from there beyond the other
    for (const Eigen::Vector3d& p : points) {
      from = std::min(from, p(across) - slope_high * distance(p));
      to = std::max(to, p(across) + slope_low * distance(p));
    }
    for (int halving = 0; halving < 100; ++halving) {
      const double eye = 0.5 * (from + to);
      double least = 1e300, most = -1e300;
      for (const Eigen::Vector3d& p : points) {
        const double slope = (p(across) - eye) / distance(p);
        least = std::min(least, slope);
        most = std::max(most, slope);
      }
      (least + slope_low > slope_high - most ? from : to) = eye;
    }
    return 0.5 * (from + to);
  }
};

void check(const ViewSettings& view) {
  if (!(view.field_of_view >= 1.0 && view.field_of_view <= 120.0))
    throw_input_error("view: field_of_view = {} deg cannot be drawn; use 1 to 120", view.field_of_view);
  if (!(view.elevation >= -90.0 && view.elevation <= 90.0))
    throw_input_error("view: elevation = {} deg is not an elevation; use -90 to 90", view.elevation);
  if (!(view.distance >= 0.0 && std::isfinite(view.distance)))
    throw_input_error("view: distance = {} m is not a distance; use 0 (frames the subject) or more",
                      view.distance);
  if (!std::isfinite(view.azimuth) || !view.target.allFinite())
    throw_input_error("view: azimuth and target must be finite numbers");
}

}  // namespace

double Camera::pixels_per_metre(const Eigen::AlignedBox3d& box) const {
  return orthographic ? scale : scale / std::max(1e-9, box.exteriorDistance(eye));
}

PixelRect Camera::pixels_of(const Eigen::AlignedBox3d& box, int width, int height) const {
  Eigen::Array2d low = Eigen::Array2d::Constant(1.0), high = -low;
  for (const Eigen::Vector3d& p : corners(box)) {
    const Eigen::Vector4d clip = to_clip * p.homogeneous();
    if (clip.w() <= 0.0) return {0, 0, width, height};  // a corner is beside the eye or behind it
    const Eigen::Array2d position = (clip.head<2>() / clip.w()).array().max(-1.0).min(1.0);
    low = low.min(position);
    high = high.max(position);
  }
  const auto pixel = [](double position, int pixels, int beyond) {  // two more: samples lie around centres
    return std::clamp(static_cast<int>(std::floor(0.5 * (position + 1.0) * pixels)) + beyond, 0, pixels);
  };
  return {pixel(low.x(), width, -2), pixel(low.y(), height, -2), pixel(high.x(), width, 3),
          pixel(high.y(), height, 3)};
}

double Camera::widest_pixel(const Eigen::AlignedBox3d& box, double steepest) const {
  double farthest = 1.0, sine = -forward.z();  // of the least angle between the level and the way to the eye
  if (!orthographic) {
    farthest = 0.0;
    for (const Eigen::Vector3d& p : corners(box)) farthest = std::max(farthest, (eye - p).norm());
    sine = std::clamp((eye.z() - box.max().z()) / farthest, -1.0, 1.0);
  }
  const double facing = sine - steepest * std::sqrt(1.0 - sine * sine);  // for a slope that falls away
  constexpr double room = 4.0;  // for differences between pixels, and for coarser triangles
  return facing < 0.02 ? std::numeric_limits<double>::infinity() : room * farthest / (scale * facing);
}

bool Camera::misses(const Eigen::AlignedBox3d& box) const {
  const auto points = corners(box);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Eigen::RowVector4d plane = to_clip.row(3) + side * to_clip.row(axis);
      if (std::all_of(points.begin(), points.end(),
                      [&](const Eigen::Vector3d& p) { return plane.dot(p.homogeneous().transpose()) < 0.0; }))
        return true;
    }
  }
  return false;
}

namespace {

/// The depth range holds the whole scene, but starts a little in front of the eye at the nearest.
void set_depth_range(Eigen::Matrix4d& projection, const Camera& camera, const Eigen::AlignedBox3d& scene) {
  double nearest = 1e300, farthest = -1e300;
  for (const Eigen::Vector3d& p : corners(scene)) {
    const double distance = camera.forward.dot(p - camera.eye);
    nearest = std::min(nearest, distance);
    farthest = std::max(farthest, distance);
  }
  const double margin = 0.01 * scene.diagonal().norm();
  nearest -= margin;
  farthest += margin;
  if (camera.orthographic) {
    projection(2, 2) = -2.0 / (farthest - nearest);
    projection(2, 3) = -(farthest + nearest) / (farthest - nearest);
    projection(3, 3) = 1.0;
  } else {
    farthest = std::max(farthest, margin);
    nearest = std::max(nearest, 1e-3 * farthest);
    projection(2, 2) = -(farthest + nearest) / (farthest - nearest);
    projection(2, 3) = -2.0 * farthest * nearest / (farthest - nearest);
    projection(3, 2) = -1.0;
  }
}

}  // namespace

Camera make_camera(const ViewSettings& view, const Eigen::AlignedBox3d& subject,
                   const Eigen::AlignedBox3d& scene, double right_margin) {
  check(view);
  const bool top = view.name == ViewName::top;
  const Eigen::Matrix3d axes = top ? camera_axes(-90.0, 90.0) : camera_axes(view.azimuth, view.elevation);
  const double aspect = static_cast<double>(view.width) / view.height;
  const double tan_y = std::tan(to_radians(0.5 * view.field_of_view)), tan_x = aspect * tan_y;
  const double inside = 1.0 - 2.0 * picture_border;  // of half the picture's sides
  const double inside_right = 1.0 - 2.0 * (picture_border + right_margin);

  std::array<Eigen::Vector3d, 8> points = corners(subject);
  for (Eigen::Vector3d& p : points) p = axes * p;

  Camera camera;
  camera.forward = -axes.row(2).transpose();
  camera.orthographic = top;
  Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
  Eigen::AlignedBox3d in_camera;
  for (const Eigen::Vector3d& p : points) in_camera.extend(p);
  if (top) {
    const Eigen::Vector3d extent = in_camera.sizes(), centre = in_camera.center();
    const double half_height =
        std::max(extent.y() / (2.0 * inside), extent.x() / (aspect * (inside + inside_right)));
    const double half_width = aspect * half_height;
    const double shift = 0.5 * (inside - inside_right) * half_width;  // to the middle beside the margin
    camera.eye = axes.transpose() * Eigen::Vector3d(centre.x() + shift, centre.y(), in_camera.max().z());
    camera.scale = 0.5 * view.height / half_height;
    projection(0, 0) = 1.0 / half_width;
    projection(1, 1) = 1.0 / half_height;
  } else {
    const Fit across{points, 0, tan_x * inside, tan_x * inside_right},
        up{points, 1, tan_y * inside, tan_y * inside};
    const double centre = in_camera.center().z(), fitting = std::max(across.least_depth(), up.least_depth());
    const double distance = view.distance > 0.0 ? view.distance : fitting - centre;
    if (view.name == ViewName::custom) {
      camera.eye = view.target - camera.forward * distance;
    } else {
      const double depth = centre + distance;
      // Nearer than from where the subject fits the eye goes straight at its middle.
      const double part = depth < fitting ? (depth - centre) / (fitting - centre) : 1.0;
      const auto eye_at = [&](const Fit& fit) {
        const double middle = in_camera.center()(fit.across);
        return middle + part * (fit.centred(std::max(depth, fitting)) - middle);
      };
      camera.eye = axes.transpose() * Eigen::Vector3d(eye_at(across), eye_at(up), depth);
    }
    camera.scale = 0.5 * view.height / tan_y;
    projection(0, 0) = 1.0 / tan_x;
    projection(1, 1) = 1.0 / tan_y;
  }

  set_depth_range(projection, camera, scene);
  Eigen::Matrix4d to_camera = Eigen::Matrix4d::Identity();
  to_camera.topLeftCorner<3, 3>() = axes;
  to_camera.topRightCorner<3, 1>() = -axes * camera.eye;
  camera.to_clip = projection * to_camera;
  return camera;
}

}  // namespace sandstroke
