#include "haptics/stroke_placement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/error.h"
#include "haptics/stroke_plane.h"
#include "haptics/stroke_smoothing.h"

namespace sandstroke {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Keeps the samples from start to stop, and lets time begin at 0.
void cut_time(Stroke& stroke, double start, double stop, const std::string& name) {
  const double first = stroke.time.front();
  std::size_t begin = 0, end = stroke.size();
  while (begin < end && stroke.time[begin] - first < start) ++begin;
  while (end > begin && stroke.time[end - 1] - first > stop) --end;
  if (begin == end) {
    throw_input_error("{}: no sample lies between start = {} s and stop = {} s; the stroke lasts {} s", name,
                      start, std::min(stop, stroke.duration()), stroke.duration());
  }
  keep_samples(stroke, begin, end);
  const double played_first = stroke.time.front();
  for (double& t : stroke.time) t -= played_first;
}

void rotate(Stroke& stroke, const Matrix3d& rotation) {
  for (Vector3d& p : stroke.position) p = rotation * p;
  for (Vector3d& v : stroke.velocity) v = rotation * v;
  for (Vector3d& f : stroke.force) f = rotation * f;
  const Eigen::Quaterniond turn(rotation);
  for (Eigen::Vector4d& q : stroke.orientation) q = (turn * Eigen::Quaterniond(q)).coeffs();
}

void speed_up(Stroke& stroke, double times) {
  if (times == 1.0) return;
  for (double& t : stroke.time) t /= times;
  for (Vector3d& v : stroke.velocity) v *= times;
  stroke.gap_threshold /= times;
  stroke.nominal_rate *= times;
}

/// Scales a stroke. If its times were made for a speed, it keeps that speed.
void resize(Stroke& stroke, double scale) {
  for (Vector3d& p : stroke.position) p *= scale;
  for (Vector3d& v : stroke.velocity) v *= scale;
  if (stroke.tip_speed > 0.0) speed_up(stroke, 1.0 / scale);
}

LeastSquaresPlane traced_plane(const std::vector<Vector3d>& drawn, bool flatten, const std::string& name) {
  const LeastSquaresPlane plane = plane_through(drawn);
  if (drawn.size() < 3 || plane.is_line())
    throw_input_error(
        "{}: stroke.plane finds no plane, because its {} samples with the pen down lie on one line; set "
        "stroke.plane = \"keep\"",
        name, drawn.size());
  if (plane.is_thick() && !flatten)
    throw_input_error(
        "{}: plane = \"fit\" finds no plane, because its samples with the pen down are less than twice as "
        "wide as they are thick: they lie {:.3g} mm rms, {:.3g} mm at most, off the nearest plane; set "
        "stroke.plane = \"flatten\" to move them onto it, or \"keep\"",
        name, 1e3 * plane.rms(), 1e3 * plane.largest);
  return plane;
}

Eigen::AlignedBox3d drawn_extent(const Stroke& stroke) {
  Eigen::AlignedBox3d extent;
  for (std::size_t i = 0; i < stroke.size(); ++i)
    if (stroke.pen_down(i)) extent.extend(stroke.position[i]);
  return extent;
}

/// Shifts the stroke so that the middle of its drawn extent lies there.
void bring_to(const Eigen::Vector2d& place, Stroke& stroke) {
  const Eigen::AlignedBox3d extent = drawn_extent(stroke);
  if (extent.isEmpty()) return;
  const Vector3d shift(place.x() - extent.center().x(), place.y() - extent.center().y(), 0.0);
  for (Vector3d& p : stroke.position) p += shift;
}

void lay_level(Stroke& stroke, const StrokePlacement& placement, const std::string& name) {
  const bool flatten = placement.plane == StrokePlane::flatten;
  const LeastSquaresPlane plane = traced_plane(drawn_points(stroke), flatten, name);
  const UpNormal up = up_normal(stroke, plane, placement.up, name);
  const Matrix3d level = Eigen::Quaterniond::FromTwoVectors(up.normal, Vector3d::UnitZ()).toRotationMatrix();

  // Turns the stroke about the centroid, which lies on the plane: numbers stay small, and the plane becomes z
  // = 0.
  for (Vector3d& p : stroke.position) p -= plane.centroid;
  rotate(stroke, level);
  bring_to(Eigen::Vector2d::Zero(), stroke);
  if (!flatten) return;
  for (std::size_t i = 0; i < stroke.size(); ++i)
    if (stroke.pen_down(i)) stroke.position[i].z() = 0.0;
}

/// The scale at which the stroke, already turned, fills its fraction of the bed.
double fitting_scale(const Stroke& stroke, double fraction, const Eigen::AlignedBox2d& bed,
                     const std::string& name) {
  const Eigen::AlignedBox3d extent = drawn_extent(stroke);
  const Eigen::Vector2d size = extent.isEmpty() ? Eigen::Vector2d::Zero() : extent.sizes().head<2>().eval();
  const double scale = fraction * bed.sizes().cwiseQuotient(size).minCoeff();
  if (!std::isfinite(scale) || !(scale > 0.0))
    throw_input_error(
        "{}: stroke.fit = {} cannot scale a stroke that is drawn at one point; set stroke.scale instead",
        name, fraction);
  return scale;
}

/// How hard the hand presses at a sample.
double press(const Stroke& stroke, std::size_t i, DepthBy by) {
  return by == DepthBy::pressure ? std::max(stroke.pressure[i], 0.0) : stroke.force[i].norm();
}

/// The pressure or force of full depth.
double full_press(const Stroke& stroke, const StrokePlacement& placement, const std::string& name) {
  const std::string& by = depth_by_names[static_cast<std::size_t>(placement.depth_by)];
  if (placement.depth_by == DepthBy::pressure ? stroke.pressure.empty() : stroke.force.empty())
    throw_input_error(
        "{}: stroke.depth_by = \"{}\", but the stroke has no {}; for a table, name the column with "
        "stroke.table.{}; otherwise leave stroke.depth_by out",
        name, by, by, by);
  if (placement.full_depth_at > 0.0) return placement.full_depth_at;
  double full = 0.0;
  for (std::size_t i = 0; i < stroke.size(); ++i)
    if (stroke.pen_down(i)) full = std::max(full, press(stroke, i, placement.depth_by));
  if (!(full > 0.0))
    throw_input_error("{}: no sample with the pen down has a {} above 0; leave stroke.depth_by out", name,
                      by);
  return full;
}

/// Raises drawn samples, which are lowered by the whole depth, to the depth of their pressure or force.
void raise_to_press(Stroke& stroke, const StrokePlacement& placement, double full, const std::string& name) {
  const Eigen::AlignedBox3d extent = drawn_extent(stroke);
  if (placement.plane == StrokePlane::keep && extent.min().z() < extent.max().z())
    throw_input_error(
        "{}: stroke.depth_by needs a stroke in one plane, but its heights differ by {:.3g} mm; set "
        "stroke.plane = \"fit\" or \"flatten\"",
        name, 1e3 * extent.sizes().z());
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    if (!stroke.pen_down(i)) continue;
    const double fraction = std::min(press(stroke, i, placement.depth_by) / full, 1.0);
    stroke.position[i].z() += (1.0 - fraction) * placement.depth;
  }
}

}  // namespace

