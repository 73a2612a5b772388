#include "haptics/stroke_placement.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/error.h"

namespace sandstroke {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// deg. The plane of a plunge, a drag along a line and a lift is upright: made level, it would lie on its
// side.
constexpr double steepest_table = 45.0;

template <class Row>
void cut(std::vector<Row>& column, std::size_t begin, std::size_t end) {
  if (column.empty()) return;
  column.resize(end);
  column.erase(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(begin));
}

/// Keeps the samples from start to stop, and lets time begin at 0.
void cut_time(Stroke& stroke, double start, double stop, const std::string& name) {
  const double first = stroke.time.front();
  std::size_t begin = 0, end = stroke.size();
  while (begin < end && stroke.time[begin] - first < start) ++begin;
  while (end > begin && stroke.time[end - 1] - first > stop) --end;
  if (begin == end) {
    throw_input_error("{}: no sample lies between start = {} s and stop = {} s; it lasts {} s", name, start,
                      std::min(stop, stroke.duration()), stroke.duration());
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

/// The unit normal of the least-squares plane, with z > 0.
Vector3d plane_normal(const std::vector<Vector3d>& points, const Vector3d& centroid,
                      const std::string& name) {
  Matrix3d covariance = Matrix3d::Zero();
  for (const Vector3d& p : points) covariance += (p - centroid) * (p - centroid).transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(covariance);  // eigenvalues in increasing order
  // Squared widths: below this ratio the tracing is a line to within a millionth of its length.
  if (points.size() < 3 || !(axes.eigenvalues()[1] > 1e-12 * axes.eigenvalues()[2])) {
    throw_input_error(
        "{}: plane = \"fit\" finds no plane, because its {} samples with the pen down lie on one line; set "
        "stroke.plane = \"keep\"",
        name, points.size());
  }
  if (axes.eigenvalues()[1] < 4.0 * axes.eigenvalues()[0]) {
    throw_input_error(
        "{}: plane = \"fit\" finds no plane, because its samples with the pen down are less than twice as "
        "wide as they are thick, so they are not a tracing on a table; set stroke.plane = \"keep\"",
        name);
  }
  Vector3d normal = axes.eigenvectors().col(0);
  if (normal.z() < 0.0) normal = -normal;
  const double tilt = to_degrees(std::atan2(normal.head<2>().norm(), normal.z()));
  if (tilt > steepest_table) {
    throw_input_error(
        "{}: its samples with the pen down fit a plane tilted {:.3g} deg, so they are not a tracing on a "
        "table; set stroke.plane = \"keep\"",
        name, tilt);
  }
  return normal;
}

void lay_level(Stroke& stroke, const std::string& name) {
  std::vector<Vector3d> tracing;
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    if (stroke.pen_down(i)) tracing.push_back(stroke.position[i]);
  }
  Vector3d centroid = Vector3d::Zero();
  for (const Vector3d& p : tracing) centroid += p;
  centroid /= static_cast<double>(std::max<std::size_t>(tracing.size(), 1));
  const Matrix3d level =
      Eigen::Quaterniond::FromTwoVectors(plane_normal(tracing, centroid, name), Vector3d::UnitZ())
          .toRotationMatrix();

  // About the centroid, which lies on the plane: small numbers, and z = 0 is the plane at once.
  for (Vector3d& p : stroke.position) p -= centroid;
  rotate(stroke, level);
  Eigen::AlignedBox3d extent;
  for (std::size_t i = 0; i < stroke.size(); ++i)
    if (stroke.pen_down(i)) extent.extend(stroke.position[i]);
  const Vector3d centre(extent.center().x(), extent.center().y(), 0.0);
  for (Vector3d& p : stroke.position) p -= centre;
}

}  // namespace

void keep_samples(Stroke& stroke, std::size_t begin, std::size_t end) {
  cut(stroke.time, begin, end);
  cut(stroke.position, begin, end);
  cut(stroke.velocity, begin, end);
  cut(stroke.force, begin, end);
  cut(stroke.orientation, begin, end);
  cut(stroke.switches, begin, end);
  cut(stroke.flags, begin, end);
  cut(stroke.contact, begin, end);
}

PointPlacement point_placement(const StrokePlacement& placement, const std::string& frame) {
  PointPlacement place;
  if (frame == "device") place.axes << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  place.scale = placement.scale;
  const double angle = to_radians(placement.rotate_z);
  if (angle != 0.0) place.turn = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
  place.shift = placement.offset - placement.depth * Vector3d::UnitZ();
  return place;
}

Stroke place_stroke(const Stroke& stroke, const StrokePlacement& placement, const std::string& name) {
  if (!(placement.scale > 0.0))
    throw_input_error("{}: scale is {}; it must be positive", name, placement.scale);
  Stroke placed = stroke;
  cut_time(placed, placement.start, placement.stop, name);
  const PointPlacement place = point_placement(placement, placed.frame);
  rotate(placed, place.axes);
  placed.frame = "bed";
  if (placement.plane == StrokePlane::fit) lay_level(placed, name);

  for (Vector3d& p : placed.position) p *= place.scale;
  for (Vector3d& v : placed.velocity) v *= place.scale;
  rotate(placed, place.turn);
  for (Vector3d& p : placed.position) p += place.shift;
  check_stroke(placed, name);
  return placed;
}

}  // namespace sandstroke
