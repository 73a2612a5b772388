#include "haptics/stroke_plane.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/elementary.h"
#include "core/error.h"

namespace sandstroke {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double steepest_table = 45.0;  // deg

Vector3d direction_of(StrokeUp up) {
  const int axis = (static_cast<int>(up) - 1) % 3;
  return up >= StrokeUp::minus_x ? Vector3d(-Vector3d::Unit(axis)) : Vector3d(Vector3d::Unit(axis));
}

const std::string& name_of(StrokeUp up) { return stroke_up_names[static_cast<std::size_t>(up)]; }

StrokeUp opposite(StrokeUp up) {
  const int index = static_cast<int>(up);
  return static_cast<StrokeUp>(index > 3 ? index - 3 : index + 3);
}

StrokeUp nearest_axis(const Vector3d& normal) {
  int axis = 0;
  // Rounding must not take the plane of a table for an upright one.
  Vector3d(normal.cwiseAbs() + 1e-9 * Vector3d::UnitZ()).maxCoeff(&axis);
  const auto positive = static_cast<StrokeUp>(axis + 1);
  return normal[axis] < 0.0 ? opposite(positive) : positive;
}

/// Mean height [m] above the plane of the samples with the pen up; 0 if there are none.
double lifted_height(const Stroke& stroke, const LeastSquaresPlane& plane) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    if (stroke.pen_down(i)) continue;
    sum += plane.normal.dot(stroke.position[i] - plane.centroid);
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

/// The fraction of the way in an upright plane that is more than 10 deg off both z and the horizontal.
double oblique_fraction(const Stroke& stroke) {
  const double least = elementary::sin(to_radians(10.0));
  double oblique = 0.0, whole = 0.0;
  for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
    if (!stroke.joined(i)) continue;
    const Vector3d step = stroke.position[i + 1] - stroke.position[i];
    const double length = step.norm();
    whole += length;
    if (std::min(std::abs(step.z()), step.head<2>().norm()) > least * length) oblique += length;
  }
  return whole > 0.0 ? oblique / whole : 0.0;
}

}  // namespace

double LeastSquaresPlane::tilt() const {
  return to_degrees(elementary::atan2(normal.head<2>().norm(), std::abs(normal.z())));
}

LeastSquaresPlane plane_through(const std::vector<Vector3d>& points) {
  LeastSquaresPlane plane;
  if (points.empty()) return plane;
  const auto count = static_cast<double>(points.size());
  for (const Vector3d& p : points) plane.centroid += p;
  plane.centroid /= count;
  Matrix3d covariance = Matrix3d::Zero();
  for (const Vector3d& p : points) covariance += (p - plane.centroid) * (p - plane.centroid).transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(covariance);  // eigenvalues in increasing order
  plane.normal = axes.eigenvectors().col(0);
  if (plane.normal.z() < 0.0) plane.normal = -plane.normal;
  plane.widths = (axes.eigenvalues().cwiseMax(0.0) / count).cwiseSqrt();
  for (const Vector3d& p : points)
    plane.largest = std::max(plane.largest, std::abs(plane.normal.dot(p - plane.centroid)));
  return plane;
}

std::vector<Vector3d> drawn_points(const Stroke& stroke) {
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < stroke.size(); ++i)
    if (stroke.pen_down(i)) points.push_back(stroke.position[i]);
  return points;
}

std::string off_plane_warning(const Stroke& stroke, const std::string& name) {
  const std::vector<Vector3d> drawn = drawn_points(stroke);
  const auto fifth = static_cast<std::ptrdiff_t>(drawn.size() / 5);
  const LeastSquaresPlane middle = plane_through({drawn.begin() + fifth, drawn.end() - fifth});
  if (drawn.size() < 10 || middle.is_line()) return "";
  double largest = 0.0;
  for (const Vector3d& p : drawn)
    largest = std::max(largest, std::abs(middle.normal.dot(p - middle.centroid)));
  constexpr double far = 8.0;     // of the middle's rms
  constexpr double thin = 0.005;  // of its length: no middle counts as flatter
  if (!(largest > far * std::max(middle.rms(), thin * middle.widths[2]))) return "";
  return fmt::format(
      "{}: it begins or ends up to {:.3g} mm off the plane of its middle ({:.3g} mm rms), like an approach "
      "or a lift, which tilts the fitted plane; cut it off with stroke.start and stroke.stop (s), or give "
      "pen states",
      name, 1e3 * largest, 1e3 * middle.rms());
}

UpNormal up_normal(const Stroke& stroke, const LeastSquaresPlane& plane, StrokeUp up,
                   const std::string& name) {
  if (up != StrokeUp::automatic) {
    const double cosine = plane.normal.dot(direction_of(up));
    const double tilt = to_degrees(elementary::acos(std::min(std::abs(cosine), 1.0)));
    const StrokeUp nearest = nearest_axis(plane.normal);
    if (tilt > steepest_table)
      throw_input_error(
          "{}: its samples with the pen down fit a plane tilted {:.3g} deg against stroke.up = \"{}\"; set "
          "stroke.up = \"{}\" or \"{}\", or stroke.plane = \"keep\"",
          name, tilt, name_of(up), name_of(nearest), name_of(opposite(nearest)));
    return {cosine < 0.0 ? Vector3d(-plane.normal) : plane.normal, up};
  }
  UpNormal found{plane.normal, nearest_axis(plane.normal)};
  const double lifted = lifted_height(stroke, plane);
  found.lifted = std::abs(lifted) > 3.0 * plane.rms() && std::abs(lifted) > 0.01 * plane.widths[2];
  const bool table = found.axis == StrokeUp::z;
  // Takes a positive axis, unless the pen is lifted to the other side.
  if (found.lifted ? lifted < 0.0 : found.axis > StrokeUp::z)
    found = {-found.normal, opposite(found.axis), found.lifted};
  if (!table && !found.lifted && oblique_fraction(stroke) <= 0.5)
    throw_input_error(
        "{}: its samples with the pen down fit a plane tilted {:.3g} deg, and move along or across z, like a "
        "plunge, a drag and a lift; for such a stroke into sand set stroke.plane = \"keep\"; for a tracing "
        "on a wall, or with another axis up, set stroke.up = \"{}\" (or \"{}\" for its other side)",
        name, plane.tilt(), name_of(found.axis), name_of(opposite(found.axis)));
  return found;
}

}  // namespace sandstroke