PointPlacement point_placement(const StrokePlacement& placement, const std::string& frame) {
  PointPlacement place;
  if (frame == "device") place.axes << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  place.scale = placement.scale;
  const double angle = to_radians(placement.rotate_z);
  if (angle != 0.0) place.turn = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
  place.shift = placement.offset - placement.depth * Vector3d::UnitZ();
  return place;
}

Stroke place_stroke(const Stroke& stroke, const StrokePlacement& placement, const std::string& name,
                    const Eigen::AlignedBox2d& bed) {
  if (!(placement.scale > 0.0))
    throw_input_error("{}: scale is {}; it must be positive", name, placement.scale);
  Stroke placed = stroke;
  cut_time(placed, placement.start, placement.stop, name);
  if (placement.repeated == RepeatedSamples::drop) placed = without_repeated_samples(placed);
  if (placement.smooth > 0.0) placed = smoothed(placed, placement.smooth);
  const PointPlacement place = point_placement(placement, placed.frame);
  rotate(placed, place.axes);
  const Eigen::Quaterniond back = Eigen::Quaterniond(place.axes).conjugate();
  for (Eigen::Vector4d& q : placed.orientation) q = (Eigen::Quaterniond(q) * back).coeffs();
  placed.frame = "bed";
  if (placement.follow == StrokeFollow::sand) placed.follows_sand = true;
  if (placement.plane != StrokePlane::keep) lay_level(placed, placement, name);

  if (placement.fit == 0.0) resize(placed, place.scale);
  rotate(placed, place.turn);
  if (placement.fit > 0.0) resize(placed, fitting_scale(placed, placement.fit, bed, name));
  if (placement.place == StrokePlace::centre) bring_to(bed.center(), placed);
  for (Vector3d& p : placed.position) p += place.shift;
  if (placement.depth_by != DepthBy::none)
    raise_to_press(placed, placement, full_press(stroke, placement, name), name);
  speed_up(placed, placement.speed);
  check_stroke(placed, name);
  return placed;
}

}  // namespace sandstroke
